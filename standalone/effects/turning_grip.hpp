// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_TURNING_GRIP_HPP
#define SOLIDEM_EFFECTS_TURNING_GRIP_HPP

#include <string>
#include <vector>

#include "effects/grip_parameters.hpp"
#include "effects/grips.hpp"

namespace solidem {

/// How a grip turns, about an axis that goes where the grip goes.
struct GripTurn {
  enum class Kind { angle, angular_velocity, torque };
  Kind kind = Kind::angle;
  TimeFunction function;  ///< rad, rad/s, or N·m
  Vector axis{0, 0, 1};   ///< unit
  Vector point{};         ///< of the axis at the start, m
};

/// A grip that turns as a whole: where it goes is imposed along all axes.
struct TurningGripParameters {
  GripParameters grip;
  GripTurn turn;
};

/// Elements that turn together, as parts of one rigid body: by an angle or an angular velocity that
/// is imposed, or as a torque and the forces of their bonds make them. Each stands exactly on its
/// circle, turned by the grip's angle; forces of bonds are read as in a grip that does not turn.
class TurningGrip : public Grip {
 public:
  TurningGrip(const TurningGripParameters& parameters, std::vector<std::int32_t> elements,
              Model& model);

  void advance(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;
  double work(const Model& /*model*/) const override { return work_; }
  void state(Archive& archive) override;

 private:
  /// What bonds do to the grip: force, and torque about its axis.
  struct Load {
    Vector force{};
    double torque = 0;
  };
  bool is_driven() const { return turn_.kind == GripTurn::Kind::torque; }
  double imposed_angle(double time) const;
  Vector way(double time) const;
  /// Where an element belongs.
  Vector place(std::size_t k, const Vector& displacement, double angle) const;
  /// Takes out of the velocities what the bonds did to them.
  Load take_load(Model& model, double kick) const;
  void add(Load& load, const Vector& place, const Vector& force, const Vector& moment) const;
  /// About the axis, of the elements that are there, kg·m².
  double inertia(const Model& model) const;
  double work_of(const Load& load, double time, const Vector& moved, double turned) const;
  void correct_motion(const Model& model, const Vector& velocity, double rate,
                      Observation& observation) const;

  GripTurn turn_;
  double angle_ = 0, rate_ = 0;  ///< rad; rad/s, of a driven grip, half a step behind
  Vector displacement_{};        ///< m
  double work_ = 0;              ///< done up to the last step, but for its second half
  Vector last_moved_{};          ///< in the last step
  double last_turned_ = 0;
};

}  // namespace solidem

#endif
