// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/central_forces.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/contact.hpp"
#include "effects/effect_kind.hpp"
#include "effects/free_motion.hpp"
#include "effects/mechanics.hpp"
#include "engine/gauge.hpp"
#include "engine/heat.hpp"
#include "engine/leap.hpp"
#include "engine/sensors.hpp"
#include "engine/stability.hpp"
#include "model/error.hpp"
#include "output/digest.hpp"
#include "specimen/bonds.hpp"
#include "specimen/pieces.hpp"

namespace solidem {

namespace {

constexpr double default_ratio = 0.3;
constexpr double default_rows = 200;
constexpr std::int64_t check_every = 256;  // steps between two looks at the energy
constexpr double most_steps = 1e15;        // that a double counts exactly
constexpr double same_length = 1e-9;       // of a step: less is round-off

/// All of the specimen that a run begins with, as figures that a checkpoint can hold: how many
/// elements and bonds, and a digest of where they are, of which size, and who is bonded.
std::vector<double> marks_of(const Model& model) {
  const Specimen& specimen = model.specimen();
  Digest digest;
  digest.add(specimen.position);
  digest.add(specimen.radius);
  digest.add(model.slots().pairs());
  const Domain& domain = specimen.domain;
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[axis]) digest.add(std::vector<Vector>{domain.lower, domain.upper});
  std::vector<double> marks{static_cast<double>(model.elements()),
                            static_cast<double>(model.slots().bonds())};
  const std::string digits = digest.hexadecimal();
  constexpr std::size_t piece = 8;  // digits, which a double holds exactly
  for (std::size_t k = 0; k < digits.size(); k += piece)
    marks.push_back(static_cast<double>(std::stoul(digits.substr(k, piece), nullptr, 16)));
  return marks;
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
  plan_ = make_plan(setup_, model_.specimen().domain.is_periodic());
  if (plan_.effects.empty())
    throw InputError("the scene names no effect, so there is nothing to simulate; add " +
                     sections_that_provide({Provides::motion, Provides::heat}));
  for (const PlannedColumn& planned : plan_.columns) model_.add(*planned.column);
  Assembly assembly(setup_, model_, selections_);
  assembly.material = assign_materials(setup_.materials, model_.specimen());
  if (provides(setup_, Provides::motion))
    assembly.mass =
        represented_mass(model_.specimen(), densities(setup_.materials, assembly.material));
  if (geometry_ != nullptr) assembly.geometry = std::move(*geometry_);
  geometry_.reset();
  const double area_factor = assembly.geometry.area_factor;
  effects_.resize(plan_.effects.size());
  make_effects(assembly, Phase::move, Phase::move);
  mechanics_ = assembly.find<Mechanics>();
  for (const EffectKind& kind : effect_kinds())
    if (kind.start && kind.is_named(setup_)) kind.start(setup_, model_);
  make_effects(assembly, Phase::change_pairs, Phase::heat);
  sort_by_phase();
  if (assembly.find<Conduction>() != nullptr)
    heat_ = std::make_unique<Heat>(*setup_.get<ConductionParameters>(), area_factor,
                                   of_phase(Phase::heat), model_);
  add_observers();
  choose_time_step(force);
  const double duration =
      setup_.run.duration.value_or(static_cast<double>(steps_to_run()) * time_step_.value);
  for (const auto& effect : effects_) effect->start(model_, duration);
  if (heat_ != nullptr) heat_->start(duration);
  record_initial_energy();
  specimen_marks_ = marks_of(model_);
  if (mechanics_ != nullptr)
    guard_.ignore(Mechanics::round_off_strain * Mechanics::round_off_strain *
                  static_cast<double>(model_.slots().bonds()) * mechanics_->typical_energy(model_));
}

void Simulation::make_effects(Assembly& assembly, Phase first, Phase last) {
  for (int phase = static_cast<int>(first); phase <= static_cast<int>(last); ++phase)
    for (std::size_t k = 0; k < effects_.size(); ++k) {
      if (static_cast<int>(plan_.effects[k].phase) != phase) continue;
      effects_[k] = plan_.effects[k].make(assembly);
      assembly.made(effects_[k].get());
    }
}

std::vector<Effect*> Simulation::of_phase(Phase phase) const {
  std::vector<Effect*> found;
  for (std::size_t k = 0; k < effects_.size(); ++k)
    if (plan_.effects[k].phase == phase) found.push_back(effects_[k].get());
  return found;
}

void Simulation::sort_by_phase() {
  for (const Phase phase : {Phase::move, Phase::change_pairs, Phase::push, Phase::constrain})
    for (Effect* effect : of_phase(phase)) moving_.push_back(effect);
  looking_ = of_phase(Phase::after_move);
}

Model Simulation::make_model(Specimen specimen) {
  // Components and bond counts are found while the list of bonds is still there.
  if (elements_are_loose(setup_)) specimen.bonds.clear();
  if (setup_.gauge) selections_["component"] = largest_component(specimen);
  std::optional<std::vector<Pair>> conductors;
  if (const auto& conduction = setup_.get<ConductionParameters>()) {
    const auto& beams = setup_.get<BeamParameters>();
    const bool moves = provides(setup_, Provides::motion);
    const bool by_faces = conduction->law == ConductionParameters::Law::voronoi;
    // Heat passes where elements touch, not along fibres nor as far as central forces reach.
    const bool past_fibres = !by_faces && beams && beams->fibres;
    const bool by_touch = !by_faces && setup_.get<CentralForceParameters>();
    std::vector<Pair> bonds;
    if (past_fibres) bonds = std::exchange(specimen.bonds, bonds_in_contact(specimen));
    if (by_touch) bonds = std::exchange(specimen.bonds, find_bonds(specimen, 0));
    geometry_ = std::make_unique<ConductionGeometry>(
        scaled_geometry(*conduction, specimen, conduction->area_factor));
    if (past_fibres || by_touch) conductors = std::exchange(specimen.bonds, std::move(bonds));
    // Where nothing but heat is simulated, the faces are all that bonds are needed for.
    if (by_faces && !moves) specimen.bonds = geometry_->faces;
    if (by_faces && moves) conductors = geometry_->faces;
    // Bonds that break or form must not take the places of pairs that conduct.
    if (setup_.get<RuptureParameters>() && !conductors) conductors = specimen.bonds;
  }
  const std::vector<std::int32_t> bonds = count_bonds(specimen);
  unbonded_ = static_cast<std::size_t>(std::count(bonds.begin(), bonds.end(), 0));
  return Model(std::move(specimen), conductors);
}

Simulation::~Simulation() = default;

std::vector<Pair> Simulation::pairs() const {
  const auto* forces = find<CentralForces>();
  return forces != nullptr ? forces->initial_pairs() : model_.slots().pairs();
}

void Simulation::add_observers() {
  if (setup_.gauge) {
    auto gauge =
        std::make_unique<GaugeSection>(*setup_.gauge, selections_["component"],
                                       those_that_are<ActsBetweenElements>(effects_), model_);
    selections_.erase("component");
    selections_["gauge"] = gauge->elements();
    observers_.push_back(std::move(gauge));
  }
  for (const Sensor& sensor : setup_.sensors) {
    auto point =
        std::make_unique<PointSensor>(sensor, model_, setup_.get<ContactParameters>().has_value());
    selections_["sensor." + sensor.name] = point->elements();
    observers_.push_back(std::move(point));
  }
}

void Simulation::choose_time_step(bool force) {
  const bool explicit_heat = heat_ != nullptr && heat_->takes_explicit_steps();
  std::vector<TimeStepCriterion> criteria;
  double stiffening = 1, added = 0;
  for (const auto& effect : effects_) {
    for (const TimeStepCriterion& criterion : effect->time_step_criteria(model_))
      criteria.push_back(criterion);
    stiffening *= effect->stiffening();
    added += effect->added_squared_frequency();
  }
  if (heat_ != nullptr && (explicit_heat || mechanics_ == nullptr))
    criteria.push_back(heat_->criterion());
  TimeStepChoice& choice = time_step_;
  choice.bound = choice.limit = std::numeric_limits<double>::infinity();
  for (const TimeStepCriterion& criterion : criteria)
    if (criterion.value < choice.bound) {
      choice.bound = criterion.value;
      choice.criterion = criterion.name;
    }
  if (mechanics_ != nullptr) {
    motion_limit_ = stable_time_step(*mechanics_, model_);
    if (const auto* contacts = find<ElementContacts>())
      motion_limit_ = std::min(motion_limit_, contacts->longest_time_step());
    choice.limit = motion_limit_ / stiffening;
    if (added > 0) choice.limit = 2 / std::sqrt(4 / (choice.limit * choice.limit) + added);
  }
  if (explicit_heat) choice.limit = std::min(choice.limit, heat_->limit());
  const RunControl& run = setup_.run;
  // Heat that is not bound by stability takes as many steps as the history has rows.
  const double by_default = step_follows_duration()
                                ? *run.duration / default_rows
                                : run.time_step_ratio.value_or(default_ratio) * choice.bound;
  choice.value = run.time_step.value_or(by_default);
  if (!std::isfinite(choice.value))
    throw InputError(
        model_.slots().bonds() > 0
            ? "[run] nothing bounds the time step: the stiffness of the bonds is next to nothing "
              "beside the mass of the elements. Give time_step, or look at the units of the "
              "material and of the bonds"
            : "[run] nothing bounds the time step: the specimen has no bonds. Give time_step, "
              "or a larger [bonds] tolerance");
  if (!(choice.value > 0))
    throw InputError(
        "[run] the time step would be " + text(choice.value) +
        " s: the stiffness of the bonds, or the mass of the elements, is no number that can be "
        "counted with; look at the units of the material and of the bonds");
  choice.ratio = choice.value / choice.bound;
  if (choice.value > choice.limit && !force)
    throw InputError(std::string("[run]") +
                     (run.time_step         ? " time_step:"
                      : run.time_step_ratio ? " time_step_ratio:"
                                            : "") +
                     " the time step " + text(choice.value) + " s is beyond the stable limit " +
                     text(choice.limit) + " s (" + choice.criterion + ": " + text(choice.bound) +
                     " s); take a smaller one, or --force it");
  check_number_of_steps();
}

bool Simulation::step_follows_duration() const {
  const RunControl& run = setup_.run;
  return heat_ != nullptr && !heat_->takes_explicit_steps() && mechanics_ == nullptr &&
         run.duration && !run.time_step && !run.time_step_ratio;
}

void Simulation::check_number_of_steps() const {
  const RunControl& run = setup_.run;
  const double steps =
      run.steps ? static_cast<double>(*run.steps) : run.duration.value_or(0) / time_step_.value;
  if (run.duration && steps <= 2 * same_length)
    throw InputError("[run] duration = " + text(*run.duration) +
                     " s: next to nothing beside a step of " + text(time_step_.value) +
                     " s; expected a longer one");
  if (steps <= most_steps) return;
  throw InputError((run.steps ? "[run] steps = " + std::to_string(*run.steps)
                              : "[run] duration = " + text(*run.duration) + " s takes " +
                                    text(steps) + " steps of " + text(time_step_.value) + " s") +
                   ": more than can be counted; expected at most " + text(most_steps) + " steps");
}

std::int64_t Simulation::steps_to_run() const {
  if (setup_.run.steps) return *setup_.run.steps;
  const double left = setup_.run.duration.value_or(0) - origin_time_;
  return origin_step_ + static_cast<std::int64_t>(std::ceil(
                            std::max(0.0, left / time_step_.value * (1 - 1e-12) - same_length)));
}

double Simulation::next_length() const {
  const double dt = time_step_.value;
  if (!setup_.run.duration) return dt;
  const double left = *setup_.run.duration - time_;
  return left > same_length * dt && left < (1 - same_length) * dt ? left : dt;
}

void Simulation::finish_step(double length) {
  ++step_;
  last_length_ = length;
  if (length == time_step_.value) {
    time_ = origin_time_ + static_cast<double>(step_ - origin_step_) * length;
    return;
  }
  origin_step_ = step_;
  origin_time_ = time_ = *setup_.run.duration;
}

void Simulation::check() const {
  if (mechanics_ != nullptr) check_stability();
  if (heat_ != nullptr) heat_->check(step_, time_);
}

EnergyInMotion Simulation::energy_in_motion() const {
  EnergyInMotion motion{0, 0, initial_energy_};
  const double* velocity = model_.data(columns::velocity);
  const double* inverse_mass = model_.data(columns::inverse_mass);
  for (std::size_t i = 0; i < model_.elements(); ++i) {
    if (!(inverse_mass[i] > 0)) continue;
    const std::size_t at = Model::at(columns::velocity, i);
    const Vector v{velocity[at], velocity[at + lanes], velocity[at + std::size_t{2} * lanes]};
    motion.kinetic += 0.5 * dot(v, v) / inverse_mass[i];
  }
  for (const auto& effect : effects_) {
    motion.put_in += effect->work(model_);
    motion.spent += effect->spent(model_);
  }
  return motion;
}

double Simulation::stored_energy() const {
  Observation now;
  observe(now);
  return now.energies.stored();
}

double Simulation::check_stability() const {
  const std::string at_step =
      "at step " + std::to_string(step_) + " (time " + text(time()) + " s) ";
  const std::string step_and_limit = "time step " + text(time_step_.value) +
                                     " s, stable limit at the start " + text(time_step_.limit) +
                                     " s";
  double stiffened = 1;
  for (const auto& effect : effects_) stiffened *= effect->stiffened();
  const double limit = motion_limit_ / stiffened;
  if (time_step_.value > limit && !(time_step_.value > time_step_.limit))
    throw RunError("the run may not go on: " + at_step +
                   "bonds made anew and contacts hold elements so stiffly that the stable limit "
                   "is " +
                   text(limit) + " s; " + step_and_limit + "; take a smaller time step");

  const EnergyInMotion motion = energy_in_motion();
  std::function<double()> stored;
  if (mechanics_->releases_energy()) stored = [this] { return stored_energy(); };
  if (const std::optional<double> paid = guard_.paid_too_little(motion, stored))
    throw RunError("the run diverged: " + at_step + "the elements move with " +
                   text(motion.kinetic) + " J and " + text(motion.spent) +
                   " J went into plastic flow, but no more than " + text(*paid) +
                   " J were ever put in; " + step_and_limit);
  check_leaps(at_step);
  return motion.put_in;
}

void Simulation::check_leaps(const std::string& at_step) const {
  const auto actors = those_that_are<ActsBetweenElements>(effects_);
  if (std::none_of(actors.begin(), actors.end(),
                   [](const auto* actor) { return actor->lets_elements_meet(); }))
    return;
  const std::optional<Leap> leap = longest_leap(model_, time_step_.value);
  if (!leap) return;
  throw RunError("the run may not go on: " + at_step + "element " + std::to_string(leap->element) +
                 " moves " + text(leap->radii) +
                 " times its radius in a step, past others that it should meet; time step " +
                 text(time_step_.value) + " s; expected one of at most " +
                 text(time_step_.value / leap->radii) + " s, or a lower speed");
}

void Simulation::record_initial_energy() {
  Observation start;
  observe(start);
  initially_stored_ = start.energies.stored();
  guard_.start(initially_stored_);
  // What flows in the first pose, such as what is made warm beyond yield, was stored before.
  initial_energy_ = start.motion.kinetic_energy + initially_stored_ + start.energies.dissipated();
  initial_swing_ = swing_of(start.motion);
}

double Simulation::swing_of(const ObservedMotion& motion) const {
  return 0.25 * time_step_.value * time_step_.value * motion.squared_impulse;
}

void Simulation::step_once(const Step& step) {
  for (Effect* effect : moving_) effect->advance(model_, step);
  if (mechanics_ != nullptr) mechanics_->finish_move(model_);
  for (Effect* effect : looking_) effect->advance(model_, step);
  if (heat_ != nullptr) heat_->advance(step);
}

void Simulation::advance(std::int64_t steps) {
  // Whatever moves when the first step begins was put there.
  if (step_ == 0 && steps > 0 && mechanics_ != nullptr) record_initial_energy();
  for (std::int64_t n = 0; n < steps; ++n) {
    if (step_ % check_every == 0) {
      if (mechanics_ != nullptr) guard_.note(check_stability());
      if (heat_ != nullptr) heat_->check(step_, time_);
    }
    const double length = next_length();
    // Velocities go from the middle of one step to the middle of the next.
    step_once({time_, length, 0.5 * (last_length_ + length)});
    finish_step(length);
  }
  // Whoever looks next sees nothing that went astray; restarts do not depend on who looked.
  if (mechanics_ != nullptr && steps > 0) check_stability();
}

HistoryRow Simulation::observe() const {
  Observation observation;
  return observe(observation);
}

HistoryRow Simulation::observe(Observation& observation) const {
  observation.time = time();
  observation.behind = 0.5 * last_length_;
  if (mechanics_ != nullptr)
    observation.energies.add(EnergyLedger::Kind::input, "external_work", 0);
  for (const auto& effect : effects_) effect->observe(model_, observation);
  for (const auto& observer : observers_) observer->observe(model_, observation);

  HistoryRow row{step_, time(), {}};
  if (mechanics_ != nullptr) {
    double energy = observation.motion.kinetic_energy, work = 0;
    row.values.emplace_back("kinetic_energy", energy);
    observation.energies.for_each(
        [&](EnergyLedger::Kind kind, const std::string& name, double value) {
          row.values.emplace_back(name, value);
          (kind == EnergyLedger::Kind::input ? work : energy) += value;
        });
    // A step conserves ½ m v₋·v₊, of the velocities half a step before and after the poses, where
    // forces are linear, and not ½ m v². What is left tells of all else.
    const double swing = swing_of(observation.motion) - initial_swing_;
    row.values.emplace_back("energy_balance", energy - swing - initial_energy_ - work);
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

std::vector<std::string> notes_of(const Simulation& simulation) {
  std::vector<std::string> notes = simulation.plan().notes;
  const bool they_touch = simulation.setup().get<ContactParameters>().has_value();
  // Loose elements stand for themselves, and for no body whose volume might matter.
  if (elements_are_loose(simulation.setup())) return notes;
  for (std::string& note : notes_on(simulation.model().specimen(), simulation.pairs(), they_touch))
    notes.push_back(std::move(note));
  return notes;
}

}  // namespace solidem
