// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "effects/beams.hpp"
#include "effects/conduction.hpp"
#include "effects/grips.hpp"
#include "effects/heat_exchange.hpp"
#include "effects/heat_flux.hpp"
#include "effects/heat_source.hpp"
#include "engine/gauge.hpp"
#include "engine/heated_model.hpp"
#include "engine/sensors.hpp"
#include "engine/stability.hpp"
#include "model/error.hpp"
#include "solve/heat_integrator.hpp"
#include "solve/relative_conductivity.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

namespace {

constexpr double default_ratio = 0.3;
constexpr double default_rows = 200;

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

std::string place(const Specimen& specimen, std::size_t i) {
  const Vector& p = specimen.position[i];
  return "element " + std::to_string(i) + " at (" + text(p.x) + ", " + text(p.y) + ", " +
         text(p.z) + ") m";
}

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

/// The material of each element, or nothing where there is but one for all. Every element must lie
/// in the region of exactly one.
std::vector<std::size_t> assign_materials(const std::vector<Material>& materials,
                                          const Specimen& specimen) {
  if (materials.size() == 1 && materials[0].region.kind == Region::Kind::all) return {};
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> material(specimen.size(), none);
  for (std::size_t m = 0; m < materials.size(); ++m)
    for (const std::int32_t e : select(materials[m].region, specimen)) {
      const auto i = static_cast<std::size_t>(e);
      if (material[i] != none)
        throw InputError("[[material]] " + place(specimen, i) +
                         " lies in the regions of materials " + std::to_string(material[i] + 1) +
                         " and " + std::to_string(m + 1) + "; each element must lie in one");
      material[i] = m;
    }
  for (std::size_t i = 0; i < specimen.size(); ++i)
    if (material[i] == none)
      throw InputError("[[material]] " + place(specimen, i) +
                       " lies in the region of no material; each element must lie in one");
  return material;
}

std::vector<double> densities(const std::vector<Material>& materials,
                              const std::vector<std::size_t>& of_element) {
  if (materials.size() == 1) return {materials[0].density};
  std::vector<double> values;
  for (const std::size_t m : of_element) values.push_back(materials[m].density);
  return values;
}

/// The geometry of conduction; for the calibrated law scaled by a factor, or by the one that a
/// steady bar test gives.
ConductionGeometry scaled_geometry(const ConductionParameters& parameters, const Specimen& specimen,
                                   std::optional<double> area_factor) {
  ConductionGeometry geometry = conduction_geometry(parameters.law, specimen);
  if (parameters.law == ConductionParameters::Law::platonic_calibrated)
    calibrate(geometry, area_factor ? *area_factor : 1 / relative_conductivity(geometry, specimen),
              specimen.domain.volume);
  return geometry;
}

/// The faces of a wall. Throws InputError when the body has no such wall or no element is there.
std::vector<WallFace> faces_of(const ConductionGeometry& geometry, const char* section,
                               const std::string& name, const std::string& wall,
                               const Specimen& specimen) {
  const auto found = geometry.walls.find(wall);
  const std::string place =
      std::string("[[") + section + "]] \"" + name + "\": wall = \"" + wall + "\"";
  if (found == geometry.walls.end()) {
    std::string known;
    for (const std::string& other : wall_names(specimen.domain))
      known += (known.empty() ? "" : ", ") + other;
    throw InputError(place + ": the body has no such wall; expected one of " +
                     (known.empty()
                          ? "those of a shape: this body (" + specimen.domain.shape + ") has none"
                          : known));
  }
  if (found->second.empty())
    throw InputError(place +
                     ": no element reaches it; expected a body that fills its bounds, or a region "
                     "in place of the wall");
  return found->second;
}

/// Refuses a source that heats nothing all the time.
void check_source(const HeatSourceParameters& parameters, const HeatSource& source, double duration,
                  const Specimen& specimen) {
  constexpr int looks = 400;
  for (int k = 0; k <= looks; ++k)
    if (source.reaches(duration * k / looks)) return;
  const Vector &low = specimen.domain.lower, &high = specimen.domain.upper;
  throw InputError("[[heat_sources]] \"" + parameters.name +
                   "\": outside the body at all times of the run; expected a shape that meets the "
                   "body, which lies between (" +
                   text(low.x) + ", " + text(low.y) + ", " + text(low.z) + ") and (" +
                   text(high.x) + ", " + text(high.y) + ", " + text(high.z) + ") m");
}

/// Notes who holds which element. Throws InputError when another one holds it already.
void claim(std::map<std::int32_t, std::string>& holders, const std::vector<std::int32_t>& elements,
           const std::string& section, const std::string& name, const Specimen& specimen) {
  const auto refuse = [&](std::int32_t element, const std::string& holder) {
    throw InputError(section + " \"" + name + "\" and \"" + holder + "\" share elements, " +
                     place(specimen, static_cast<std::size_t>(element)) +
                     " for one; their regions must not overlap");
  };
  for (const std::int32_t element : elements) {
    const auto [holder, alone] = holders.emplace(element, name);
    if (!alone) refuse(element, holder->second);
  }
}

}  // namespace

