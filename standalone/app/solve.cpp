// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/print_json.hpp"
#include "app/say.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/beams.hpp"
#include "effects/bond_temperature.hpp"
#include "effects/effect_kind.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/turning_grip.hpp"
#include "engine/heat_at_rest.hpp"
#include "engine/sensors.hpp"
#include "keys/nearest_name.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "output/results_folder.hpp"
#include "output/summary.hpp"
#include "output/trajectory.hpp"
#include "scene/body.hpp"
#include "solve/statics/finite_equilibrium.hpp"
#include "solve/statics/modes.hpp"
#include "solve/statics/static_grips.hpp"
#include "specimen/bonds.hpp"
#include "specimen/pieces.hpp"

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

constexpr double largest_residual = 1e-3;

/// A bonded scene at one time.
struct StaticScene {
  Specimen specimen;
  BeamNetwork network;
  std::vector<double> mass, volume;  ///< of each element, kg, and that it stands for, m³
  std::vector<double> temperature;   ///< where the bonds expand, K
  double time;                       ///< s, at which the grips stand
  GripConditions conditions;
  std::vector<std::string> notes;  ///< on what is left out
};

std::vector<double> masses_of(const Simulation& simulation) {
  const double* inverse = simulation.model().data(columns::inverse_mass);
  std::vector<double> mass(simulation.model().elements());
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] = 1 / inverse[i];
  return mass;
}

/// Sections that act in a run and not in a body at rest. Refuses those that would change it.
std::vector<std::string> sections_left_out(const Scene& scene) {
  const auto is_one_of = [](const std::string& section, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), section) != names.end();
  };
  const bool expands = scene.setup.get<ExpansionParameters>().has_value();
  std::vector<std::string> left_out;
  for (const EffectKind& kind : effect_kinds()) {
    // Of yield and rupture the solution tells by itself whether they would count.
    if (!kind.is_named(scene.setup) ||
        is_one_of(kind.section, {"beams", "grips", "plasticity", "rupture"}))
      continue;
    if (expands &&
        is_one_of(kind.section, {"expansion", "conduction", "thermal_contacts", "heat_sources",
                                 "heat_fluxes", "convections", "temperatures"}))
      continue;
    const std::string name = kind.is_list ? "[[" + kind.section + "]]" : "[" + kind.section + "]";
    const bool is_thermal = kind.provides == Provides::heat || kind.needs == Provides::heat;
    if (kind.section == "softening" ||
        (!is_thermal && !is_one_of(kind.section, {"contact", "damping", "initial_velocities"})))
      throw InputError(name +
                       " acts in a run, and `solidem solve` does not know it; expected a scene "
                       "without it");
    left_out.push_back(name);
  }
  return left_out;
}

std::vector<char> elements_of(const BeamNetwork& network) {
  std::vector<char> inside(network.specimen->size(), 0);
  for (const Pair& pair : network.bonds)
    inside[static_cast<std::size_t>(pair.i)] = inside[static_cast<std::size_t>(pair.j)] = 1;
  return inside;
}

/// Notes what is left out of the body that is solved for. Refuses a grip that holds nothing of it.
void note_what_is_left_out(const Scene& scene, const Simulation& simulation, StaticScene& body) {
  const std::vector<std::string> sections = sections_left_out(scene);
  if (!sections.empty())
    body.notes.push_back(join(sections) + ": left out, a body at rest does not know of it");
  for (std::string& note : notes_on(body.specimen, body.specimen.bonds))
    body.notes.push_back(std::move(note));
  const std::vector<char> inside = elements_of(body.network);
  const auto count = std::count(inside.begin(), inside.end(), 1);
  if (static_cast<std::size_t>(count) < inside.size())
    body.notes.push_back(
        fmt::format("solved for the largest piece, {} of {} elements; the others are left out and "
                    "stay where they are",
                    count, inside.size()));
  for (const GripParameters& grip : scene.setup.all<GripParameters>()) {
    const std::vector<std::int32_t>& held = simulation.selections().at("grip." + grip.name);
    const auto outside = std::count_if(held.begin(), held.end(), [&](std::int32_t e) {
      return inside[static_cast<std::size_t>(e)] == 0;
    });
    if (static_cast<std::size_t>(outside) == held.size())
      throw InputError(fmt::format(
          "[[grips]] \"{}\" region: none of its {} elements belongs to the body that is solved "
          "for, the "
          "largest piece, of {} of {} elements; expected a region that reaches it, or bonds that "
          "join the pieces ([bonds] tolerance)",
          grip.name, held.size(), count, inside.size()));
    if (outside > 0)
      body.notes.push_back(
          fmt::format("grip \"{}\": {} of its {} elements are outside of that body", grip.name,
                      outside, held.size()));
  }
}

