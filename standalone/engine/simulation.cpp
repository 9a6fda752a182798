// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "effects/beams.hpp"
#include "effects/central_forces.hpp"
#include "effects/contact.hpp"
#include "effects/damage.hpp"
#include "effects/grips.hpp"
#include "effects/rupture.hpp"
#include "engine/gauge.hpp"
#include "engine/heat.hpp"
#include "engine/sensors.hpp"
#include "engine/stability.hpp"
#include "model/error.hpp"
#include "solve/heat_integrator.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

namespace {

constexpr double default_ratio = 0.3;
constexpr double default_rows = 200;
constexpr std::int64_t check_every = 256;  // steps between two looks at the energy

/// Figures by which a checkpoint knows the specimen that it was made of.
std::vector<double> marks_of(const Model& model) {
  Vector position{};
  double radius = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    position += model.specimen().position[i];
    radius += model.specimen().radius[i];
  }
  return {static_cast<double>(model.elements()),
          static_cast<double>(model.slots().bonds()),
          position.x,
          position.y,
          position.z,
          radius};
}

std::vector<double> densities(const std::vector<Material>& materials,
                              const std::vector<std::size_t>& of_element) {
  if (materials.size() == 1) return {materials[0].density};
  std::vector<double> values;
  for (const std::size_t m : of_element) values.push_back(materials[m].density);
  return values;
}

}  // namespace

Simulation::Simulation(const Setup& setup, Specimen specimen, bool force)
    : setup_(setup), model_(make_model(std::move(specimen))) {
  if (!setup_.has_motion() && !setup_.conduction)
    throw InputError(
        "the scene names no effect, so there is nothing to simulate; add [beams], "
        "[central_forces] or [conduction]");
  plan_ = make_plan(setup_, model_.specimen().domain.is_periodic());
  for (const PlannedColumn& planned : plan_.columns) model_.add(*planned.column);
  const std::vector<std::size_t> material = assign_materials(setup_.materials, model_.specimen());
  if (setup_.has_motion()) add_motion(densities(setup_.materials, material));
  if (setup_.conduction)
    heat_ = std::make_unique<Heat>(setup_, std::move(*geometry_), material, model_, selections_);
  geometry_.reset();
  add_observers();
  choose_time_step(force);
  if (heat_ != nullptr) heat_->start(static_cast<double>(steps_to_run()) * time_step_.value);
  take_stock();
  // Of bonds that are strained by round-off, with a wide margin.
  if (mechanics_ != nullptr)
    round_off_energy_ =
        1e-18 * static_cast<double>(model_.slots().bonds()) * mechanics_->typical_energy(model_);
}

Model Simulation::make_model(Specimen specimen) {
  // Components and bond counts are found while the list of bonds is still there.
  if (setup_.gauge) selections_["component"] = largest_component(specimen);
  std::optional<std::vector<Pair>> conductors;
  if (setup_.conduction) {
    const bool by_faces = setup_.conduction->law == ConductionParameters::Law::voronoi;
    // Heat passes where elements touch, not along fibres nor as far as central forces reach.
    const bool past_fibres = !by_faces && setup_.beams && setup_.beams->fibres;
    const bool by_touch = !by_faces && setup_.central_forces;
    std::vector<Pair> bonds;
    if (past_fibres) bonds = std::exchange(specimen.bonds, bonds_in_contact(specimen));
    if (by_touch) bonds = std::exchange(specimen.bonds, find_bonds(specimen, 0));
    geometry_ = std::make_unique<ConductionGeometry>(
        scaled_geometry(*setup_.conduction, specimen, setup_.conduction->area_factor));
    if (past_fibres || by_touch) conductors = std::exchange(specimen.bonds, std::move(bonds));
    // Where nothing but heat is simulated, the faces are all that bonds are needed for.
    if (by_faces && !setup_.has_motion()) specimen.bonds = geometry_->faces;
    if (by_faces && setup_.has_motion()) conductors = geometry_->faces;
    // Bonds that break or form must not take the places of pairs that conduct.
    if (setup_.rupture && !conductors) conductors = specimen.bonds;
  }
  const std::vector<std::int32_t> bonds = count_bonds(specimen);
  unbonded_ = static_cast<std::size_t>(std::count(bonds.begin(), bonds.end(), 0));
  return Model(std::move(specimen), conductors);
}

Simulation::~Simulation() = default;

std::vector<Pair> Simulation::pairs() const {
  return central_forces_ != nullptr ? central_forces_->initial_pairs() : model_.slots().pairs();
}

