// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_GRIPS_HPP
#define SOLIDEM_EFFECTS_GRIPS_HPP

#include <array>
#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "effects/grip_parameters.hpp"

namespace solidem {

/// Elements held, moved or loaded together.
///
/// The kernels move every element as if it were free; a grip then reads from the velocity that its
/// elements gained what the bonds did to them, and puts them where they belong. So gripped elements
/// cost nothing in the hot loop. Along an imposed axis the velocity column of a gripped element
/// stays zero: its motion belongs to the grip, and its kinetic energy is not counted.
///
/// Work is summed with the trapezoidal rule on bond force and imposed displacement; a force applied
/// to free elements works along their own path, once all that moves them has acted. Elements that
/// were removed are let go.
class Grip : public Effect {
 public:
  Grip(const GripParameters& parameters, std::vector<std::int32_t> elements, Model& model);

  void advance(Model& model, const Step& step) override;
  /// Velocities of the gripped elements, work, force and displacement of the grip.
  void observe(const Model& model, Observation& observation) const override;
  /// About: of the step that was taken last by the forces at its beginning.
  double work(const Model& model) const override { return work_ + force_work(model, last_time_); }
  void state(Archive& archive) override;

  const std::vector<std::int32_t>& elements() const { return elements_; }

  /// Displacement imposed along an axis at a time, m; 0 along an axis that is free or under force.
  double imposed_displacement(int axis, double time) const;

  /// Whether the grip says where its elements are along an axis.
  bool imposed(int axis) const;
  /// How fast, m/s, along an axis that it imposes.
  double imposed_velocity(int axis, double time) const;
  /// Whether its elements do not turn.
  bool holds_rotation() const { return parameters_.rotation_fixed; }

 protected:
  GripParameters parameters_;
  std::vector<std::int32_t> elements_;
  std::vector<Vector> rest_;  ///< where the elements stood at the start

 private:
  /// Of the elements that were not removed, kg: they share a force.
  double present_mass(const Model& model) const;
  /// Work of the forces it applies, along the way of its elements from the step before to the
  /// present poses at a time: half by the force at either end, J.
  double force_work(const Model& model, double time) const;
  void remember(const Model& model, double time);
  bool applies_force() const;
  /// Corrects the observed velocities of the gripped elements, and the kinetic energy.
  void correct_motion(const Model& model, const Vector& grip_force, Observation& observation) const;

  std::vector<double> mass_;           ///< of the elements, that resists their acceleration, kg
  double work_ = 0;                    ///< done up to the last step, but for its second half
  std::vector<Vector> last_position_;  ///< of the elements where it applies a force, a step before
  double last_time_ = 0;               ///< s, of these
  std::array<double, 3> last_displacement_{};  ///< of the last step, along imposed axes
};

}  // namespace solidem

#endif