void set_up(const Scene& scene, StaticScene& body) {
  if (!scene.setup.get<BeamParameters>())
    throw InputError(scene.path +
                     ": the scene has no [beams]; `solidem solve` needs bonds to solve");
  if (!scene.setup.all<TurningGripParameters>().empty())
    throw InputError("[[grips]] \"" + scene.setup.all<TurningGripParameters>().front().grip.name +
                     "\" turns, which `solidem solve` does not know; expected grips with "
                     "displacements and forces");
  // Whether a time step is stable does not matter here.
  const Simulation simulation(scene.setup, make_body(scene), true);
  body.specimen = simulation.model().specimen();
  body.specimen.bonds = simulation.model().slots().pairs();
  body.network = beam_network(*scene.setup.get<BeamParameters>(), body.specimen);
  note_what_is_left_out(scene, simulation, body);
  body.mass = masses_of(simulation);
  body.volume = represented_mass(body.specimen, {1.0});
  body.time = scene.setup.run.duration.value_or(static_cast<double>(simulation.steps_to_run()) *
                                                simulation.time_step().value);
  if (scene.setup.get<ExpansionParameters>()) {
    body.temperature = temperature_at_rest(simulation, body.time);
    body.network.thermal_strain = thermal_strain(simulation, body.network.bonds, body.temperature);
  }
  for (const GripParameters& grip : scene.setup.all<GripParameters>())
    impose(grip, simulation.selections().at("grip." + grip.name), body.mass, body.time,
           body.conditions);
}

Equilibrium equilibrium_of(const StaticScene& body, const SolveCommand& command) {
  if (command.rotations == "small")
    return small_equilibrium(body.network, body.conditions.constraints, body.conditions.loads);
  FiniteOptions options;
  if (!command.quiet && !command.json)
    options.report = [](double fraction, int corrections, double residual) {
      say("  {:6.4f} of the loads and displacements after {} corrections, residual {:.2g}\n",
          fraction, corrections, residual);
      std::fflush(stdout);
    };
  return finite_equilibrium(body.network, body.conditions.constraints, body.conditions.loads,
                            options);
}

/// What cannot be solved is not held, or loaded, as it must be.
Equilibrium find_equilibrium(const StaticScene& body, const SolveCommand& command) {
  try {
    return equilibrium_of(body, command);
  } catch (const InputError& error) {
    throw InputError(std::string("[[grips]] ") + error.what());
  }
}

std::vector<Mode> find_modes(const StaticScene& body, const SolveCommand& command,
                             const Equilibrium& equilibrium) {
  if (command.modes == 0) return {};
  std::vector<double> inertia;
  for (std::size_t i = 0; i < body.mass.size(); ++i)
    inertia.push_back(sphere_inertia(body.mass[i], body.specimen.radius[i]));
  return lowest_modes(body.network, body.conditions.constraints, body.mass, inertia, command.modes,
                      command.rotations == "finite" ? &equilibrium : nullptr);
}

std::vector<double> moved(const Specimen& specimen, const std::vector<Vector>& displacement,
                          double scale) {
  std::vector<double> place;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector p = specimen.position[i] + scale * displacement[i];
    place.insert(place.end(), {p.x, p.y, p.z});
  }
  return place;
}

void write_trajectories(const std::string& directory, const StaticScene& body,
                        const Equilibrium& equilibrium, const std::vector<Mode>& modes) {
  TrajectoryWriter trajectory(directory + "/trajectory.h5", body.specimen);
  const auto position = moved(body.specimen, equilibrium.displacement, 1);
  const auto stress = element_stress(body.network, equilibrium, body.volume);
  std::vector<Field> fields{{"position", 3, position.data()},
                            {"displacement", 3, &equilibrium.displacement.data()->x},
                            {"rotation", 3, &equilibrium.rotation.data()->x},
                            {"reaction", 3, &equilibrium.reaction.data()->x},
                            {"stress", 6, &stress.data()->xx}};
  if (!body.temperature.empty()) fields.push_back({"temperature", 1, body.temperature.data()});
  trajectory.write_frame(0, body.time, fields);
  if (modes.empty()) return;
  // Each mode is a frame, drawn with a tenth of the body's size.
  TrajectoryWriter shapes(directory + "/modes.h5", body.specimen);
  const double size = norm(body.specimen.domain.upper - body.specimen.domain.lower);
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const auto shape = moved(body.specimen, modes[m].displacement, 0.1 * size);
    shapes.write_frame(static_cast<std::int64_t>(m), static_cast<double>(m),
                       {{"position", 3, shape.data()},
                        {"displacement", 3, &modes[m].displacement.data()->x},
                        {"rotation", 3, &modes[m].rotation.data()->x}});
  }
}

