// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/rigid_sphere.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

Vector pose_centre(const double* row) {
  return {row[0], row[1], row[2]};
}
Quaternion<double> pose_orientation(const double* row) {
  return {row[4], {row[5], row[6], row[7]}};
}

/// Columns of slots that bonds have, whichever of them a scene needs.
constexpr const Column* slot_columns[] = {&columns::rest_direction,     &columns::rest_length,
                                          &columns::bond_radius,        &columns::bond_rigidity,
                                          &columns::image_shift,        &columns::section_normal,
                                          &columns::far_section_normal, &columns::plastic_extension,
                                          &columns::plastic_twist,      &columns::plastic_strain};

}  // namespace

BeamDemands demands_of(const Setup& setup) {
  const auto& contact = setup.get<ContactParameters>();
  return {setup.get<BeamParameters>().value(), setup.get<PlasticityParameters>(),
          setup.get<RuptureParameters>(), contact && contact->rebonding_pressure};
}

BeamFlow BeamDemands::flow() const {
  if (plasticity && plasticity->law == PlasticityParameters::Law::scaled_offset)
    return BeamFlow::scaled_offset;
  // A bond that is made between elements which have turned must remember its normals.
  if (plasticity || rebonding) return BeamFlow::radial_return;
  return rupture ? BeamFlow::brittle : BeamFlow::none;
}

std::vector<const Column*> Beams::columns(const BeamDemands& demands, bool periodic) {
  const BeamFlow flow = demands.flow();
  std::vector<const Column*> asked = {&columns::pose, &columns::velocity, &columns::inverse_mass,
                                      &columns::rest_length};
  if (demands.turning()) {
    asked.push_back(&columns::angular_velocity);
    asked.push_back(&columns::inverse_inertia);
    if (flow != BeamFlow::radial_return) asked.push_back(&columns::rest_direction);
    if (remembers(flow))
      asked.insert(asked.end(), {&columns::section_normal, &columns::far_section_normal,
                                 &columns::plastic_twist});
  }
  if (remembers(flow))
    asked.insert(asked.end(),
                 {&columns::plastic_extension, &columns::plastic_strain, &columns::plastic_work});
  if (!beams_are_alike(demands.elasticity)) {
    asked.push_back(&columns::bond_rigidity);
    if (flow != BeamFlow::none) asked.push_back(&columns::bond_radius);
  }
  if (periodic) asked.push_back(&columns::image_shift);
  return asked;
}

Beams::Beams(const BeamDemands& demands, const std::vector<double>& mass, Model& model)
    : demands_(demands),
      properties_(demands.elasticity, model.specimen()),
      flow_(demands.flow()),
      yield_{never, 0},
      rupture_{never, never} {
  const Specimen& specimen = model.specimen();
  if (demands.plasticity)
    yield_ = {demands.plasticity->yield_strain, demands.plasticity->hardening_ratio};
  if (demands.rupture)
    rupture_ = {demands.rupture->elastic_strain.value_or(never),
                demands.rupture->strain.value_or(never)};
  section_ = properties_.section(mean_radius(specimen), mean_radius(specimen), {1, 0, 0});
  rigidity_ = properties_.rigidity(section_, 1);

  double* poses[] = {model.data(columns::pose), model.next(columns::pose)};
  for (double* pose : poses)
    for (std::size_t i = 0; i < model.slots().padded_elements(); ++i) pose[8 * i + 4] = 1;
  double* inverse_mass = model.data(columns::inverse_mass);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    poses[0][8 * i] = p.x;
    poses[0][8 * i + 1] = p.y;
    poses[0][8 * i + 2] = p.z;
    inverse_mass[i] = 1 / mass[i];
    if (demands_.turning())
      model.data(columns::inverse_inertia)[i] = 1 / sphere_inertia(mass[i], specimen.radius[i]);
  }

  double* length = model.data(columns::rest_length);
  std::fill(length, length + model.size(columns::rest_length), 1.0);
  // An empty slot has shrunk to nothing, so that it is not taken for strained.
  if (model.has(columns::plastic_extension)) {
    double* extension = model.data(columns::plastic_extension);
    std::fill(extension, extension + model.size(columns::plastic_extension), -1.0);
  }
  if (model.has(columns::bond_radius)) {
    double* radius = model.data(columns::bond_radius);
    std::fill(radius, radius + model.size(columns::bond_radius), 1.0);
  }
  if (model.has(columns::bond_rigidity)) {
    double* rigidity = model.data(columns::bond_rigidity);
    std::fill(rigidity, rigidity + model.size(columns::bond_rigidity), 1.0);
  }
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    // Both sides take the chord from the lower to the higher element: their rest states are
    // opposite to the last bit.
    const double side = i < j ? 1 : -1;
    const Vector chord = rest_chord(specimen, {std::min(i, j), std::max(i, j)});
    bind(model, i, j, row, lane, side * chord);
  });
}

