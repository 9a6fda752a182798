// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/turning_grip.hpp"

#include <algorithm>
#include <utility>

#include "effects/removed_elements.hpp"
#include "effects/tool_motion.hpp"
#include "model/axis_names.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

TurningGrip::TurningGrip(const TurningGripParameters& parameters,
                         std::vector<std::int32_t> elements, Model& model)
    : Grip(parameters.grip, std::move(elements), model), turn_(parameters.turn) {}

double TurningGrip::imposed_angle(double time) const {
  return turn_.kind == GripTurn::Kind::angle ? turn_.function(time) : turn_.function.integral(time);
}

Vector TurningGrip::way(double time) const {
  return {imposed_displacement(0, time), imposed_displacement(1, time),
          imposed_displacement(2, time)};
}

Vector TurningGrip::place(std::size_t k, const Vector& displacement, double angle) const {
  return turn_.point + displacement +
         rotate(rotation_about(turn_.axis, angle), rest_[k] - turn_.point);
}

void TurningGrip::add(Load& load, const Vector& place, const Vector& force,
                      const Vector& moment) const {
  load.force += force;
  load.torque += dot(turn_.axis, cross(place - turn_.point - displacement_, force) + moment);
}

TurningGrip::Load TurningGrip::take_load(Model& model, double kick) const {
  const PresentElements is_present(model);
  Load load;
  const bool turns = model.has(columns::angular_velocity);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const auto i = static_cast<std::size_t>(elements_[k]);
    if (!is_present(i)) continue;
    const double* now = model.positions()[i];
    double* velocity = model.data(columns::velocity);
    const std::size_t at = Model::at(columns::velocity, i);
    const double per_kick = 1 / (kick * model.data(columns::inverse_mass)[i]);
    const Vector force = per_kick * lanes_vector(velocity, at);
    set_lanes_vector(velocity, at, {});
    Vector moment{};
    if (turns) {
      double* spin = model.data(columns::angular_velocity);
      const std::size_t at_spin = Model::at(columns::angular_velocity, i);
      moment = (1 / (kick * model.data(columns::inverse_inertia)[i])) * lanes_vector(spin, at_spin);
      set_lanes_vector(spin, at_spin, {});
    }
    add(load, {now[0], now[1], now[2]}, force, moment);
  }
  return load;
}

double TurningGrip::inertia(const Model& model) const {
  const PresentElements is_present(model);
  double sum = 0;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const auto i = static_cast<std::size_t>(elements_[k]);
    if (!is_present(i)) continue;
    const Vector arm = cross(turn_.axis, rest_[k] - turn_.point);
    sum += dot(arm, arm) / model.data(columns::inverse_mass)[i];
    if (model.has(columns::inverse_inertia)) sum += 1 / model.data(columns::inverse_inertia)[i];
  }
  return sum;
}

double TurningGrip::work_of(const Load& load, double time, const Vector& moved,
                            double turned) const {
  const double torque = is_driven() ? turn_.function(time) : -load.torque;
  return torque * turned - dot(load.force, moved);
}

void TurningGrip::advance(Model& model, const Step& step) {
  const double after = step.time + step.time_step;
  const Load load = take_load(model, step.kick);
  double turned = 0;
  if (is_driven()) {
    rate_ += step.kick * (turn_.function(step.time) + load.torque) / inertia(model);
    turned = step.time_step * rate_;
  } else {
    // At the start elements are at rest, wherever the angle begins.
    turned = imposed_angle(after) - (step.time > 0 ? imposed_angle(step.time) : 0);
  }
  const Vector displacement = way(after);
  const Vector moved = displacement - (step.time > 0 ? way(step.time) : Vector{});
  work_ += work_of(load, step.time, 0.5 * (last_moved_ + moved), 0.5 * (last_turned_ + turned));
  last_moved_ = moved;
  last_turned_ = turned;
  displacement_ = displacement;
  angle_ = is_driven() ? angle_ + turned : imposed_angle(after);
  const Quaternion<double> orientation = rotation_about(turn_.axis, angle_);
  const bool has_orientation = model.has(columns::angular_velocity);
  const PresentElements is_present(model);
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const auto i = static_cast<std::size_t>(elements_[k]);
    if (!is_present(i)) continue;
    const Vector target = place(k, displacement_, angle_);
    const double* now = model.positions()[i];
    double* next = model.next_positions()[i];
    std::copy_n(&target.x, 3, next);
    if (has_orientation) {
      next[4] = orientation.w;
      std::copy_n(&orientation.v.x, 3, next + 5);
    }
    if (!model.neighbours_feel_velocity()) continue;
    double* felt = model.next_felt_velocities()[i];
    for (int axis = 0; axis < 3; ++axis) felt[axis] = (next[axis] - now[axis]) / step.time_step;
  }
}

