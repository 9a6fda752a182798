// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beams.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <variant>

#include "effects/beam_parameters.hpp"
#include "effects/bond_slot.hpp"
#include "effects/bond_temperature.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem {

namespace {

/// Some hundred microseconds of work: below, waking a second thread costs as much as it saves, and
/// on a busy machine many times more.
constexpr std::size_t least_blocks_of_beams = 100;

/// Writes the components of a column in a slot.
void set_slot(Model& model, const Column& column, std::size_t row, int lane,
              const double* components) {
  for (int k = 0; k < column.components; ++k)
    model.data(column)[Model::at_slot(column, row, lane, k)] = components[k];
}

}  // namespace

BeamDemands demands_of(const Setup& setup) {
  const auto& contact = setup.get<ContactParameters>();
  return {setup.get<BeamParameters>().value(),
          setup.get<PlasticityParameters>(),
          setup.get<RuptureParameters>(),
          contact && contact->rebonding_pressure,
          setup.get<ExpansionParameters>().has_value(),
          setup.get<SofteningParameters>().has_value()};
}

Watch BeamDemands::watch() const {
  // A bond that is made between elements which have turned must remember its normals.
  if (plasticity || rebonding) return Watch::remembering;
  return rupture ? Watch::watched : Watch::elastic;
}

bool BeamDemands::looks_at_all() const {
  return (plasticity && plasticity->section != JudgedSection::middle) ||
         (rupture && rupture->section != JudgedSection::middle);
}

std::vector<BeamPairing> BeamDemands::pairings() const {
  if (elasticity.materials.empty()) return {};
  return solidem::pairings(elasticity, yield());
}

BondNeeds BeamDemands::needs(bool periodic) const {
  const bool since_made = plasticity && plasticity->law == FlowRule::scaled_offset;
  return {has_rotation(),
          watch() == Watch::remembering,
          since_made,
          !beams_are_alike(elasticity) || softens,
          watch() != Watch::elastic && !limits_are_alike(pairings()),
          feels_rate(),
          watch() != Watch::elastic,
          periodic,
          expands,
          softens};
}

std::vector<const Column*> Beams::columns(const BeamDemands& demands, bool periodic) {
  std::vector<const Column*> asked = {&columns::pose, &columns::velocity, &columns::inverse_mass};
  if (demands.has_rotation())
    asked.insert(asked.end(), {&columns::angular_velocity, &columns::inverse_inertia});
  if (demands.watch() == Watch::remembering) asked.push_back(&columns::plastic_work);
  if (demands.plasticity) asked.push_back(&columns::last_pose);
  if (demands.feels_temperature()) asked.push_back(&columns::temperature);
  for (const BondColumn& kept : bond_columns)
    if (kept.is_needed(demands.needs(periodic))) asked.push_back(kept.column);
  return asked;
}

Beams::Beams(const BeamDemands& demands, const std::vector<double>& mass, Model& model)
    : demands_(demands), properties_(demands.elasticity, model.specimen(), demands.yield()) {
  const Specimen& specimen = model.specimen();
  section_ = properties_.common_section();
  rigidity_ = properties_.rigidity(section_, 1);
  least_limit_ = limit_of({}, 0);
  for (const BeamPairing& pair : demands_.pairings())
    least_limit_ = std::min(least_limit_, limit_of(pair.limits, 0));

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
    if (demands_.has_rotation())
      model.data(columns::inverse_inertia)[i] = 1 / sphere_inertia(mass[i], specimen.radius[i]);
  }

  if (model.has(columns::last_pose))
    std::copy_n(poses[0], model.size(columns::pose), model.data(columns::last_pose));
  for (const BondColumn& kept : bond_columns)
    if (model.has(*kept.column))
      std::fill_n(model.data(*kept.column), model.size(*kept.column), kept.empty);
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    // Both sides take the chord from the lower to the higher element: their rest states are
    // opposite to the last bit.
    const double side = i < j ? 1 : -1;
    const Vector chord = rest_chord(specimen, {std::min(i, j), std::max(i, j)});
    bind(model, i, j, row, lane, side * chord);
  });
  if (demands_.feels_rate()) rate_time_ = time_of_rates(model);
}

