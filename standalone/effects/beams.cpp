// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beams.hpp"

#include <algorithm>
#include <cmath>

#include "effects/kernels/kernels.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem {

namespace {

Vector pose_centre(const double* row) {
  return {row[0], row[1], row[2]};
}
Quaternion<double> pose_orientation(const double* row) {
  return {row[4], {row[5], row[6], row[7]}};
}

Vector lanes_vector(const double* column, std::size_t at) {
  return {column[at], column[at + lanes], column[at + std::size_t{2} * lanes]};
}

void set_lanes_vector(double* column, std::size_t at, const Vector& v) {
  column[at] = v.x;
  column[at + lanes] = v.y;
  column[at + std::size_t{2} * lanes] = v.z;
}

}  // namespace

std::vector<const Column*> Beams::columns(const BeamParameters& parameters, bool periodic) {
  std::vector<const Column*> asked = {
      &columns::pose,         &columns::velocity,        &columns::angular_velocity,
      &columns::inverse_mass, &columns::inverse_inertia, &columns::rest_direction,
      &columns::rest_length};
  if (parameters.radius_from == BeamParameters::RadiusFrom::pair)
    asked.push_back(&columns::bond_radius);
  if (periodic) asked.push_back(&columns::image_shift);
  return asked;
}

Beams::Beams(const BeamParameters& parameters, const std::vector<double>& mass, Model& model) {
  const Specimen& specimen = model.specimen();
  const bool from_pair = parameters.radius_from == BeamParameters::RadiusFrom::pair;
  const double radius = from_pair ? 1.0 : parameters.radius_ratio * mean_radius(specimen);
  rigidity_ = euler_bernoulli_rigidity<double>({parameters.young_modulus, parameters.shear_modulus, radius});

  double* poses[] = {model.data(columns::pose), model.next(columns::pose)};
  for (double* pose : poses)
    for (std::size_t i = 0; i < model.slots().padded_elements(); ++i) pose[8 * i + 4] = 1;
  double* inverse_mass = model.data(columns::inverse_mass);
  double* inverse_inertia = model.data(columns::inverse_inertia);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    poses[0][8 * i] = p.x;
    poses[0][8 * i + 1] = p.y;
    poses[0][8 * i + 2] = p.z;
    inverse_mass[i] = 1 / mass[i];
    inverse_inertia[i] = 1 / sphere_inertia(mass[i], specimen.radius[i]);
  }

  double* direction = model.data(columns::rest_direction);
  double* length = model.data(columns::rest_length);
  double* bond_radius = from_pair ? model.data(columns::bond_radius) : nullptr;
  double* shift = specimen.domain.is_periodic() ? model.data(columns::image_shift) : nullptr;
  std::fill(length, length + model.size(columns::rest_length), 1.0);
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    // Both sides take the chord from the lower to the higher element: their rest states are
    // opposite to the last bit.
    const double side = i < j ? 1 : -1;
    const Vector chord = rest_chord(specimen, {std::min(i, j), std::max(i, j)});
    const double distance = norm(chord);
    const auto slot = Model::at_slot(columns::rest_length, row, lane);
    const auto slot3 = Model::at_slot(columns::rest_direction, row, lane);
    length[slot] = distance;
    set_lanes_vector(direction, slot3, (side / distance) * chord);
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    if (bond_radius != nullptr)
      bond_radius[slot] = parameters.radius_ratio * 0.5 * (specimen.radius[a] + specimen.radius[b]);
    if (shift != nullptr) {
      // A whole number of periods, so that it is exact and the two sides' shifts are opposite.
      const Vector extent = specimen.domain.upper - specimen.domain.lower;
      const Vector d = side * chord - (specimen.position[b] - specimen.position[a]);
      set_lanes_vector(
          shift, slot3,
          {std::nearbyint(d.x / extent.x) * extent.x, std::nearbyint(d.y / extent.y) * extent.y,
           std::nearbyint(d.z / extent.z) * extent.z});
    }
  });
}

