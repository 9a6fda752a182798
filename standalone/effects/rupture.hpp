// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_RUPTURE_HPP
#define SOLIDEM_EFFECTS_RUPTURE_HPP

#include <cstdint>
#include <vector>

#include "effects/beams.hpp"

namespace solidem {

/// A bond that broke.
struct BrokenBond {
  Pair pair;
  double contact_distance;  ///< at which its elements touch from now on, m
  double axial_stiffness;   ///< E S / l, N/m
  double section;           ///< S, m²

  void state(Archive& archive) { archive(pair, contact_distance, axial_stiffness, section); }
};

/// Takes bonds away that reached their limit in the step, and elements that are left with too few.
///
/// A bond that breaks still acts in the step that finds it broken, on both of its elements; what it
/// stored then is lost: the fracture energy. An element that is removed loses its remaining bonds
/// and stays where it is, at rest.
class Rupture : public Effect {
 public:
  Rupture(const RuptureParameters& parameters, const Beams& beams, Model& model);

  void advance(Model& model, const Step& step) override;
  /// Broken bonds, removed elements and the fracture energy.
  void observe(const Model& model, Observation& observation) const override;
  /// Besides the columns of the slots: the slots' neighbours, and what is kept here.
  void state(Archive& archive) override;
  void summarise(const Model& model, Summary& summary) const override;

  /// Bonds that broke, in the order in which they did.
  const std::vector<BrokenBond>& broken() const { return broken_; }
  std::size_t removed() const { return removed_.size(); }
  bool is_removed(std::int32_t element) const;
  /// When the first bond broke, s; NaN before.
  double first_time() const { return first_time_; }

  /// Enters energy that is lost when a bond forms anew; negative what a contact takes over.
  void add_fracture_energy(double energy) { fracture_energy_ += energy; }

 private:
  void break_bond(Pair pair);
  void remove(std::int32_t element);

  RuptureParameters parameters_;
  const Beams& beams_;
  Model& model_;
  std::vector<BrokenBond> broken_;
  std::vector<std::int32_t> removed_;  ///< sorted
  double fracture_energy_ = 0;
  double first_time_;
};

}  // namespace solidem

#endif