double Beams::time_of_rates(const Model& model) const {
  if (demands_.plasticity->rate_time) return *demands_.plasticity->rate_time;
  constexpr double swings = 100;  // far above those of bonds
  double shortest = unlimited;
  for (const TimeStepCriterion& criterion : time_step_criteria(model))
    shortest = std::min(shortest, criterion.value);
  return swings * shortest;
}

void Beams::state(Archive& archive) {
  if (demands_.feels_rate()) archive(time_, time_step_);
}

double Beams::temperature_of(const Model& model, std::int32_t i, std::int32_t j) const {
  if (!demands_.feels_temperature()) return 0;
  const double* temperature = model.data(columns::temperature);
  return 0.5 * (temperature[i] + temperature[j]);
}

void Beams::refresh_limits(Model& model) const {
  if (!demands_.feels_temperature() || demands_.looks_at_all()) return;
  double* limits = model.data(columns::limit_strain);
  const double* plastic_strain = model.data(columns::plastic_strain);
  const BeamMotion columns_now = columns_of(model);
  for_blocks(model.slots().blocks(), 40, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block)
      model.slots().for_each_in(block, [&](std::int32_t i, std::int32_t j, std::size_t row,
                                           int lane) {
        const std::size_t at = Slots::Place{row, lane}.index();
        const LimitScale<double> scale = limit_scale<double>(columns_now, SlotReader{row, lane});
        limits[at] = std::copysign(limit_strain(yield(), flow_rule(), rupture(), plastic_strain[at],
                                                scale, temperature_of(model, i, j)),
                                   limits[at]);
      });
  });
}

NewBond Beams::new_bond(const Model& model, std::int32_t i, std::int32_t j,
                        const Vector& chord) const {
  const Specimen& specimen = model.specimen();
  const double* row_i = model.data(columns::pose) + std::ptrdiff_t{8} * i;
  const double* row_j = model.data(columns::pose) + std::ptrdiff_t{8} * j;
  const Quaternion<double> q_i = pose_orientation(row_i), q_j = pose_orientation(row_j);
  const double length = norm(chord);
  const Vector direction = (1 / length) * chord;
  const BeamSection<double> section = properties_.section(specimen, {i, j}, chord);
  Vector image_shift{};
  if (model.has(columns::image_shift)) {
    // A whole number of periods, so that it is exact and the two sides' shifts are opposite.
    const Vector extent = specimen.domain.upper - specimen.domain.lower;
    const Vector d = chord - (pose_centre(row_j) - pose_centre(row_i));
    image_shift = {std::nearbyint(d.x / extent.x) * extent.x,
                   std::nearbyint(d.y / extent.y) * extent.y,
                   std::nearbyint(d.z / extent.z) * extent.z};
  }
  const Vector normal_i = rotate(conjugate(q_i), direction);
  const Vector normal_j = rotate(conjugate(q_j), direction);
  const double twist = 2 * dot((q_j * conjugate(q_i)).v, direction);
  const bool has_shape = norm(normal_j - normal_i) > 0 || std::fabs(twist) > 0;
  const LimitScale<double> limits = properties_.limits({i, j});
  const double limit = limit_of(limits, temperature_of(model, i, j));
  return {length,
          direction,
          normal_i,
          normal_j,
          twist,
          section.radius,
          properties_.rigidity(section, length),
          image_shift,
          limits,
          has_shape ? -limit : limit};
}

double Beams::limit_of(const LimitScale<double>& scale, double temperature) const {
  if (demands_.looks_at_all()) return 0;
  return limit_strain(yield(), flow_rule(), rupture(), 0, scale, temperature);
}