/// The least strain at which bonds of any material flow, or break.
double least_bound(const BeamDemands& demands, const RuptureLaw* rupture) {
  const YieldLaw* yield = rupture == nullptr ? demands.yield() : nullptr;
  const FlowRule rule = demands.plasticity ? demands.plasticity->law : FlowRule::radial_return;
  double least = limit_strain(yield, rule, rupture, 0);
  for (const BeamPairing& pair : demands.pairings())
    least = std::min(least, limit_strain(yield, rule, rupture, 0, pair.limits));
  return least;
}

/// What the scene asks for and a static solution leaves out.
void add_notes(const Setup& setup, double largest_strain, const Equilibrium& equilibrium,
               std::vector<std::string>& notes) {
  const BeamDemands demands = demands_of(setup);
  const bool is_one_material = limits_are_alike(demands.pairings());
  const bool is_strain_limit = is_one_material && demands.rupture &&
                               std::holds_alternative<StrainLimit>(demands.rupture->law);
  if (demands.plasticity) {
    const double bound = least_bound(demands, nullptr);
    if (largest_strain > bound)
      notes.push_back(
          fmt::format("the solution is elastic, but bonds {} have yielded: their largest "
                      "equivalent strain is {:.3g}, {} {:.3g}",
                      is_one_material ? "would" : "may", largest_strain,
                      is_one_material ? "the yield strain" : "none yields below", bound));
  }
  if (demands.rupture) {
    const double bound = least_bound(demands, &demands.rupture->law);
    if (largest_strain > bound)
      notes.push_back(
          fmt::format("the solution is elastic, but bonds {} have broken: their largest equivalent "
                      "strain is {:.3g}, {} {:.3g}",
                      is_strain_limit ? "would" : "may", largest_strain,
                      is_strain_limit ? "the rupture strain" : "none breaks below", bound));
  }
  if (equilibrium.unstable)
    notes.emplace_back("the equilibrium is unstable: the body would buckle");
}

/// Whether a warm body is free to be as large as it would: its bonds' forces are but round-off.
bool is_free_to_expand(const BeamNetwork& network, const Equilibrium& equilibrium) {
  constexpr double round_off = 1e-9;
  double expanded = 0, strained = 0;
  for (const double strain : network.thermal_strain)
    expanded = std::max(expanded, std::abs(strain));
  for (const double strain : equilibrium.bond_strain) strained = std::max(strained, strain);
  return strained < round_off * expanded;
}

/// Where nothing strains the bonds their forces are round-off, and none of the figures counts.
void insist_on_balance(const Scene& scene, const BeamNetwork& network,
                       const Equilibrium& equilibrium) {
  if (equilibrium.residual <= largest_residual || is_free_to_expand(network, equilibrium)) return;
  throw RunError(fmt::format(
      "{}: no equilibrium was found: forces out of balance are {:.2g} of the bonds' forces, which "
      "are no more than round-off; expected grips that strain the body",
      scene.path, equilibrium.residual));
}