void Simulation::add_beams(const std::vector<double>& mass) {
  auto beams = std::make_unique<Beams>(demands_of(setup_), mass, model_);
  mechanics_ = beams_ = beams.get();
  effects_.push_back(std::move(beams));
  if (setup_.rupture) {
    auto rupture = std::make_unique<Rupture>(*setup_.rupture, *beams_, model_);
    rupture_ = rupture.get();
    effects_.push_back(std::move(rupture));
  }
  if (setup_.contact)
    effects_.push_back(
        std::make_unique<ElementContacts>(*setup_.contact, *beams_, *rupture_, model_));
}

void Simulation::add_central_forces(const std::vector<double>& mass) {
  auto forces = std::make_unique<CentralForces>(*setup_.central_forces, mass, model_);
  mechanics_ = central_forces_ = forces.get();
  if (setup_.damage) {
    auto damage = std::make_unique<Damage>(*setup_.damage, *central_forces_, model_);
    damage_ = damage.get();
    effects_.push_back(std::move(damage));
  }
  effects_.push_back(std::move(forces));
}

void Simulation::add_motion(const std::vector<double>& density) {
  const std::vector<double> mass = represented_mass(model_.specimen(), density);
  if (setup_.beams) add_beams(mass);
  if (setup_.central_forces) add_central_forces(mass);
  for (const InitialVelocity& initial : setup_.initial_velocities)
    for (const std::int32_t e : select(initial.region, model_.specimen())) {
      const Domain& domain = model_.specimen().domain;
      const auto i = static_cast<std::size_t>(e);
      const Vector from_middle =
          model_.specimen().position[i] - 0.5 * (domain.lower + domain.upper);
      for (int axis = 0; axis < 3; ++axis) {
        const double v = component(initial.velocity, axis) +
                         component(initial.stretching, axis) * component(from_middle, axis);
        model_.data(columns::velocity)[Model::at(columns::velocity, i, axis)] = v;
        if (model_.has(columns::carried_velocity))
          model_.data(columns::carried_velocity)[4 * i + static_cast<std::size_t>(axis)] = v;
      }
    }
  std::map<std::int32_t, std::string> gripped;
  for (const GripParameters& grip : setup_.grips) {
    std::vector<std::int32_t> elements =
        select_some(selections_, "grip." + grip.name, grip.region, model_.specimen());
    claim(gripped, elements, "[[grips]]", grip.name, model_.specimen());
    auto made = std::make_unique<Grip>(grip, std::move(elements), mass, model_);
    const auto acts = [](const AxisControl& axis) { return axis.kind != AxisControl::Kind::free; };
    if (std::any_of(grip.axis.begin(), grip.axis.end(), acts))
      mechanics_->expect_driven(made->elements());
    effects_.push_back(std::move(made));
  }
}

void Simulation::add_observers() {
  if (setup_.gauge) {
    auto gauge = std::make_unique<GaugeSection>(*setup_.gauge, selections_["component"],
                                                *mechanics_, model_);
    selections_.erase("component");
    selections_["gauge"] = gauge->elements();
    observers_.push_back(std::move(gauge));
  }
  for (const Sensor& sensor : setup_.sensors) {
    auto point = std::make_unique<PointSensor>(sensor, model_);
    selections_["sensor." + sensor.name] = {point->element()};
    observers_.push_back(std::move(point));
  }
}

void Simulation::choose_time_step(bool force) {
  const bool explicit_heat = heat_ != nullptr && heat_->takes_explicit_steps();
  std::vector<TimeStepCriterion> criteria;
  // Contacts that take the places of bonds may be stiffer than these; root of the stiffness.
  const double stiffer =
      setup_.contact ? std::sqrt(std::max(1.0, setup_.contact->stiffness_ratio)) : 1.0;
  if (mechanics_ != nullptr) criteria = mechanics_->time_step_criteria(model_);
  if (beams_ != nullptr && stiffer > 1)
    criteria.push_back({"stiffness of contacts", criteria.front().value / stiffer});
  if (heat_ != nullptr && (explicit_heat || mechanics_ == nullptr))
    criteria.push_back(heat_->criterion());
  TimeStepChoice& choice = time_step_;
  choice.bound = choice.limit = std::numeric_limits<double>::infinity();
  for (const TimeStepCriterion& criterion : criteria)
    if (criterion.value < choice.bound) {
      choice.bound = criterion.value;
      choice.criterion = criterion.name;
    }
  if (mechanics_ != nullptr) choice.limit = stable_time_step(*mechanics_, model_) / stiffer;
  if (explicit_heat) choice.limit = std::min(choice.limit, heat_->limit());
  const RunControl& run = setup_.run;
  // Heat that is not bound by stability takes as many steps as the history has rows.
  const bool free_steps = heat_ != nullptr && !explicit_heat && mechanics_ == nullptr;
  const double by_default = free_steps && run.duration && !run.time_step_ratio
                                ? *run.duration / default_rows
                                : run.time_step_ratio.value_or(default_ratio) * choice.bound;
  choice.value = run.time_step.value_or(by_default);
  if (!std::isfinite(choice.value))
    throw InputError(
        "[run] nothing bounds the time step: the specimen has no bonds. Give time_step, "
        "or a larger [bonds] tolerance");
  choice.ratio = choice.value / choice.bound;
  if (choice.value > choice.limit && !force)
    throw InputError("[run] time step " + text(choice.value) + " s is beyond the stable limit " +
                     text(choice.limit) + " s (" + choice.criterion + ": " + text(choice.bound) +
                     " s); take a smaller one, or --force it");
}

