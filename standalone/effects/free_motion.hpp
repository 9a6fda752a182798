// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_FREE_MOTION_HPP
#define SOLIDEM_EFFECTS_FREE_MOTION_HPP

#include <vector>

#include "effects/mechanics.hpp"
#include "effects/setup.hpp"

namespace solidem {

/// Whether elements move with no force between them but contact.
bool elements_are_loose(const Setup& setup);

/// Elements in motion with nothing between them but what other effects bring, such as contact:
/// each goes straight on and turns on, velocity Verlet. Each has the mass of its own sphere.
class FreeMotion : public Mechanics {
 public:
  /// Columns that the effect needs; `rotation`: elements turn.
  static std::vector<const Column*> columns(bool rotation);

  /// Elements are at rest at the specimen's positions. `mass` per element, kg. `stiffness`: of a
  /// contact of two elements of the mean radius, N/m.
  FreeMotion(const std::vector<double>& mass, double stiffness, Model& model);

  void advance(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;
  /// None: elements that do not meet bound no step.
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  double longest_time_step(double squared_frequency) const override;
  void accelerate(Model& /*model*/) const override {}
  double mean_stiffness(const Model& /*model*/) const override { return stiffness_; }
  double typical_energy(const Model& /*model*/) const override { return 0; }
  void for_each_pair(const Model& /*model*/, const PairVisit& /*visit*/) const override {}
  void finish_move(Model& model) override;

 private:
  double stiffness_;
};

}  // namespace solidem

#endif
