// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PUSH_HPP
#define SOLIDEM_EFFECTS_PUSH_HPP

#include "effects/effect.hpp"

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

}  // namespace solidem

#endif