std::int64_t Simulation::steps_to_run() const {
  if (setup_.run.steps) return *setup_.run.steps;
  return static_cast<std::int64_t>(
      std::ceil(setup_.run.duration.value_or(0) / time_step_.value * (1 - 1e-12)));
}

void Simulation::insist_on_bounded_energy() {
  // All that moves was paid for: by the start or by the grips. Velocities are half a step behind
  // and the integrator swings a little about the energy, hence the factor.
  constexpr double factor = 2;
  double kinetic = 0;
  const double* velocity = model_.data(columns::velocity);
  const double* inverse_mass = model_.data(columns::inverse_mass);
  for (std::size_t i = 0; i < model_.elements(); ++i) {
    if (!(inverse_mass[i] > 0)) continue;
    const std::size_t at = Model::at(columns::velocity, i);
    const Vector v{velocity[at], velocity[at + lanes], velocity[at + std::size_t{2} * lanes]};
    kinetic += 0.5 * dot(v, v) / inverse_mass[i];
  }
  double spent = kinetic;
  if (model_.has(columns::plastic_work))
    for (std::size_t i = 0; i < model_.elements(); ++i)
      spent += model_.data(columns::plastic_work)[i];
  double work = initial_energy_ + mechanics_->releasable_energy(model_);
  for (const auto& effect : effects_) work += effect->work();
  largest_work_ = std::max(largest_work_, work);
  if (spent <= factor * largest_work_ + round_off_energy_) return;
  throw RunError("the run diverged: at step " + std::to_string(step_) + " (time " + text(time()) +
                 " s) the elements move with " + text(kinetic) + " J and " + text(spent - kinetic) +
                 " J went into plastic flow, but no more than " + text(largest_work_) +
                 " J were ever put in; time step " + text(time_step_.value) +
                 " s, stable limit at the start " + text(time_step_.limit) + " s");
}

void Simulation::take_stock() {
  Observation start;
  observe(start);
  initial_energy_ = start.motion.kinetic_energy + start.motion.elastic_energy;
}

void Simulation::advance(std::int64_t steps) {
  // Whatever moves when the first step begins was put there.
  if (step_ == 0 && steps > 0 && mechanics_ != nullptr) take_stock();
  for (std::int64_t n = 0; n < steps; ++n) {
    if (mechanics_ != nullptr && step_ % check_every == 0) insist_on_bounded_energy();
    const double dt = time_step_.value;
    const Step step{time(), dt, step_ == 0 ? 0.5 * dt : dt};
    for (const auto& effect : effects_) effect->advance(model_, step);
    if (mechanics_ != nullptr) model_.swap(model_.place_column());
    if (model_.has(columns::carried_velocity)) model_.swap(columns::carried_velocity);
    if (damage_ != nullptr) damage_->look();
    if (heat_ != nullptr) heat_->advance(step);
    ++step_;
  }
}

std::vector<Effect*> Simulation::all_effects() const {
  std::vector<Effect*> all;
  for (const auto& effect : effects_) all.push_back(effect.get());
  if (heat_ != nullptr)
    for (const auto& effect : heat_->effects()) all.push_back(effect.get());
  return all;
}

HistoryRow Simulation::observe() const {
  Observation observation;
  return observe(observation);
}

