// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/say.hpp"
#include "effects/effect_kind.hpp"
#include "effects/heat_exchange.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/turning_grip.hpp"
#include "engine/body_figures.hpp"
#include "engine/heat.hpp"
#include "scene/body.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const TimeFunction& f) {
  return {{"time", f.time},
          {"value", f.value},
          {"amplitude", f.amplitude},
          {"frequency", f.frequency},
          {"phase", f.phase}};
}

const char* name_of(AxisControl::Kind kind) {
  switch (kind) {
    case AxisControl::Kind::displacement:
      return "displacement";
    case AxisControl::Kind::velocity:
      return "velocity";
    case AxisControl::Kind::force:
      return "force";
    case AxisControl::Kind::free:
      break;
  }
  return "free";
}

const char* name_of(Site site) {
  switch (site) {
    case Site::element:
      return "element";
    case Site::slot:
      return "slot";
    case Site::conductor:
      break;
  }
  return "conductor";
}

/// The parameters of every effect that the scene names, by section.
Json laws_of(const Simulation& simulation) {
  Json laws = Json::object();
  for (const EffectKind& kind : effect_kinds())
    if (kind.explain && kind.is_named(simulation.setup()) && !kind.is_list)
      kind.explain(simulation.setup(), simulation.model().specimen(), laws[kind.section]);
  if (simulation.heat() != nullptr)
    laws["conduction"]["area_factor"] = simulation.heat()->area_factor();
  return laws;
}

/// What heats the body besides imposed temperatures, for codes that take it from a prepared file.
Json heat_loads_of(const Simulation& simulation, Json report) {
  report["exchanges"] = Json::array();
  report["powers"] = Json::array();
  if (simulation.heat() == nullptr) return report;
  for (const HeatLoad* load : simulation.heat()->loads()) {
    const std::string name = load->column();
    if (const auto* exchange = dynamic_cast<const HeatExchange*>(load))
      report["exchanges"].push_back(
          {{"name", name},
           {"temperature", load->is_steady() ? Json(exchange->outside(0)) : Json(nullptr)}});
    else
      report["powers"].push_back({{"name", name}, {"constant", load->is_steady()}});
  }
  return report;
}

Json loads_of(const Setup& setup, Json report) {
  report["grips"] = Json::array();
  for (const GripParameters& grip : setup.all<GripParameters>()) {
    Json axes = Json::array();
    for (const AxisControl& axis : grip.axis)
      axes.push_back({{"kind", name_of(axis.kind)}, {"function", to_json(axis.function)}});
    report["grips"].push_back({{"name", grip.name},
                               {"axes", axes},
                               {"rotation", grip.rotation_fixed ? "fixed" : "free"}});
  }
  for (const TurningGripParameters& turning : setup.all<TurningGripParameters>()) {
    const Json turns{{"kind", "turning"}};
    report["grips"].push_back(
        {{"name", turning.grip.name}, {"axes", {turns, turns, turns}}, {"rotation", "fixed"}});
  }
  report["initial_velocities"] = setup.all<InitialVelocity>().size();
  report["temperatures"] = Json::array();
  for (const ImposedTemperatureParameters& imposed : setup.all<ImposedTemperatureParameters>())
    if (imposed.wall.empty())
      report["temperatures"].push_back(
          {{"name", imposed.name}, {"value", to_json(imposed.temperature)}});
  return report;
}

/// Seconds that one step takes here, from a few steps on this very model: the fastest of some
/// batches, since the machine may be busy with something else in the others.
double measured_step(Simulation& simulation) {
  using Clock = std::chrono::steady_clock;
  constexpr int steps = 10, most_batches = 50;
  constexpr double enough = 0.5;  // s
  simulation.advance(2);
  double fastest = std::numeric_limits<double>::infinity(), spent = 0;
  for (int batch = 0; batch < most_batches && spent < enough; ++batch) {
    const auto start = Clock::now();
    simulation.advance(steps);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    fastest = std::min(fastest, seconds / steps);
    spent += seconds;
  }
  return fastest;
}

