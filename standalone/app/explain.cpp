// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/print_json.hpp"
#include "app/say.hpp"
#include "effects/effect_kind.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/heat_exchange.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/time_function_json.hpp"
#include "effects/tools.hpp"
#include "effects/turning_grip.hpp"
#include "engine/body_figures.hpp"
#include "engine/heat.hpp"
#include "engine/run_forecast.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "scene/body.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

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

/// Tools as other codes must know them; their surfaces are in a prepared file.
Json tools_of(const Simulation& simulation) {
  Json tools = Json::array();
  for (const auto& effect : simulation.effects())
    if (const auto* tool = dynamic_cast<const Tool*>(effect.get()))
      tools.push_back(tool->explanation());
  return tools;
}

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// What the run will take and what the grips will do, from a trial of its beginning.
Json forecast_of(Simulation& simulation, double preparation) {
  const RunControl& run = simulation.setup().run;
  const double duration = run.duration.value_or(static_cast<double>(simulation.steps_to_run()) *
                                                simulation.time_step().value);
  const StrainForecast strain = foretell_strain(simulation, duration);
  Json forecast;
  if (!strain.sayings.empty())
    forecast["strain"] = {{"largest", strain.strain.size},
                          {"yield", number_or_null(strain.limits.yield)},
                          {"rupture", number_or_null(strain.limits.rupture)},
                          {"flowing_share", strain.flowing_share}};
  forecast["sayings"] = strain.sayings;
  try {
    const RunForecast cost = foretell_run(simulation, strain);
    forecast["seconds_per_step"] = cost.costs.step;
    forecast["seconds_per_flowing_step"] = cost.flowing_step;
    forecast["rows"] = cost.counts.rows;
    forecast["frames"] = cost.counts.frames;
    forecast["seconds"] = {{"preparation", preparation},
                           {"steps", cost.steps()},
                           {"observation", cost.rows()},
                           {"output", cost.files()},
                           {"total", preparation + cost.total()}};
  } catch (const RunError& error) {
    forecast["problem"] = error.what();
  }
  return forecast;
}

Json report_of(const Scene& scene, const Simulation& simulation) {
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
  report["threads"] = omp_get_max_threads();
  report["instruction_set"] = kernels().instruction_set;
  report["laws"] = laws_of(simulation);
  report["tools"] = tools_of(simulation);
  report["density"] = simulation.setup().materials[0].density;
  if (const Heat* heat = simulation.heat(); heat != nullptr && heat->integrator() != nullptr)
    report["integration"] = heat->integrator()->explanation();
  return heat_loads_of(simulation, loads_of(simulation.setup(), std::move(report)));
}

void print_cost(const Json& report, const Json& forecast) {
  const auto step = forecast["seconds_per_step"].get<double>(),
             flowing = forecast["seconds_per_flowing_step"].get<double>();
  say("Cost, tried here on {} thread(s), {}: {:.3g} ms a step, {:.3g} ns a bond-step{}\n",
      report["threads"].get<int>(), report["instruction_set"].get<std::string>(), step * 1e3,
      step * 1e9 / report["bonds"].get<double>(),
      flowing > step ? fmt::format("; {:.3g} ms while bonds flow", flowing * 1e3) : "");
  if (report["steps"].get<long>() == 0) return;
  const auto seconds = [&](const char* of) { return forecast["seconds"][of].get<double>(); };
  say("The run: about {:.2g} s, of which {:.2g} s before the first step, {:.2g} s for the steps, "
      "{:.2g} s for {} rows of the history, {:.2g} s for {} frames and other files\n",
      seconds("total"), seconds("preparation"), seconds("steps"), seconds("observation"),
      forecast["rows"].get<long>(), seconds("output"), forecast["frames"].get<long>());
}

void print_forecast(const Json& report) {
  const Json& forecast = report["forecast"];
  if (forecast.contains("problem"))
    say("Its beginning, tried here: {}\n", forecast["problem"].get<std::string>());
  else
    print_cost(report, forecast);
  for (const Json& saying : forecast["sayings"]) say("foretold: {}\n", saying.get<std::string>());
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
  say("{} elements, {} bonds, {} steps\n", report["elements"].get<long>(),
      report["bonds"].get<long>(), report["steps"].get<long>());
  if (report.contains("forecast")) print_forecast(report);
  print_notes(report["notes"].get<std::vector<std::string>>());
}

void explain(const Scene& scene, const ExplainCommand& command) {
  const auto start = Clock::now();
  Simulation simulation(scene.setup, make_body(scene), command.force);
  const double preparation = seconds_since(start);
  Json report = report_of(scene, simulation);
  if (!command.quick) report["forecast"] = forecast_of(simulation, preparation);
  if (command.json)
    print_json(report);
  else
    print(report);
}

}  // namespace

void explain_scene(const ExplainCommand& command) {
  const Scene scene = read_scene(command.scene);
  at_places_of(scene, [&] { explain(scene, command); });
}

}  // namespace solidem