void Beams::bind(Model& model, std::int32_t i, std::int32_t j, std::size_t row, int lane,
                 const Vector& chord) const {
  const NewBond bond = new_bond(model, i, j, chord);
  for (const BondColumn& kept : bond_columns) {
    if (!model.has(*kept.column)) continue;
    double components[4];
    kept.write(bond, components);
    set_slot(model, *kept.column, row, lane, components);
  }
}

void Beams::release(Model& model, std::size_t row, int lane) {
  for (const BondColumn& kept : bond_columns) {
    if (!model.has(*kept.column)) continue;
    const double components[] = {kept.empty, kept.empty, kept.empty, kept.empty};
    set_slot(model, *kept.column, row, lane, components);
  }
}

std::vector<TimeStepCriterion> Beams::time_step_criteria(const Model& model) const {
  const double* inverse_mass = model.data(columns::inverse_mass);
  double axial = 0, bending = 0, torsion = 0;  // largest squared frequencies
  const BeamMotion columns_now = columns_of(model);
  model.slots().for_each([&](std::int32_t i, std::int32_t /*j*/, std::size_t row, int lane) {
    const SlotReader slot{row, lane};
    const double rest_length = slot.number(columns_now.rest_length);
    const BeamRigidity<double> rigidity = rigidity_in<double>(columns_now, slot);
    axial = std::max(axial, inverse_mass[i] / rest_length * rigidity.axial);
    if (!demands_.has_rotation()) return;
    const double inertia = columns_now.inverse_inertia[i] / rest_length;
    bending = std::max(bending, inertia * rigidity.bending / 2);
    torsion = std::max(torsion, inertia * rigidity.torsion);
  });
  std::vector<TimeStepCriterion> criteria{{"axial stiffness of the beams", 1 / std::sqrt(axial)}};
  if (demands_.has_rotation()) {
    criteria.push_back({"bending stiffness of the beams", 1 / std::sqrt(bending)});
    criteria.push_back({"torsional stiffness of the beams", 1 / std::sqrt(torsion)});
  }
  return criteria;
}

Beams::Bond Beams::bond(const Model& model, std::int32_t i, std::int32_t j, std::size_t row,
                        int lane) const {
  return bond(columns_of(model), i, j, row, lane);
}

Beams::Bond Beams::bond(const BeamMotion& m, std::int32_t i, std::int32_t j, std::size_t row,
                        int lane) const {
  const SlotReader slot{row, lane};
  const BondKind kind = bond_kind(m);
  const BeamEnds<double> ends = ends_in(m.pose, m, slot, i, j);
  const auto& [chord, q_i, q_j] = ends;
  BondNow<double> now = bond_in(m, slot, ends);
  if (kind.remembers) now.history.strain = slot.number(m.plastic_strain);

  YieldingBeam<double> beam{now.rigidity,    now.rest_length,  m.radius, 0,
                            m.yield_section, m.rupture_section};
  if (kind.per_bond_rigidity)
    beam.radius = std::sqrt(2 * beam.rigidity.bending / beam.rigidity.axial);  // of a circle
  if (beam.radius > 0)
    beam.shear_ratio =
        2 * beam.rigidity.torsion / (beam.rigidity.axial * beam.radius * beam.radius);
  if (m.yield == nullptr || m.last_pose == nullptr)  // who flows has both
    return {i, j, chord, beam,
            elastic_response<double>(beam, now.history, {now.pose, now.deformation})};
  const BeamEnds<double> last = ends_in(m.last_pose, m, slot, i, j);
  const Quaternion<double> turn = q_i * conjugate(last.orientation_i);
  const PosedBeam<double> at = posed_beam(kind, m, slot, m.flow_rule, now, q_i, q_j);
  const LastBeam<double> before =
      last_beam(kind, now, q_i, rotate(turn, last.chord), turn * last.orientation_j);
  const auto respond = [&](const auto& law) {
    const double temperature =
        m.temperature == nullptr ? 0 : 0.5 * (m.temperature[i] + m.temperature[j]);
    return with_scale(law, limit_scale<double>(m, slot), [&](const auto& own) {
      const auto curve = yield_curve(own, m, slot, temperature, now.history.strain);
      return flow_response(m.flow_rule, curve, beam, now.history, at, before);
    });
  };
  return {i, j, chord, beam, std::visit(respond, *m.yield)};
}