Json report_of(const Scene& scene, Simulation& simulation) {
  const Model& model = simulation.model();
  const Plan& plan = simulation.plan();
  const TimeStepChoice& dt = simulation.time_step();
  Json report;
  report["scene"] = scene.path;
  report["title"] = scene.title;
  report["effects"] = Json::array();
  report["kernels"] = Json::array();
  for (const PlannedEffect& effect : plan.effects) {
    report["effects"].push_back({{"name", effect.name}, {"reason", effect.reason}});
    if (!effect.kernel.empty()) report["kernels"].push_back(effect.kernel);
  }
  report["columns"] = Json::array();
  for (const PlannedColumn& planned : plan.columns)
    report["columns"].push_back({{"name", planned.column->name},
                                 {"site", name_of(planned.column->site)},
                                 {"bytes", planned.column->bytes()},
                                 {"unit", planned.column->unit},
                                 {"meaning", planned.column->meaning},
                                 {"asked_by", planned.asked_by}});
  report["elements"] = model.elements();
  if (!model.specimen().bodies.empty()) report["bodies"] = body_figures(model);
  report["bonds"] = model.slots().bonds();
  report["slots"] = model.slots().rows() * lanes;
  report["unbonded_elements"] = simulation.unbonded();
  report["notes"] = notes_of(simulation);
  report["bytes"] = model.bytes();
  report["time_step"] = {{"value", dt.value},
                         {"bound", dt.bound},
                         {"limit", dt.limit},
                         {"criterion", dt.criterion},
                         {"ratio", dt.ratio}};
  report["steps"] = simulation.steps_to_run();
  report["seconds_per_step"] = measured_step(simulation);
  report["threads"] = omp_get_max_threads();
  report["instruction_set"] = kernels().instruction_set;
  report["laws"] = laws_of(simulation);
  report["density"] = simulation.setup().materials[0].density;
  if (const Heat* heat = simulation.heat(); heat != nullptr && heat->integrator() != nullptr)
    report["integration"] = heat->integrator()->explanation();
  return heat_loads_of(simulation, loads_of(simulation.setup(), std::move(report)));
}

void print(const Json& report) {
  say("{}\n\nEffects\n", report["title"].get<std::string>());
  for (const Json& effect : report["effects"])
    say("  {:<24} asked for by {}\n", effect["name"].get<std::string>(),
        effect["reason"].get<std::string>());
  say("\nHot loops\n");
  for (const Json& kernel : report["kernels"]) say("  {}\n", kernel.get<std::string>());

  const auto elements = report["elements"].get<double>(), bonds = report["bonds"].get<double>();
  say("\nColumns{:>21} {:>8}  asked by\n", "bytes", "per");
  for (const Json& column : report["columns"]) {
    std::string askers;
    for (const Json& asker : column["asked_by"]) askers += " " + asker.get<std::string>();
    say("  {:<22}{:>4} {:>8} {}\n", column["name"].get<std::string>(), column["bytes"].get<int>(),
        column["site"].get<std::string>(), askers);
  }
  say("  a slot is one side of a bond (a conductor: of what conducts heat), 4 bytes more for its "
      "neighbour's number; {:.0f} slots for {:.0f} bonds\n",
      report["slots"].get<double>(), bonds);
  say("  in all {:.0f} bytes an element, {:.1f} MB\n", report["bytes"].get<double>() / elements,
      report["bytes"].get<double>() / 1e6);

  const Json& dt = report["time_step"];
  const auto step = report["seconds_per_step"].get<double>();
  const std::string limit = dt["limit"].is_number() && std::isfinite(dt["limit"].get<double>())
                                ? fmt::format("stable up to {:.5g} s", dt["limit"].get<double>())
                                : "stable at any length";
  say("\nTime step {:.5g} s = {:.3g} x {:.5g} s ({}); {}\n", dt["value"].get<double>(),
      dt["ratio"].get<double>(), dt["bound"].get<double>(), dt["criterion"].get<std::string>(),
      limit);
  if (report["laws"].contains("conduction")) {
    const Json& heat = report["laws"]["conduction"];
    say("Conduction by the law {}, areas times {:.4g}\n", heat["law"].get<std::string>(),
        heat["area_factor"].get<double>());
  }
  if (report.contains("integration"))
    say("Heat in time: {}\n", report["integration"].get<std::string>());
  say("Cost, measured here on {} thread(s), {}: {:.3g} ms a step, {:.3g} ns a bond-step\n",
      report["threads"].get<int>(), report["instruction_set"].get<std::string>(), step * 1e3,
      step * 1e9 / bonds);
  say("{} elements, {} bonds, {} steps: about {:.3g} s\n", report["elements"].get<long>(),
      report["bonds"].get<long>(), report["steps"].get<long>(),
      step * report["steps"].get<double>());
  print_notes(report["notes"].get<std::vector<std::string>>());
}

}  // namespace

void explain_scene(const std::string& path, bool json, bool force) {
  const Scene scene = read_scene(path);
  Simulation simulation(scene.setup, make_body(scene), force);
  const Json report = report_of(scene, simulation);
  if (json)
    say("{}\n", report.dump(2));
  else
    print(report);
}

}  // namespace solidem
