// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_RUPTURE_HPP
#define SOLIDEM_EFFECTS_RUPTURE_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/beams.hpp"

namespace solidem {

/// A bond that broke.
struct BrokenBond {
  Pair pair;
  double free_distance;    ///< at which its elements would touch that were not pressed then, m
  double length;           ///< when it broke, m
  double push;             ///< with which it pushed them apart then, N
  double axial_stiffness;  ///< E S / l, N/m
  double section;          ///< S, m²

  /// At which its elements touch from then on, m, if the contact is so stiff, N/m.
  double contact_distance(double stiffness) const;
  void state(Archive& archive) {
    archive(pair, free_distance, length, push, axial_stiffness, section);
  }
};

/// A bond or contact that acts for the last time in a step.
struct LastAct {
  Pair pair;
  BeamLoad<double> load;
  std::array<double, 8> pose_i, pose_j;  ///< in which it acts

  void state(Archive& archive) {
    archive(pair, load.force, load.moment_i, load.moment_j, pose_i, pose_j);
  }
};

/// Takes bonds away that reached their limit in the step, and elements that are left with too few.
///
/// A bond that breaks still acts in the step that finds it broken, on both of its elements; what it
/// stored then is lost, less the work that it does in that step, half of what its load does along
/// the way: the fracture energy. An element that is removed loses its remaining bonds and stays
/// where it is, at rest.
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

  /// Breaks further bonds in this step; each pair once, sorted.
  void break_bonds(const std::vector<Pair>& pairs, const Step& step);
  /// Takes elements out that are not out yet, with the bonds they have left.
  void remove_elements(const std::vector<std::int32_t>& elements, const Step& step);

  /// Enters the energy, J, of a bond or a contact that acts for the last time in this step, with
  /// this load, in the poses that the step began with; of one that begins to act in its place, both
  /// with the other sign.
  void lose(Pair pair, double energy, const BeamLoad<double>& load);

 private:
  void break_bond(Pair pair);
  void remove(std::int32_t element, double time_step);
  /// Stops an element for good; its energy of motion, J, before this impulse acted.
  double stop(const Column& velocity, const Column& inverse, std::size_t element,
              const Vector& impulse);
  /// The work done by what acted for the last time in the step that led to the present poses, J.
  double work_of_last_acts() const;

  RuptureParameters parameters_;
  const Beams& beams_;
  Model& model_;
  std::vector<BrokenBond> broken_;
  std::vector<std::int32_t> removed_;  ///< sorted
  double fracture_energy_ = 0;         ///< without that of `last_acts_`
  std::vector<LastAct> last_acts_;
  double first_time_;
};

}  // namespace solidem

#endif
