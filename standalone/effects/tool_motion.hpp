// SPDX-License-Identifier: GPL-2.0-or-later
//
// How a rigid tool moves: along a way that functions of time give, and turning about an axis that
// goes with it. Places follow from the exact integrals, not from a sum over steps: nothing drifts.
#ifndef SOLIDEM_EFFECTS_TOOL_MOTION_HPP
#define SOLIDEM_EFFECTS_TOOL_MOTION_HPP

#include <array>
#include <optional>

#include "model/specimen.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// A force that drives a tool along an axis, against its mass.
struct ToolDrive {
  TimeFunction force;  ///< N
  Vector axis{};       ///< unit
  double mass = 0;     ///< kg
};

struct ToolMotion {
  bool is_path = false;               ///< `along` are places, else velocities
  std::array<TimeFunction, 3> along;  ///< m/s, or m
  TimeFunction angular_velocity;      ///< rad/s
  Vector rotation_axis{0, 0, 1};      ///< unit
  Vector rotation_point{};            ///< of the axis at the start, m
  std::optional<ToolDrive> drive;     ///< in place of `along`

  /// From the start along the given way, m: zero of a tool that is driven.
  Vector way(double time) const;
  /// Its time derivative, m/s.
  Vector velocity(double time) const;
  /// From the start, rad.
  double angle(double time) const { return angular_velocity.integral(time); }
  bool turns() const;
};

/// Where a rigid body is: a point of it stands at position + rotation · point.
struct RigidPose {
  Vector position{};
  Quaternion<double> orientation{};

  Vector to_world(const Vector& point) const { return position + rotate(orientation, point); }
  Vector to_body(const Vector& point) const {
    return rotate(conjugate(orientation), point - position);
  }
};

/// The turn about a unit axis by an angle, rad.
Quaternion<double> rotation_about(const Vector& axis, double angle);
/// The shortest turn of z into a direction.
Quaternion<double> rotation_of_z(const Vector& direction);

/// A pose after a turn about an axis through a point and a displacement.
RigidPose moved(const RigidPose& start, const ToolMotion& motion, const Vector& displacement,
                double angle);

}  // namespace solidem

#endif