void Beams::bind(Model& model, std::int32_t i, std::int32_t j, std::size_t row, int lane,
                 const Vector& chord) const {
  const Specimen& specimen = model.specimen();
  const double* row_i = model.data(columns::pose) + std::ptrdiff_t{8} * i;
  const double* row_j = model.data(columns::pose) + std::ptrdiff_t{8} * j;
  const double length = norm(chord);
  const Vector direction = (1 / length) * chord;
  const auto slot = Model::at_slot(columns::rest_length, row, lane);
  const auto slot3 = Model::at_slot(columns::rest_direction, row, lane);
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  model.data(columns::rest_length)[slot] = length;
  if (model.has(columns::rest_direction))
    set_lanes_vector(model.data(columns::rest_direction), slot3, direction);
  if (model.has(columns::section_normal)) {
    const Quaternion<double> q_i = pose_orientation(row_i), q_j = pose_orientation(row_j);
    set_lanes_vector(model.data(columns::section_normal), slot3, rotate(conjugate(q_i), direction));
    set_lanes_vector(model.data(columns::far_section_normal), slot3,
                     rotate(conjugate(q_j), direction));
    model.data(columns::plastic_twist)[slot] = 2 * dot((q_j * conjugate(q_i)).v, direction);
  }
  if (model.has(columns::plastic_extension)) {
    model.data(columns::plastic_extension)[slot] = 0;
    model.data(columns::plastic_strain)[slot] = 0;
  }
  if (model.has(columns::bond_rigidity)) {
    const BeamSection<double> section =
        properties_.section(specimen.radius[a], specimen.radius[b], chord);
    const BeamRigidity<double> rigidity = properties_.rigidity(section, length);
    const double components[] = {rigidity.axial, rigidity.bending, rigidity.shear,
                                 rigidity.torsion};
    for (int k = 0; k < 4; ++k)
      model.data(columns::bond_rigidity)[Model::at_slot(columns::bond_rigidity, row, lane, k)] =
          components[k];
    if (model.has(columns::bond_radius)) model.data(columns::bond_radius)[slot] = section.radius;
  }
  if (model.has(columns::image_shift)) {
    // A whole number of periods, so that it is exact and the two sides' shifts are opposite.
    const Vector extent = specimen.domain.upper - specimen.domain.lower;
    const Vector d = chord - (pose_centre(row_j) - pose_centre(row_i));
    set_lanes_vector(
        model.data(columns::image_shift), slot3,
        {std::nearbyint(d.x / extent.x) * extent.x, std::nearbyint(d.y / extent.y) * extent.y,
         std::nearbyint(d.z / extent.z) * extent.z});
  }
}

void Beams::release(Model& model, std::size_t row, int lane) {
  for (const Column* column : slot_columns)
    if (model.has(*column) && column != &columns::bond_radius && column != &columns::bond_rigidity)
      for (int k = 0; k < column->components; ++k)
        model.data(*column)[Model::at_slot(*column, row, lane, k)] = 0;
  model.data(columns::rest_length)[Model::at_slot(columns::rest_length, row, lane)] = 1;
  if (model.has(columns::plastic_extension))
    model.data(columns::plastic_extension)[Model::at_slot(columns::plastic_extension, row, lane)] =
        -1;
}

std::vector<TimeStepCriterion> Beams::time_step_criteria(const Model& model) const {
  const double* inverse_mass = model.data(columns::inverse_mass);
  double axial = 0, bending = 0, torsion = 0;  // largest squared frequencies
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const Bond b = bond(model, i, j, row, lane);
    axial = std::max(axial, inverse_mass[i] / b.rest_length() * b.rigidity().axial);
    if (!demands_.turning()) return;
    const double inertia = model.data(columns::inverse_inertia)[i] / b.rest_length();
    bending = std::max(bending, inertia * b.rigidity().bending / 2);
    torsion = std::max(torsion, inertia * b.rigidity().torsion);
  });
  std::vector<TimeStepCriterion> criteria{{"axial stiffness of the beams", 1 / std::sqrt(axial)}};
  if (demands_.turning()) {
    criteria.push_back({"bending stiffness of the beams", 1 / std::sqrt(bending)});
    criteria.push_back({"torsional stiffness of the beams", 1 / std::sqrt(torsion)});
  }
  return criteria;
}

