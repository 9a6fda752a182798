// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_MECHANICS_HPP
#define SOLIDEM_EFFECTS_MECHANICS_HPP

#include <vector>

#include "effects/effect.hpp"
#include "effects/pair_loads.hpp"

namespace solidem {

/// Forces between elements, and the motion under them: beams, or central forces. A scene has one of
/// them.
class Mechanics : public Effect, public ActsBetweenElements {
 public:
  /// Bounds on the time step from stiffness and inertia.
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override = 0;

  /// The longest stable time step, s, of a body whose largest squared frequency at rest is this,
  /// 1/s².
  virtual double longest_time_step(double squared_frequency) const = 0;

  /// The accelerations at the present poses, in the columns of the velocities, which must be zero;
  /// without dissipation, and nothing moves, flows or breaks.
  virtual void accelerate(Model& model) const = 0;

  /// Displacements by which stiffness is tried, in mean radii: small enough for the law to be
  /// linear to about 1e-6, and far above round-off.
  virtual double trial_displacement() const { return 1e-5; }

  /// Mean stiffness of the pairs along their chords, N/m, before any has parted; 0: there are none.
  virtual double mean_stiffness(const Model& /*model*/) const { return 0; }

  /// A small energy to measure round-off by: that of one pair, J.
  virtual double typical_energy(const Model& model) const = 0;
  /// Strains that round-off alone may bring, with a wide margin.
  static constexpr double round_off_strain = 1e-9;

  /// Whether the forces can give more to motion than was put in: elements attract each other.
  virtual bool releases_energy() const { return false; }

  /// Makes the new poses those that hold, once all that moves elements has acted.
  virtual void finish_move(Model& model) = 0;
};

}  // namespace solidem

#endif