BeamMotion Beams::columns_of(const Model& model) const {
  return motion(const_cast<Model&>(model));  // who looks changes nothing
}

BeamMotion Beams::motion(Model& model) const {
  const auto where = [&](const Column& column) {
    return model.has(column) ? model.data(column) : nullptr;
  };
  BeamMotion motion{};
  motion.watch = demands_.watch();
  motion.has_rotation = demands_.has_rotation();
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
  motion.last_pose = where(columns::last_pose);
  motion.plastic_work = where(columns::plastic_work);
  motion.bond_radius = where(columns::bond_radius);
  motion.bond_limits = where(columns::bond_limits);
  motion.temperature = demands_.feels_temperature() ? model.data(columns::temperature) : nullptr;
  motion.flow_rate = where(columns::flow_rate);
  motion.flow_time = where(columns::flow_time);
  motion.time = time_;
  motion.rate_time = rate_time_;
  motion.rate_per_flow =
      time_step_ > 0 ? -std::expm1(-time_step_ / rate_time_) / time_step_ : 1 / rate_time_;
  motion.radius = section_.radius;
  motion.shear_ratio = section_.shear_modulus / section_.young_modulus;
  motion.limit_strain = where(columns::limit_strain);
  motion.common_limit_strain = least_limit_;
  motion.yield = yield();
  motion.flow_rule = flow_rule();
  motion.rupture_section = demands_.rupture ? demands_.rupture->section : JudgedSection::middle;
  motion.yield_section =
      demands_.plasticity ? demands_.plasticity->section : motion.rupture_section;
  motion.look_at_all = demands_.looks_at_all();
  motion.rupture = rupture();
  return motion;
}

void Beams::advance(Model& model, const Step& step) {
  time_ = step.time;
  time_step_ = step.time_step;
  BeamMotion common = motion(model);
  common.kick = step.kick;
  common.drift = step.time_step;
  breaking_.clear();
  const auto move = kernels().move_beams;
  std::mutex gathering;
  for_blocks(model.slots().blocks(), least_blocks_of_beams,
             [&](std::size_t first, std::size_t last) {
               std::vector<std::uint32_t> breaking;
               BeamMotion mine = common;
               mine.breaking = &breaking;
               move(mine, first, last);
               if (breaking.empty()) return;
               const std::lock_guard<std::mutex> lock(gathering);
               breaking_.insert(breaking_.end(), breaking.begin(), breaking.end());
             });
  std::sort(breaking_.begin(), breaking_.end());
}

void Beams::accelerate(Model& model) const {
  BeamMotion elastic = motion(model);
  elastic.kick = 1;
  elastic.yield = nullptr;
  elastic.rupture = nullptr;
  for_blocks(
      model.slots().blocks(), least_blocks_of_beams,
      [&](std::size_t first, std::size_t last) { kernels().move_beams(elastic, first, last); });
}

double Beams::longest_time_step(double squared_frequency) const {
  return 2 / std::sqrt(squared_frequency);
}

double Beams::mean_stiffness(const Model& model) const {
  const BeamMotion columns_now = columns_of(model);
  double sum = 0;
  std::size_t count = 0;
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i > j) return;
    const Bond one = bond(columns_now, i, j, row, lane);
    sum += one.rigidity().axial / one.rest_length();
    ++count;
  });
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

void Beams::finish_move(Model& model) {
  if (model.has(columns::last_pose))
    model.swap(columns::pose, columns::last_pose);
  else
    model.swap(columns::pose);
  time_ += time_step_;
}

}  // namespace solidem