HistoryRow Simulation::observe(Observation& observation) const {
  observation.time = time();
  observation.behind = step_ == 0 ? 0 : 0.5 * time_step_.value;
  for (const Effect* effect : all_effects()) effect->observe(model_, observation);
  for (const auto& observer : observers_) observer->observe(model_, observation);

  HistoryRow row{step_, time(), {}};
  if (mechanics_ != nullptr) {
    const ObservedMotion& motion = observation.motion;
    const double energy = motion.kinetic_energy + motion.elastic_energy + motion.contact_energy +
                          motion.plastic_work + motion.fracture_energy + motion.dissipated_energy;
    row.values.emplace_back("kinetic_energy", motion.kinetic_energy);
    row.values.emplace_back(beams_ != nullptr ? "elastic_energy" : "potential_energy",
                            motion.elastic_energy);
    if (model_.has(columns::dissipated_energy))
      row.values.emplace_back("dissipated_energy", motion.dissipated_energy);
    if (setup_.contact) row.values.emplace_back("contact_energy", motion.contact_energy);
    if (setup_.plasticity) row.values.emplace_back("plastic_work", motion.plastic_work);
    if (setup_.rupture) row.values.emplace_back("fracture_energy", motion.fracture_energy);
    row.values.emplace_back("external_work", motion.external_work);
    row.values.emplace_back("energy_balance", energy - initial_energy_ - motion.external_work);
  }
  if (heat_ != nullptr) {
    const ObservedHeat& heat = observation.heat;
    row.values.emplace_back("thermal_energy", heat.thermal_energy);
    row.values.emplace_back("heat_input", heat.heat_input);
    row.values.emplace_back("heat_balance", heat.thermal_energy - heat.heat_input);
  }
  row.values.insert(row.values.end(), observation.values.begin(), observation.values.end());
  for (const auto& [name, value] : row.values)
    if (!std::isfinite(value))
      throw RunError("the run diverged: " + name + " is " + text(value) + " at step " +
                     std::to_string(step_) + " (time " + text(time()) + " s); time step " +
                     text(time_step_.value) + " s, stable limit at the start " +
                     text(time_step_.limit) + " s");
  return row;
}

bool Simulation::changes(const Column& column) const {
  // Where bonds break and form, whatever belongs to a slot may change, and elements may be removed.
  return column.dynamic || (rupture_ != nullptr && column.site != Site::conductor);
}

std::map<std::string, std::vector<double>> Simulation::save() const {
  std::map<std::string, std::vector<double>> saved;
  for (const PlannedColumn& planned : plan_.columns) {
    if (!changes(*planned.column)) continue;
    const double* data = model_.data(*planned.column);
    saved[std::string("column.") + planned.column->name] =
        std::vector<double>(data, data + model_.size(*planned.column));
  }
  const std::vector<Effect*> effects = all_effects();
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (const std::vector<double> sums = effects[k]->save(); !sums.empty())
      saved["effect." + plan_.effects[k].name] = sums;
  saved["initial_energy"] = {initial_energy_};
  saved["largest_work"] = {largest_work_};
  saved["time_step"] = {time_step_.value};
  if (heat_ != nullptr && heat_->integrator() != nullptr)
    saved["integrator"] = heat_->integrator()->save();
  saved["specimen"] = marks_of(model_);
  return saved;
}

void Simulation::restore(std::int64_t step,
                         const std::map<std::string, std::vector<double>>& saved) {
  const auto find = [&](const std::string& name) -> const std::vector<double>& {
    const auto found = saved.find(name);
    if (found == saved.end())
      throw InputError("the checkpoint has no " + name + ": it is of another scene");
    return found->second;
  };
  if (find("specimen") != marks_of(model_))
    throw InputError(
        "the checkpoint was made of another specimen; resume with the one it began with");
  if (find("time_step").at(0) != time_step_.value)
    throw InputError("the checkpoint was made with a time step of " +
                     text(find("time_step").at(0)) + " s, the scene asks for " +
                     text(time_step_.value) + " s; resume with the same");
  for (const PlannedColumn& planned : plan_.columns) {
    if (!changes(*planned.column)) continue;
    const std::vector<double>& values = find(std::string("column.") + planned.column->name);
    if (values.size() != model_.size(*planned.column))
      throw InputError(std::string("the checkpoint's column ") + planned.column->name + " has " +
                       std::to_string(values.size()) + " values, this specimen needs " +
                       std::to_string(model_.size(*planned.column)));
    std::copy(values.begin(), values.end(), model_.data(*planned.column));
  }
  const std::vector<Effect*> effects = all_effects();
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (!effects[k]->save().empty()) effects[k]->restore(find("effect." + plan_.effects[k].name));
  if (heat_ != nullptr && heat_->integrator() != nullptr)
    heat_->integrator()->restore(find("integrator"));
  initial_energy_ = find("initial_energy").at(0);
  largest_work_ = find("largest_work").at(0);
  step_ = step;
}

}  // namespace solidem