Simulation::Simulation(const Setup& setup, Specimen specimen, bool force)
    : setup_(setup), model_(make_model(std::move(specimen))) {
  if (!setup_.beams && !setup_.conduction)
    throw InputError(
        "the scene names no effect, so there is nothing to simulate; add [beams] or "
        "[conduction]");
  plan_ = make_plan(setup_, model_.specimen().domain.is_periodic());
  for (const PlannedColumn& planned : plan_.columns) model_.add(*planned.column);
  const std::vector<std::size_t> material = assign_materials(setup_.materials, model_.specimen());
  if (setup_.beams) add_motion(densities(setup_.materials, material));
  if (setup_.conduction) add_heat(material);
  geometry_.reset();
  add_observers();
  choose_time_step(force);
  if (setup_.conduction) add_heat_integrator();
  Observation start;
  observe(start);
  initial_energy_ = start.motion.kinetic_energy + start.motion.elastic_energy;
}

Model Simulation::make_model(Specimen specimen) {
  // Components and bond counts are found while the list of bonds is still there.
  if (setup_.gauge) selections_["component"] = largest_component(specimen);
  if (setup_.conduction)
    geometry_ = std::make_unique<ConductionGeometry>(
        scaled_geometry(*setup_.conduction, specimen, setup_.conduction->area_factor));
  std::optional<std::vector<Pair>> conductors;
  if (setup_.conduction) {
    area_factor_ = geometry_->area_factor;
    if (setup_.conduction->law == ConductionParameters::Law::voronoi) {
      // Where nothing but heat is simulated, the faces are all that bonds are needed for.
      if (setup_.beams)
        conductors = geometry_->faces;
      else
        specimen.bonds = geometry_->faces;
    }
  }
  const std::vector<std::int32_t> bonds = count_bonds(specimen);
  unbonded_ = static_cast<std::size_t>(std::count(bonds.begin(), bonds.end(), 0));
  return Model(std::move(specimen), conductors);
}