void TurningGrip::observe(const Model& model, Observation& observation) const {
  const PresentElements is_present(model);
  Load load;
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    if (!is_present(i)) continue;
    const double* now = model.positions()[i];
    const bool turns = !observation.motion.moment.empty();
    add(load, {now[0], now[1], now[2]}, observation.motion.force[i],
        turns ? observation.motion.moment[i] : Vector{});
  }
  const double time = observation.time;
  observation.energies.add(EnergyLedger::Kind::input, "external_work",
                           work_ + work_of(load, time, 0.5 * last_moved_, 0.5 * last_turned_));
  double rate = rate_;
  if (turn_.kind == GripTurn::Kind::angle) rate = turn_.function.rate(time);
  if (turn_.kind == GripTurn::Kind::angular_velocity) rate = turn_.function(time);
  if (is_driven()) {
    const double of_all = inertia(model), torque = turn_.function(time) + load.torque;
    rate += observation.behind * torque / of_all;
    observation.motion.kinetic_energy += 0.5 * of_all * rate * rate;
    observation.motion.squared_impulse += 0.5 * torque * torque / of_all;
  }
  Vector velocity{};
  for (int axis = 0; axis < 3; ++axis) component(velocity, axis) = imposed_velocity(axis, time);
  correct_motion(model, velocity, rate, observation);
  const auto tell = [&](const std::string& what, double value) {
    observation.add("grip." + parameters_.name + "." + what, value);
  };
  for (int axis = 0; axis < 3; ++axis)
    tell(std::string("force_") + axis_names[axis], -component(load.force, axis));
  for (int axis = 0; axis < 3; ++axis)
    tell(std::string("displacement_") + axis_names[axis], component(displacement_, axis));
  tell("torque", is_driven() ? turn_.function(time) : -load.torque);
  tell("angle", angle_);
}

void TurningGrip::correct_motion(const Model& model, const Vector& velocity, double rate,
                                 Observation& observation) const {
  const PresentElements is_present(model);
  ObservedMotion& motion = observation.motion;
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    if (!is_present(i)) continue;
    const double* now = model.positions()[i];
    const double inverse_mass = model.data(columns::inverse_mass)[i];
    Vector& v = motion.velocity[i];
    motion.kinetic_energy -= 0.5 * dot(v, v) / inverse_mass;
    motion.add_impulse(motion.force[i], {}, inverse_mass);
    const Vector arm = Vector{now[0], now[1], now[2]} - turn_.point - displacement_;
    v = velocity + rate * cross(turn_.axis, arm);
    if (!model.has(columns::angular_velocity)) continue;
    const double inverse_inertia = model.data(columns::inverse_inertia)[i];
    Vector& spin = motion.angular_velocity[i];
    motion.kinetic_energy -= 0.5 * dot(spin, spin) / inverse_inertia;
    motion.add_impulse(motion.moment[i], {}, inverse_inertia);
    spin = rate * turn_.axis;
  }
}

void TurningGrip::state(Archive& archive) {
  archive(angle_, rate_, displacement_, work_, last_moved_, last_turned_);
}

}  // namespace solidem
