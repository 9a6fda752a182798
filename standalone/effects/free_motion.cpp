// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/free_motion.hpp"

#include <algorithm>
#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/kernels/kernels.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

bool elements_are_loose(const Setup& setup) {
  return setup.get<ContactParameters>() && !setup.get<BeamParameters>() &&
         !setup.get<CentralForceParameters>();
}

std::vector<const Column*> FreeMotion::columns(bool rotation) {
  std::vector<const Column*> asked = {&columns::pose, &columns::velocity, &columns::inverse_mass};
  if (rotation) asked.insert(asked.end(), {&columns::angular_velocity, &columns::inverse_inertia});
  return asked;
}

FreeMotion::FreeMotion(const std::vector<double>& mass, double stiffness, Model& model)
    : stiffness_(stiffness) {
  const Specimen& specimen = model.specimen();
  for (double* pose : {model.data(columns::pose), model.next(columns::pose)})
    for (std::size_t i = 0; i < model.slots().padded_elements(); ++i) pose[8 * i + 4] = 1;
  const bool has_rotation = model.has(columns::angular_velocity);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    std::copy_n(&specimen.position[i].x, 3, model.positions()[i]);
    model.data(columns::inverse_mass)[i] = 1 / mass[i];
    if (has_rotation)
      model.data(columns::inverse_inertia)[i] = 1 / sphere_inertia(mass[i], specimen.radius[i]);
  }
}

void FreeMotion::advance(Model& model, const Step& step) {
  const FreeMotionColumns columns{
      model.data(columns::pose), model.next(columns::pose), model.data(columns::velocity),
      model.has(columns::angular_velocity) ? model.data(columns::angular_velocity) : nullptr,
      step.time_step};
  for_blocks(model.slots().blocks(), least_blocks_moving, [&](std::size_t first, std::size_t last) {
    kernels().move_freely(columns, first, last);
  });
}

void FreeMotion::observe(const Model& model, Observation& observation) const {
  const std::size_t elements = model.elements();
  const bool has_rotation = model.has(columns::angular_velocity);
  ObservedMotion& motion = observation.motion;
  motion.force.assign(elements, {});
  motion.moment.assign(elements, {});
  motion.velocity.assign(elements, {});
  motion.angular_velocity.assign(has_rotation ? elements : 0, {});
  motion.kinetic_energy = motion.squared_impulse = 0;
  for (std::size_t i = 0; i < elements; ++i) {
    const std::size_t at = Model::at(columns::velocity, i);
    const Vector v = motion.velocity[i] = lanes_vector(model.data(columns::velocity), at);
    motion.kinetic_energy += 0.5 * dot(v, v) / model.data(columns::inverse_mass)[i];
    if (!has_rotation) continue;
    const Vector w = motion.angular_velocity[i] =
        lanes_vector(model.data(columns::angular_velocity), at);
    motion.kinetic_energy += 0.5 * dot(w, w) / model.data(columns::inverse_inertia)[i];
  }
}

std::vector<TimeStepCriterion> FreeMotion::time_step_criteria(const Model& /*model*/) const {
  return {};
}

double FreeMotion::longest_time_step(double squared_frequency) const {
  return 2 / std::sqrt(squared_frequency);
}

void FreeMotion::finish_move(Model& model) {
  model.swap(columns::pose);
}

}  // namespace solidem
