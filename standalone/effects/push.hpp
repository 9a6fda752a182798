// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PUSH_HPP
#define SOLIDEM_EFFECTS_PUSH_HPP

#include <optional>

#include "effects/effect.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

/// Turns an element from the orientation that holds, at an angular velocity, rad/s, through a step.
inline void turn_on(const double* pose, double* next_pose, const Step& step, std::size_t element,
                    const Vector& angular_velocity) {
  const double* now = pose + 8 * element + 4;
  const Quaternion<double> turned =
      turn(Quaternion<double>{now[0], {now[1], now[2], now[3]}}, angular_velocity, step.time_step);
  double* next = next_pose + 8 * element + 4;
  next[0] = turned.w;
  next[1] = turned.v.x;
  next[2] = turned.v.y;
  next[3] = turned.v.z;
}

/// What acts on elements besides their neighbours, in a step in which they have moved already:
/// their new places follow, and so does the velocity that their neighbours feel. An element that
/// was removed stands still.
class Pushes {
 public:
  Pushes(Model& model, const Step& step)
      : step_(step),
        next_(model.next_positions()),
        velocity_(model.data(columns::velocity)),
        inverse_mass_(model.data(columns::inverse_mass)) {
    if (model.neighbours_feel_velocity()) felt_velocity_ = model.next_felt_velocities();
    if (!model.has(columns::angular_velocity)) return;
    pose_ = model.data(columns::pose);
    spin_ = model.data(columns::angular_velocity);
    inverse_inertia_ = model.data(columns::inverse_inertia);
  }

  /// Whether elements turn.
  bool can_twist() const { return spin_ != nullptr; }

  /// Changes the velocity of an element along an axis, m/s.
  void kick(std::size_t element, int axis, double gain) const {
    velocity_[Model::at(columns::velocity, element, axis)] += gain;
    next_[element][axis] += step_.time_step * gain;
    if (felt_velocity_) (*felt_velocity_)[element][axis] += gain;
  }
  /// A force, N, through the step.
  void push(std::size_t element, const Vector& force) const {
    for (int axis = 0; axis < 3; ++axis)
      kick(element, axis, step_.kick * inverse_mass_[element] * component(force, axis));
  }
  /// A moment, N·m, through the step, where elements turn.
  void twist(std::size_t element, const Vector& moment) const {
    const std::size_t at = Model::at(columns::angular_velocity, element);
    const Vector now = lanes_vector(spin_, at) + (step_.kick * inverse_inertia_[element]) * moment;
    set_lanes_vector(spin_, at, now);
    turn(element, now);
  }
  /// Turns an element from the orientation that holds, at an angular velocity, rad/s.
  void turn(std::size_t element, const Vector& angular_velocity) const {
    turn_on(pose_, next_.first, step_, element, angular_velocity);
  }

 private:
  Step step_;
  Model::Rows<double> next_;
  double* velocity_;
  const double* inverse_mass_;
  std::optional<Model::Rows<double>> felt_velocity_;  ///< of the next step
  const double* pose_ = nullptr;
  double* spin_ = nullptr;
  const double* inverse_inertia_ = nullptr;
};

/// What an observer sees of such a force: it acts, and has acted for as long as the velocities are
/// behind the poses.
inline void observe_push(const Model& model, Observation& observation, std::int32_t element,
                         const Vector& force) {
  const auto i = static_cast<std::size_t>(element);
  const double inverse_mass = model.data(columns::inverse_mass)[i];
  if (!(inverse_mass > 0)) return;
  ObservedMotion& motion = observation.motion;
  motion.add_impulse(motion.force[i], motion.force[i] + force, inverse_mass);
  motion.force[i] += force;
  Vector& v = motion.velocity[i];
  const Vector gain = observation.behind * inverse_mass * force;
  motion.kinetic_energy += 0.5 / inverse_mass * (dot(v + gain, v + gain) - dot(v, v));
  v += gain;
}

/// The same of such a moment.
inline void observe_twist(const Model& model, Observation& observation, std::int32_t element,
                          const Vector& moment) {
  const auto i = static_cast<std::size_t>(element);
  const double inverse_inertia = model.data(columns::inverse_inertia)[i];
  if (!(inverse_inertia > 0)) return;
  ObservedMotion& motion = observation.motion;
  motion.add_impulse(motion.moment[i], motion.moment[i] + moment, inverse_inertia);
  motion.moment[i] += moment;
  Vector& w = motion.angular_velocity[i];
  const Vector gain = observation.behind * inverse_inertia * moment;
  motion.kinetic_energy += 0.5 / inverse_inertia * (dot(w + gain, w + gain) - dot(w, w));
  w += gain;
}

}  // namespace solidem

#endif