Beams::Bond Beams::bond(const Model& model, std::int32_t i, std::int32_t j, std::size_t row,
                        int lane) const {
  const double* pose = model.data(columns::pose);
  const double* row_i = pose + std::ptrdiff_t{8} * i;
  const double* row_j = pose + std::ptrdiff_t{8} * j;
  const Quaternion<double> q_i = pose_orientation(row_i), q_j = pose_orientation(row_j);
  const auto slot = Model::at_slot(columns::rest_length, row, lane);
  const auto slot3 = Model::at_slot(columns::rest_direction, row, lane);
  const auto number = [&](const Column& column) {
    return model.has(column) ? model.data(column)[slot] : 0.0;
  };
  const auto vector = [&](const Column& column) {
    return model.has(column) ? lanes_vector(model.data(column), slot3) : Vector{};
  };
  const Vector chord = pose_centre(row_j) - pose_centre(row_i) + vector(columns::image_shift);
  Bond result{i, j, {rigidity_, number(columns::rest_length), section_.radius, 0, yield_}, {}};
  YieldingBeam<double>& beam = result.beam;
  if (model.has(columns::bond_rigidity)) {
    const double* rigidity = model.data(columns::bond_rigidity);
    const auto component = [&](int k) {
      return rigidity[Model::at_slot(columns::bond_rigidity, row, lane, k)];
    };
    beam.rigidity = {component(0), component(1), component(2), component(3)};
    beam.radius = std::sqrt(2 * beam.rigidity.bending / beam.rigidity.axial);  // of a circle
  }
  if (beam.radius > 0)
    beam.shear_ratio =
        2 * beam.rigidity.torsion / (beam.rigidity.axial * beam.radius * beam.radius);

  const Vector rest_direction = vector(columns::rest_direction);
  BeamHistory<double> history = unyielded(rest_direction);
  if (remembers(flow_))
    history = {vector(columns::section_normal), vector(columns::far_section_normal),
               number(columns::plastic_extension), number(columns::plastic_twist),
               number(columns::plastic_strain)};
  if (flow_ == BeamFlow::scaled_offset) {
    result.response = scaled_offset_response(beam, history, rest_direction, chord, q_i, q_j);
  } else if (flow_ == BeamFlow::radial_return) {
    result.response = radial_return_response(beam, history, chord, q_i, q_j);
  } else {
    const BeamPose<double> at = beam_pose(chord, rest_direction, q_i, q_j);
    const BeamDeformation<double> deformation = beam_deformation(beam.rest_length, at);
    result.response = {beam_load(beam.rigidity, at, deformation), history,
                       equivalent_strain(beam.radius, beam.shear_ratio, at, deformation),
                       beam_energy(beam.rigidity, at, deformation), 0};
  }
  return result;
}

BeamMotion Beams::motion(Model& model) const {
  const auto where = [&](const Column& column) {
    return model.has(column) ? model.data(column) : nullptr;
  };
  BeamMotion motion{};
  motion.flow = flow_;
  motion.turning = demands_.turning();
  motion.single_precision = demands_.elasticity.precision == BeamParameters::Precision::mixed;
  motion.length_unit = mean_radius(model.specimen());
  motion.first_row = model.slots().first_row();
  motion.neighbour = model.slots().neighbours();
  motion.pose = model.data(columns::pose);
  motion.next_pose = model.next(columns::pose);
  motion.velocity = model.data(columns::velocity);
  motion.angular_velocity = where(columns::angular_velocity);
  motion.inverse_mass = model.data(columns::inverse_mass);
  motion.inverse_inertia = where(columns::inverse_inertia);
  motion.rest_direction = where(columns::rest_direction);
  motion.rest_length = model.data(columns::rest_length);
  motion.bond_rigidity = where(columns::bond_rigidity);
  motion.image_shift = where(columns::image_shift);
  motion.rigidity = rigidity_;
  motion.section_normal = where(columns::section_normal);
  motion.far_section_normal = where(columns::far_section_normal);
  motion.plastic_extension = where(columns::plastic_extension);
  motion.plastic_twist = where(columns::plastic_twist);
  motion.plastic_strain = where(columns::plastic_strain);
  motion.plastic_work = where(columns::plastic_work);
  motion.bond_radius = where(columns::bond_radius);
  motion.radius = section_.radius;
  motion.shear_ratio = section_.shear_modulus / section_.young_modulus;
  motion.yield = yield_;
  motion.rupture = rupture_;
  return motion;
}

void Beams::advance(Model& model, const Step& step) {
  BeamMotion common = motion(model);
  common.kick = step.kick;
  common.drift = step.time_step;
  breaking_.clear();
  const auto move = kernels().move_beams;
  for_blocks(model.slots().blocks(), 40, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> breaking;
    BeamMotion mine = common;
    mine.breaking = &breaking;
    move(mine, first, last);
    if (breaking.empty()) return;
#pragma omp critical(solidem_breaking)
    breaking_.insert(breaking_.end(), breaking.begin(), breaking.end());
  });
  std::sort(breaking_.begin(), breaking_.end());
}

