// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/tool_motion.hpp"

#include <cmath>

namespace solidem {

namespace {

constexpr double full_turn = 6.28318530717958647692;

}  // namespace

Vector ToolMotion::way(double time) const {
  Vector sum{};
  for (int axis = 0; axis < 3; ++axis) {
    const TimeFunction& function = along[static_cast<std::size_t>(axis)];
    component(sum, axis) = is_path ? function(time) - function(0) : function.integral(time);
  }
  return sum;
}

Vector ToolMotion::velocity(double time) const {
  Vector v{};
  for (int axis = 0; axis < 3; ++axis) {
    const TimeFunction& function = along[static_cast<std::size_t>(axis)];
    component(v, axis) = is_path ? function.rate(time) : function(time);
  }
  return v;
}

bool ToolMotion::turns() const {
  return !(angular_velocity.is_constant() && angular_velocity(0) == 0) &&
         !angular_velocity.value.empty();
}

Quaternion<double> rotation_about(const Vector& axis, double angle) {
  const double half = 0.5 * std::remainder(angle, 2 * full_turn);
  return {std::cos(half), std::sin(half) * axis};
}

Quaternion<double> rotation_of_z(const Vector& direction) {
  // Downwards: the turn to the opposite direction, after z was turned over.
  if (direction.z < 0) return rotation_of_z(-direction) * Quaternion<double>{0, {1, 0, 0}};
  const double w = std::sqrt(0.5 * (1 + direction.z));
  return {w, {-0.5 * direction.y / w, 0.5 * direction.x / w, 0}};
}

RigidPose moved(const RigidPose& start, const ToolMotion& motion, const Vector& displacement,
                double angle) {
  if (angle == 0) return {start.position + displacement, start.orientation};
  const Quaternion<double> turned = rotation_about(motion.rotation_axis, angle);
  return {
      motion.rotation_point + displacement + rotate(turned, start.position - motion.rotation_point),
      turned * start.orientation};
}

}  // namespace solidem
