// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PUSH_HPP
#define SOLIDEM_EFFECTS_PUSH_HPP

#include "effects/effect.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

/// Changes the velocity of an element along an axis, m/s, in a step in which it has moved already:
/// its new place follows, and so does the velocity that its neighbours feel.
inline void kick(Model& model, const Step& step, std::size_t element, int axis, double gain) {
  model.data(columns::velocity)[Model::at(columns::velocity, element, axis)] += gain;
  model.next_positions()[element][axis] += step.time_step * gain;
  if (model.has(columns::velocity_for_neighbours))
    model.next(columns::velocity_for_neighbours)[4 * element + static_cast<std::size_t>(axis)] +=
        gain;
}

/// A force, N, on an element through a step, besides that of its neighbours. An element that was
/// removed stands still.
inline void push(Model& model, const Step& step, std::int32_t element, const Vector& force) {
  const auto i = static_cast<std::size_t>(element);
  const double inverse_mass = model.data(columns::inverse_mass)[i];
  for (int axis = 0; axis < 3; ++axis)
    kick(model, step, i, axis, step.kick * inverse_mass * component(force, axis));
}

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
inline void turn_on(Model& model, const Step& step, std::size_t element,
                    const Vector& angular_velocity) {
  turn_on(model.data(columns::pose), model.next(columns::pose), step, element, angular_velocity);
}

/// The same as push() for many elements that have an orientation, and moments, N·m, on them.
class Pushes {
 public:
  Pushes(Model& model, const Step& step)
      : step_(step),
        pose_(model.data(columns::pose)),
        next_pose_(model.next(columns::pose)),
        velocity_(model.data(columns::velocity)),
        inverse_mass_(model.data(columns::inverse_mass)),
        spin_(find(model, columns::angular_velocity)),
        inverse_inertia_(find(model, columns::inverse_inertia)) {}

  void push(std::size_t element, const Vector& force) const {
    const std::size_t at = Model::at(columns::velocity, element);
    const Vector gain = (step_.kick * inverse_mass_[element]) * force;
    set_lanes_vector(velocity_, at, lanes_vector(velocity_, at) + gain);
    for (int axis = 0; axis < 3; ++axis)
      next_pose_[8 * element + static_cast<std::size_t>(axis)] +=
          step_.time_step * component(gain, axis);
  }
  /// Of elements that turn.
  void twist(std::size_t element, const Vector& moment) const {
    const std::size_t at = Model::at(columns::angular_velocity, element);
    const Vector now = lanes_vector(spin_, at) + (step_.kick * inverse_inertia_[element]) * moment;
    set_lanes_vector(spin_, at, now);
    turn_on(pose_, next_pose_, step_, element, now);
  }

 private:
  static double* find(Model& model, const Column& column) {
    return model.has(column) ? model.data(column) : nullptr;
  }
  Step step_;
  const double* pose_;
  double *next_pose_, *velocity_;
  const double* inverse_mass_;
  double* spin_;
  const double* inverse_inertia_;
};

/// A moment, N·m, on an element that turns, through a step, besides those of its neighbours.
inline void twist(Model& model, const Step& step, std::int32_t element, const Vector& moment) {
  const auto i = static_cast<std::size_t>(element);
  const std::size_t at = Model::at(columns::angular_velocity, i);
  double* spin = model.data(columns::angular_velocity);
  const Vector now =
      lanes_vector(spin, at) + (step.kick * model.data(columns::inverse_inertia)[i]) * moment;
  set_lanes_vector(spin, at, now);
  turn_on(model, step, i, now);
}

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