Json solve_that(const Scene& scene, const SolveCommand& command) {
  const Voice tell{command.json};
  const std::string directory = command.output.empty()
                                    ? std::filesystem::path(scene.path).stem().string() + ".results"
                                    : command.output;
  const ResultsFolder folder(directory, run_results(),
                             command.overwrite ? Earlier::replace : Earlier::refuse);
  std::map<std::string, double> seconds;
  auto start = Clock::now();
  const auto lap = [&](const char* phase) {
    seconds[phase] = seconds_since(start);
    start = Clock::now();
  };
  StaticScene body;
  set_up(scene, body);
  if (command.rotations != "small" && !body.temperature.empty())
    throw InputError(
        "[expansion] is known with small rotations only; expected "
        "--rotations small, or a scene without it");
  lap("set-up");
  tell("{}: {} elements, {} bonds, {} rotations, at {:.4g} s -> {}\n", scene.title,
       body.specimen.size(), body.network.bonds.size(), command.rotations, body.time, directory);
  std::fflush(stdout);

  const Equilibrium equilibrium = find_equilibrium(body, command);
  insist_on_balance(scene, body.network, equilibrium);
  lap("equilibrium");
  const std::vector<Mode> modes = find_modes(body, command, equilibrium);
  lap("modes");
  folder.begin();
  write_trajectories(directory, body, equilibrium, modes);
  lap("output");

  const double largest_strain =
      equilibrium.bond_strain.empty()
          ? 0.0
          : *std::max_element(equilibrium.bond_strain.begin(), equilibrium.bond_strain.end());
  Json summary;
  summary["solidem"] = version();
  summary["scene"] = scene.path;
  if (!scene.set.empty()) summary["set"] = scene.set;
  summary["rotations"] = command.rotations;
  summary["elements"] = body.specimen.size();
  summary["bonds"] = body.network.bonds.size();
  summary["time"] = body.time;
  summary["method"] = equilibrium.iterations > 1 ? "conjugate gradients" : "factorisation";
  summary["iterations"] = equilibrium.iterations;
  if (command.rotations == "finite") {
    summary["load_steps"] = equilibrium.load_steps;
    summary["corrections"] = equilibrium.corrections;
    summary["unstable"] = equilibrium.unstable;
  }
  summary["residual"] = equilibrium.residual;
  summary["energy"] = {{"elastic_energy", equilibrium.energy}};
  summary["largest_bond_strain"] = largest_strain;
  tell("elastic energy {:.6g} J, residual {:.2g}, largest bond strain {:.3g}\n", equilibrium.energy,
       equilibrium.residual, largest_strain);
  if (scene.setup.gauge) {
    const GaugeMeasure gauge = measure_gauge(body.network, equilibrium, *scene.setup.gauge);
    const double lateral = 0.5 * (gauge.lateral_strain[0] + gauge.lateral_strain[1]);
    summary["gauge"] = {{"stress", gauge.stress},
                        {"strain", gauge.strain},
                        {"lateral_strain", lateral},
                        {"lateral_strains", gauge.lateral_strain}};
    tell("gauge: stress {:.6g} Pa, strain {:.6g}, lateral strain {:.6g}\n", gauge.stress,
         gauge.strain, lateral);
  }
  for (const GripParameters& grip : scene.setup.all<GripParameters>()) {
    const GripAction action = grip_action(select(grip.region, body.specimen), body.conditions,
                                          body.specimen, equilibrium);
    summary["grips"][grip.name] = {{"force", json_of(action.force)},
                                   {"moment", json_of(action.moment)},
                                   {"displacement", json_of(action.displacement)}};
    tell("grip {}: force ({:.6g}, {:.6g}, {:.6g}) N, displacement ({:.4g}, {:.4g}, {:.4g}) m\n",
         grip.name, action.force.x, action.force.y, action.force.z, action.displacement.x,
         action.displacement.y, action.displacement.z);
  }
  for (const Sensor& sensor : scene.setup.sensors) {
    const std::vector<ElementValue> weights =
        sampling_weights(body.specimen, elements_of_the_body(count_bonds(body.specimen)), sensor);
    const Vector displacement = sampled_displacement(weights, equilibrium.displacement);
    summary["sensors"][sensor.name] = {
        {"position", json_of(resting_place(body.specimen, weights, sensor) + displacement)},
        {"displacement", json_of(displacement)}};
  }
  for (const Mode& mode : modes) {
    summary["frequencies"].push_back(mode.frequency);
    summary["mode_residuals"].push_back(mode.residual);
    tell("mode {}: {:.6g} Hz\n", summary["frequencies"].size(), mode.frequency);
  }
  add_notes(scene.setup, largest_strain, equilibrium, body.notes);
  if (!command.json) print_notes(body.notes);
  if (!body.notes.empty()) summary["notes"] = body.notes;
  summary["wall_seconds"] = seconds;
  summary["peak_memory_bytes"] = peak_memory_bytes();
  summary["threads"] = omp_get_max_threads();
  summary["hardware"] = to_json(hardware());
  write_summary(directory + "/summary.json", summary);
  return summary;
}

}  // namespace

nlohmann::ordered_json solve(const SolveCommand& command) {
  if (command.threads > 0) omp_set_num_threads(command.threads);
  const Scene scene = read_scene(command.scene);
  return at_places_of(scene, [&] { return solve_that(scene, command); });
}

void solve_scene(const SolveCommand& command) {
  const Json summary = solve(command);
  if (command.json) print_json(summary);
}

}  // namespace solidem
