// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONDUCTION_HPP
#define SOLIDEM_EFFECTS_CONDUCTION_HPP

#include <functional>
#include <memory>
#include <vector>

#include "effects/changing_conductors.hpp"
#include "effects/conduction_geometry.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load.hpp"
#include "model/material.hpp"

namespace solidem {

/// Thermal properties of each element.
struct ThermalProperties {
  std::vector<Material> materials;
  std::vector<std::size_t> material;  ///< of each element; empty: the first of all

  const Material& of(std::size_t element) const {
    return materials[material.empty() ? 0 : material[element]];
  }
};

/// Whether a property of some material depends on temperature.
bool conductivity_varies(const std::vector<Material>& materials);
bool capacity_varies(const std::vector<Material>& materials);

/// Heat conduction between neighbouring elements (laws/heat_exchange.hpp); which are neighbours,
/// through which area and for how much volume they stand is the geometry of a transmission law.
/// Between two materials the harmonic mean of their conductivities acts, and their contact
/// conductance where one is given.
class Conduction : public Effect {
 public:
  static std::vector<const Column*> columns(const ConductionParameters& parameters,
                                            const std::vector<Material>& materials);

  Conduction(const ConductionParameters& parameters, ThermalProperties properties,
             const ConductionGeometry& geometry, Model& model);

  /// From now on conduction follows bonds that break or are made; the model's conductors must have
  /// a table of their own. `geometry`: what the conductors were made of.
  void watch_bonds(ConductionParameters::BrokenBonds broken_bonds, ConductionGeometry geometry,
                   Model& model);

  /// Brings the conductors up to date with the bonds; whether any changed.
  bool follow_bonds(Model& model);

  /// An explicit step that is stable with the conductors of now, s, if `at_start` is with those of
  /// the start. Pairs added to a body raise its largest decay rate by no more than their own, which
  /// is at most 2 max Σ_j conductance_ij / C_i over the pairs added.
  double surely_stable_step(double at_start) const;

  /// min over elements of C_i / Σ_j conductance_ij: no temperature overshoots its neighbours'.
  /// Holds at the worst temperature of the materials' tables. `exchange`: further conductances of
  /// elements.
  TimeStepCriterion time_step_criterion(const Model& model,
                                        const std::vector<ElementValue>& exchange) const;

  /// The longest stable explicit Euler step, 2/μ_max, s, at the worst temperature, by power
  /// iteration on the kernel; from above, at most some 2 % too long.
  double stable_time_step(Model& model, const std::vector<ElementValue>& exchange) const;

  /// An explicit Euler step; where no property depends on temperature.
  void advance(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;
  /// What became of the pairs of the start; nothing where bonds never change.
  void state(Archive& archive) override;

  /// Power conducted into each element, W. Both arrays have room for `padded_elements` and are
  /// aligned as columns are.
  void powers(Model& model, const double* temperature, double* power) const;

  /// Conductivity of an element at a temperature, and the largest at any, W/(m K).
  double conductivity(std::size_t i, double temperature) const {
    return properties_.of(i).conductivity(temperature);
  }
  double largest_conductivity(std::size_t i) const {
    return properties_.of(i).conductivity.largest();
  }

  /// Enthalpy of an element above that at the initial temperature, J; its inverse, K; its
  /// derivative, J/K.
  double enthalpy(const Model& model, std::size_t i, double temperature) const;
  double temperature(const Model& model, std::size_t i, double enthalpy) const;
  double capacity(const Model& model, std::size_t i, double temperature) const;

  /// The temperature of an element after it has taken up heat, J.
  double heated(const Model& model, std::size_t i, double temperature, double heat) const;

  /// Heat that takes an element from one temperature to another, J.
  double heat(const Model& model, std::size_t i, double from, double to) const;

  /// Visits each pair once, i < j, with its conductance at these temperatures, W/K.
  void for_each_conductance(
      const Model& model, const double* temperature,
      const std::function<void(std::int32_t i, std::int32_t j, double conductance)>& visit) const;

  /// No property depends on temperature.
  bool is_linear() const { return !conductivity_varies_ && !capacity_varies_; }

 private:
  /// Fills a slot of the conductors.
  void set_path(Model& model, Pair pair, Slots::Place place, const HeatPath& path) const;
  /// Lays the conductors out anew for the pairs of now.
  void lay_out(Model& model);
  /// Largest decay rate that pairs added since the start can have between them, 1/s, halved.
  double added_rate(const Model& model) const;
  bool is_symmetric(const Model& model) const;
  /// Powers at the conductivities that stand in the column, where they vary.
  void conduct(Model& model, const double* temperature, double* power) const;
  /// Fills that column with the largest that there are.
  void assume_worst(Model& model) const;
  /// Largest possible 1 / C_i, K/J.
  double worst_inverse_capacity(const Model& model, std::size_t i) const;

  double initial_temperature_;
  ThermalProperties properties_;
  bool conductivity_varies_, capacity_varies_;
  std::vector<Contact> contacts_;
  std::unique_ptr<ChangingConductors> changing_;  ///< none where bonds never change
  Model* changing_model_ = nullptr;               ///< whose bonds are watched
  double added_rate_ = 0;                         ///< see added_rate()
};

}  // namespace solidem

#endif