std::vector<TimeStepCriterion> Beams::time_step_criteria(const Model& model) const {
  const double* inverse_mass = model.data(columns::inverse_mass);
  const double* inverse_inertia = model.data(columns::inverse_inertia);
  double axial = 0, bending = 0, torsion = 0;  // largest squared frequencies
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const Bond b = bond(model, i, j, row, lane);
    const double m = inverse_mass[i] / b.rest_length, inertia = inverse_inertia[i] / b.rest_length;
    axial = std::max(axial, m * b.rigidity.axial);
    bending = std::max(bending, inertia * b.rigidity.bending / 2);
    torsion = std::max(torsion, inertia * b.rigidity.torsion);
  });
  return {{"axial stiffness of the beams", 1 / std::sqrt(axial)},
          {"bending stiffness of the beams", 1 / std::sqrt(bending)},
          {"torsional stiffness of the beams", 1 / std::sqrt(torsion)}};
}

Beams::Bond Beams::bond(const Model& model, std::int32_t i, std::int32_t j, std::size_t row,
                        int lane) const {
  const double* pose = model.data(columns::pose);
  const double* row_i = pose + std::ptrdiff_t{8} * i;
  const double* row_j = pose + std::ptrdiff_t{8} * j;
  const auto slot3 = Model::at_slot(columns::rest_direction, row, lane);
  Vector chord = pose_centre(row_j) - pose_centre(row_i);
  if (model.has(columns::image_shift))
    chord += lanes_vector(model.data(columns::image_shift), slot3);
  Bond result{i, j, rigidity_,
              model.data(columns::rest_length)[Model::at_slot(columns::rest_length, row, lane)],
              beam_pose(chord, lanes_vector(model.data(columns::rest_direction), slot3),
                        pose_orientation(row_i), pose_orientation(row_j))};
  if (model.has(columns::bond_radius))
    result.rigidity = beam_rigidity_of_radius(
        rigidity_,
        model.data(columns::bond_radius)[Model::at_slot(columns::bond_radius, row, lane)]);
  return result;
}

void Beams::advance(Model& model, const Step& step) {
  const bool from_pair = model.has(columns::bond_radius);
  const BeamMotion motion{
      model.slots().first_row(),
      model.slots().neighbours(),
      model.data(columns::pose),
      model.next(columns::pose),
      model.data(columns::velocity),
      model.data(columns::angular_velocity),
      model.data(columns::inverse_mass),
      model.data(columns::inverse_inertia),
      model.data(columns::rest_direction),
      model.data(columns::rest_length),
      from_pair ? model.data(columns::bond_radius) : nullptr,
      model.has(columns::image_shift) ? model.data(columns::image_shift) : nullptr,
      rigidity_,
      step.kick,
      step.time_step};
  const auto move = kernels().move_beams;
  for_blocks(model.slots().blocks(), 40,
             [&](std::size_t first, std::size_t last) { move(motion, first, last); });
}

void Beams::observe(const Model& model, Observation& observation) const {
  const std::size_t count = model.slots().padded_elements(), blocks = model.slots().blocks();
  ObservedMotion& motion = observation.motion;
  motion.force.assign(count, {});
  motion.moment.assign(count, {});
  std::vector<double> energy(blocks, 0.0);
  for_blocks(blocks, 40, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block)
      model.slots().for_each_in(block,
                                [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
                                  const Bond b = bond(model, i, j, row, lane);
                                  const BeamLoad<double> load = b.load();
                                  motion.force[static_cast<std::size_t>(i)] += load.force;
                                  motion.moment[static_cast<std::size_t>(i)] += load.moment_i;
                                  energy[block] += 0.5 * b.energy();
                                });
  });
  motion.elastic_energy = 0;
  for (const double part : energy) motion.elastic_energy += part;

  const double* velocity = model.data(columns::velocity);
  const double* spin = model.data(columns::angular_velocity);
  const double* inverse_mass = model.data(columns::inverse_mass);
  const double* inverse_inertia = model.data(columns::inverse_inertia);
  const std::size_t elements = model.elements();
  motion.force.resize(elements);
  motion.moment.resize(elements);
  motion.velocity.resize(elements);
  motion.angular_velocity.resize(elements);
  motion.kinetic_energy = 0;
  for (std::size_t i = 0; i < elements; ++i) {
    const std::size_t at = Model::at(columns::velocity, i);
    Vector& v = motion.velocity[i];
    Vector& w = motion.angular_velocity[i];
    v = lanes_vector(velocity, at) + (observation.behind * inverse_mass[i]) * motion.force[i];
    w = lanes_vector(spin, at) + (observation.behind * inverse_inertia[i]) * motion.moment[i];
    motion.kinetic_energy += 0.5 * (dot(v, v) / inverse_mass[i] + dot(w, w) / inverse_inertia[i]);
  }
}

}  // namespace solidem