ConductionGeometry Simulation::conduction_geometry() const {
  Specimen specimen = model_.specimen();
  specimen.bonds = model_.conductors().pairs();
  return scaled_geometry(*setup_.conduction, specimen, area_factor_);
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

std::vector<std::int32_t> Simulation::select_some(const std::string& name, const Region& region) {
  std::vector<std::int32_t> elements = select(region, model_.specimen());
  if (elements.empty())
    throw InputError(
        name + ": its region holds no element; the specimen's centres lie between (" +
        text(model_.specimen().domain.lower.x) + ", " + text(model_.specimen().domain.lower.y) +
        ", " + text(model_.specimen().domain.lower.z) + ") and (" +
        text(model_.specimen().domain.upper.x) + ", " + text(model_.specimen().domain.upper.y) +
        ", " + text(model_.specimen().domain.upper.z) + ") m");
  selections_[name] = elements;
  return elements;
}

std::vector<std::int32_t> Simulation::select_conducting(const std::string& name,
                                                        const Region& region,
                                                        const std::vector<int>& neighbours) {
  std::vector<std::int32_t> elements = select_some(name, region);
  const bool all_alone = std::all_of(elements.begin(), elements.end(), [&](std::int32_t e) {
    return neighbours[static_cast<std::size_t>(e)] == 0;
  });
  if (all_alone)
    throw InputError(name + ": none of the " + std::to_string(elements.size()) +
                     " elements of its region has a neighbour to pass heat to, " +
                     place(model_.specimen(), static_cast<std::size_t>(elements[0])) +
                     " for one; expected a larger region, [bonds] tolerance = 0.05, or law = "
                     "\"voronoi\"");
  return elements;
}

void Simulation::add_motion(const std::vector<double>& density) {
  const std::vector<double> mass = represented_mass(model_.specimen(), density);
  auto beams = std::make_unique<Beams>(*setup_.beams, mass, model_);
  beams_ = beams.get();
  effects_.push_back(std::move(beams));
  for (const InitialVelocity& initial : setup_.initial_velocities)
    for (const std::int32_t e : select(initial.region, model_.specimen())) {
      double* velocity = model_.data(columns::velocity);
      const auto i = static_cast<std::size_t>(e);
      velocity[Model::at(columns::velocity, i, 0)] = initial.velocity.x;
      velocity[Model::at(columns::velocity, i, 1)] = initial.velocity.y;
      velocity[Model::at(columns::velocity, i, 2)] = initial.velocity.z;
    }
  std::map<std::int32_t, std::string> gripped;
  for (const GripParameters& grip : setup_.grips) {
    std::vector<std::int32_t> elements = select_some("grip." + grip.name, grip.region);
    claim(gripped, elements, "[[grips]]", grip.name, model_.specimen());
    effects_.push_back(std::make_unique<Grip>(grip, std::move(elements), mass, model_));
  }
}

void Simulation::add_heat(const std::vector<std::size_t>& material) {
  auto conduction = std::make_unique<Conduction>(
      *setup_.conduction, ThermalProperties{setup_.materials, material}, *geometry_, model_);
  conduction_ = conduction.get();
  effects_.push_back(std::move(conduction));
  const auto add_load = [&](std::unique_ptr<HeatLoad> load) {
    heat_loads_.push_back(load.get());
    effects_.push_back(std::move(load));
  };
  const auto faces = [&](const char* section, const std::string& name, const std::string& wall) {
    return faces_of(*geometry_, section, name, wall, model_.specimen());
  };
  const std::vector<int> neighbours = model_.conductors().coordination();
  // What no heat could leave again takes none: it would only grow hotter and hotter.
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (neighbours[i] == 0) geometry_->volume[i] = 0;
  for (const HeatSourceParameters& source : setup_.heat_sources) {
    std::vector<std::int32_t> elements;
    if (source.region)
      elements = select_conducting("heat_source." + source.name, *source.region, neighbours);
    add_load(std::make_unique<HeatSource>(source, elements, geometry_->volume, model_.specimen()));
  }
  for (const HeatFluxParameters& flux : setup_.heat_fluxes)
    add_load(std::make_unique<HeatFlux>(flux, faces("heat_fluxes", flux.name, flux.wall)));
  for (const ConvectionParameters& convection : setup_.convections)
    add_load(std::make_unique<HeatExchange>(
        convection, faces("convections", convection.name, convection.wall), *conduction_));
  for (const ImposedTemperatureParameters& imposed : setup_.temperatures)
    if (!imposed.wall.empty())
      add_load(std::make_unique<HeatExchange>(
          imposed, faces("temperatures", imposed.name, imposed.wall), *conduction_));
  std::map<std::int32_t, std::string> heated;
  for (const ImposedTemperatureParameters& imposed : setup_.temperatures) {
    if (!imposed.wall.empty()) continue;
    std::vector<std::int32_t> elements =
        select_conducting("temperature." + imposed.name, imposed.region, neighbours);
    claim(heated, elements, "[[temperatures]]", imposed.name, model_.specimen());
    auto effect =
        std::make_unique<ImposedTemperature>(imposed, std::move(elements), *conduction_, model_);
    imposed_temperatures_.push_back(effect.get());
    effects_.push_back(std::move(effect));
  }
}

void Simulation::add_heat_integrator() {
  using Integrator = ConductionParameters::Integrator;
  const ConductionParameters& conduction = *setup_.conduction;
  for (std::size_t k = 0; k < setup_.heat_sources.size(); ++k)
    check_source(setup_.heat_sources[k], static_cast<const HeatSource&>(*heat_loads_[k]),
                 static_cast<double>(steps_to_run()) * time_step_.value, model_.specimen());
  heated_ = std::make_unique<HeatedModel>(model_, *conduction_, heat_loads_, imposed_temperatures_,
                                          heat_limit_);
  if (conduction.integrator == Integrator::explicit_euler && heated_->is_linear()) {
    heated_.reset();  // conduction takes its steps in one pass by itself
    return;
  }
  const HeatIntegration choice =
      conduction.integrator == Integrator::explicit_euler ? HeatIntegration::explicit_euler
      : conduction.integrator == Integrator::rkl2         ? HeatIntegration::rkl2
      : conduction.integrator == Integrator::implicit     ? HeatIntegration::implicit
                                                          : HeatIntegration::automatic;
  integrator_ = make_heat_integrator(choice, {conduction.tolerance.value_or(0)});
}

void Simulation::add_observers() {
  if (setup_.gauge) {
    auto gauge =
        std::make_unique<GaugeSection>(*setup_.gauge, selections_["component"], *beams_, model_);
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
  const bool explicit_heat =
      conduction_ != nullptr &&
      setup_.conduction->integrator == ConductionParameters::Integrator::explicit_euler;
  std::vector<TimeStepCriterion> criteria;
  if (beams_ != nullptr) criteria = beams_->time_step_criteria(model_);
  std::vector<ElementValue> exchange;
  for (const HeatLoad* load : heat_loads_) load->largest_conductances(exchange);
  if (conduction_ != nullptr && (explicit_heat || beams_ == nullptr))
    criteria.push_back(conduction_->time_step_criterion(model_, exchange));
  TimeStepChoice& choice = time_step_;
  choice.bound = choice.limit = std::numeric_limits<double>::infinity();
  for (const TimeStepCriterion& criterion : criteria)
    if (criterion.value < choice.bound) {
      choice.bound = criterion.value;
      choice.criterion = criterion.name;
    }
  if (beams_ != nullptr) choice.limit = stable_time_step(*beams_, model_);
  if (conduction_ != nullptr) heat_limit_ = conduction_->stable_time_step(model_, exchange);
  if (explicit_heat) choice.limit = std::min(choice.limit, heat_limit_);
  const RunControl& run = setup_.run;
  // Heat that is not bound by stability takes as many steps as the history has rows.
  const bool free_steps = conduction_ != nullptr && !explicit_heat && beams_ == nullptr;
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

void Simulation::advance(std::int64_t steps) {
  for (std::int64_t n = 0; n < steps; ++n) {
    const double dt = time_step_.value;
    const Step step{time(), dt, step_ == 0 ? 0.5 * dt : dt};
    const bool fused = integrator_ == nullptr;
    for (const auto& effect : effects_) {
      if (effect.get() == conduction_ && !fused) break;  // the effects of heat come last
      effect->advance(model_, step);
    }
    if (beams_ != nullptr) model_.swap(columns::pose);
    if (conduction_ != nullptr && fused) model_.swap(columns::temperature);
    if (!fused) advance_heat(step);
    ++step_;
  }
}

void Simulation::advance_heat(const Step& step) {
  double* temperature = model_.data(columns::temperature);
  const std::vector<double> before(temperature, temperature + model_.elements());
  std::vector<double> heat(heated_->accounts(), 0.0);
  integrator_->advance(*heated_, step.time, step.time_step, temperature, heat.data());
  heated_->count(before, heat);
}

HistoryRow Simulation::observe() const {
  Observation observation;
  return observe(observation);
}

HistoryRow Simulation::observe(Observation& observation) const {
  observation.time = time();
  observation.behind = step_ == 0 ? 0 : 0.5 * time_step_.value;
  for (const auto& effect : effects_) effect->observe(model_, observation);
  for (const auto& observer : observers_) observer->observe(model_, observation);

  HistoryRow row{step_, time(), {}};
  if (beams_ != nullptr) {
    const ObservedMotion& motion = observation.motion;
    const double energy = motion.kinetic_energy + motion.elastic_energy;
    row.values.emplace_back("kinetic_energy", motion.kinetic_energy);
    row.values.emplace_back("elastic_energy", motion.elastic_energy);
    row.values.emplace_back("external_work", motion.external_work);
    row.values.emplace_back("energy_balance", energy - initial_energy_ - motion.external_work);
  }
  if (conduction_ != nullptr) {
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

std::map<std::string, std::vector<double>> Simulation::save() const {
  std::map<std::string, std::vector<double>> saved;
  for (const PlannedColumn& planned : plan_.columns) {
    if (!planned.column->dynamic) continue;
    const double* data = model_.data(*planned.column);
    saved[std::string("column.") + planned.column->name] =
        std::vector<double>(data, data + model_.size(*planned.column));
  }
  for (std::size_t k = 0; k < effects_.size(); ++k)
    if (const std::vector<double> sums = effects_[k]->save(); !sums.empty())
      saved["effect." + plan_.effects[k].name] = sums;
  saved["initial_energy"] = {initial_energy_};
  saved["time_step"] = {time_step_.value};
  if (integrator_ != nullptr) saved["integrator"] = integrator_->save();
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
    if (!planned.column->dynamic) continue;
    const std::vector<double>& values = find(std::string("column.") + planned.column->name);
    if (values.size() != model_.size(*planned.column))
      throw InputError(std::string("the checkpoint's column ") + planned.column->name + " has " +
                       std::to_string(values.size()) + " values, this specimen needs " +
                       std::to_string(model_.size(*planned.column)));
    std::copy(values.begin(), values.end(), model_.data(*planned.column));
  }
  for (std::size_t k = 0; k < effects_.size(); ++k)
    if (!effects_[k]->save().empty()) effects_[k]->restore(find("effect." + plan_.effects[k].name));
  if (integrator_ != nullptr) integrator_->restore(find("integrator"));
  initial_energy_ = find("initial_energy").at(0);
  step_ = step;
}

}  // namespace solidem