void Beams::accelerate(Model& model) const {
  BeamMotion elastic = motion(model);
  elastic.kick = 1;
  elastic.yield = {never, 0};
  elastic.rupture = {never, never};
  for_blocks(model.slots().blocks(), 40, [&](std::size_t first, std::size_t last) {
    kernels().move_beams(elastic, first, last);
  });
}

double Beams::longest_time_step(double squared_frequency) const {
  return 2 / std::sqrt(squared_frequency);
}

void Beams::for_each_pair(const Model& model, const PairVisit& visit) const {
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i < j) visit(i, j, bond(model, i, j, row, lane).load().force);
  });
}

void Beams::observe(const Model& model, Observation& observation) const {
  const std::size_t count = model.slots().padded_elements(), blocks = model.slots().blocks();
  ObservedMotion& motion = observation.motion;
  motion.force.assign(count, {});
  motion.moment.assign(count, {});
  std::vector<double> energy(blocks, 0.0), work(blocks, 0.0);
  for_blocks(blocks, 40, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block)
      model.slots().for_each_in(block,
                                [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
                                  const Bond b = bond(model, i, j, row, lane);
                                  motion.force[static_cast<std::size_t>(i)] += b.load().force;
                                  motion.moment[static_cast<std::size_t>(i)] += b.load().moment_i;
                                  energy[block] += 0.5 * b.energy();
                                  work[block] += 0.5 * b.response.plastic_work;
                                });
  });
  double elastic = 0;
  for (const double part : energy) elastic += part;
  observation.energies.add(EnergyLedger::Kind::stored, "elastic_energy", elastic);
  if (demands_.plasticity) {
    double plastic = 0;
    for (const double part : work) plastic += part;
    const double* kept = model.data(columns::plastic_work);
    for (std::size_t i = 0; i < model.elements(); ++i) plastic += kept[i];
    observation.energies.add(EnergyLedger::Kind::dissipated, "plastic_work", plastic);
  }

  const double* velocity = model.data(columns::velocity);
  const double* inverse_mass = model.data(columns::inverse_mass);
  const bool turning = demands_.turning();
  const double* spin = turning ? model.data(columns::angular_velocity) : nullptr;
  const double* inverse_inertia = turning ? model.data(columns::inverse_inertia) : nullptr;
  const std::size_t elements = model.elements();
  motion.force.resize(elements);
  motion.moment.resize(elements);
  motion.velocity.resize(elements);
  motion.angular_velocity.resize(turning ? elements : 0);
  motion.kinetic_energy = 0;
  for (std::size_t i = 0; i < elements; ++i) {
    if (!(inverse_mass[i] > 0)) continue;  // removed
    const std::size_t at = Model::at(columns::velocity, i);
    Vector& v = motion.velocity[i];
    v = lanes_vector(velocity, at) + (observation.behind * inverse_mass[i]) * motion.force[i];
    motion.kinetic_energy += 0.5 * dot(v, v) / inverse_mass[i];
    if (!turning) continue;
    Vector& w = motion.angular_velocity[i];
    w = lanes_vector(spin, at) + (observation.behind * inverse_inertia[i]) * motion.moment[i];
    motion.kinetic_energy += 0.5 * dot(w, w) / inverse_inertia[i];
  }
}

double Beams::spent(const Model& model) const {
  double work = 0;
  if (model.has(columns::plastic_work))
    for (std::size_t i = 0; i < model.elements(); ++i) work += model.data(columns::plastic_work)[i];
  return work;
}

void Beams::show(const Model& model, Frame& frame) const {
  if (model.has(columns::plastic_work)) {
    const double* work = model.data(columns::plastic_work);
    frame.add("plastic_work", {work, work + model.elements()});
  }
  if (!demands_.plasticity && !demands_.rupture) return;
  std::vector<double> had(model.elements(), 0), broken(model.elements(), 0);
  std::vector<double> stress, plastic_strain, intact;
  for (const Pair& pair : frame.bonds()) {
    const auto place = model.slots().find(pair.i, pair.j);
    for (const std::int32_t element : {pair.i, pair.j}) {
      had[static_cast<std::size_t>(element)] += 1;
      if (!place) broken[static_cast<std::size_t>(element)] += 1;
    }
    intact.push_back(place ? 1 : 0);
    stress.push_back(0);
    plastic_strain.push_back(0);
    if (!place) continue;
    const Bond b = bond(model, pair.i, pair.j, place->row, place->lane);
    stress.back() = b.rigidity().axial / b.section() * b.response.strain;
    plastic_strain.back() = b.response.history.strain;
  }
  for (std::size_t i = 0; i < had.size(); ++i)
    if (had[i] > 0) broken[i] /= had[i];
  frame.add("broken_bonds", broken);
  frame.add_of_bonds("stress", stress);
  frame.add_of_bonds("plastic_strain", plastic_strain);
  frame.add_of_bonds("intact", intact);
}

}  // namespace solidem
