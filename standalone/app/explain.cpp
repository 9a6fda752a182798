// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <omp.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "effects/heat_exchange.hpp"
#include "effects/kernels/kernels.hpp"
#include "engine/heat.hpp"
#include "scene/body.hpp"
#include "solve/heat_integrator.hpp"

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

/// A constant as a number, a table as {temperature, value}.
Json to_json(const TemperatureFunction& f) {
  if (f.is_constant()) return f(0);
  return {{"temperature", f.temperatures()}, {"value", f.values()}};
}

Json conduction_of(const Simulation& simulation) {
  const Setup& setup = simulation.setup();
  return {{"law", name_of(setup.conduction->law)},
          {"initial_temperature", setup.conduction->initial_temperature},
          {"conductivity", to_json(setup.materials[0].conductivity)},
          {"specific_heat_capacity", to_json(setup.materials[0].specific_heat)},
          {"area_factor", simulation.heat()->area_factor()},
          {"integrator", name_of(setup.conduction->integrator)}};
}

Json to_json(const Vector& v) {
  return {v.x, v.y, v.z};
}

Json anisotropy_of(const Anisotropy& grain) {
  const auto& shear = grain.transverse_shear_modulus;
  return {{"grain", to_json(grain.axes.longitudinal)},
          {"radial", to_json(grain.axes.radial)},
          {"radial_modulus", grain.radial_modulus},
          {"tangential_modulus", grain.tangential_modulus},
          {"transverse_shear_modulus", shear ? Json(*shear) : Json(nullptr)},
          {"exponent", grain.exponent}};
}

Json fibres_of(const Fibres& fibres) {
  return {{"direction", to_json(fibres.rule.direction)},
          {"reach", fibres.rule.reach},
          {"alignment", fibres.rule.alignment},
          {"stiffness_ratio", fibres.stiffness_ratio}};
}

Json central_forces_of(const CentralForceParameters& forces) {
  Json result = Json::object();
  std::visit(
      [&result](const auto& law) {
        result["law"] = law.name;
        for (const auto& parameter : law.parameters())
          result["parameters"][parameter.name] = law.*parameter.place;
      },
      forces.law);
  result["range"] = forces.range;
  result["equilibrium"] = name_of(forces.equilibrium);
  result["neighbours"] = name_of(forces.neighbours);
  result["interpenetration"] = forces.interpenetration;
  result["dissipation"] = forces.dissipation ? Json(*forces.dissipation) : Json(nullptr);
  result["skin"] = forces.skin ? Json(*forces.skin) : Json(nullptr);
  result["bond_tolerance"] = forces.bond_tolerance;
  return result;
}

/// Adds the parameters of a law of bonds; one that is without limit is null.
template <class AnyLaw>
void add_parameters(Json& json, const AnyLaw& any) {
  std::visit(
      [&](const auto& law) {
        for (const auto& parameter : law.parameters()) {
          const double value = law.*parameter.member;
          json[parameter.name] = std::isfinite(value) ? Json(value) : Json(nullptr);
        }
      },
      any);
}

Json laws_of(const Simulation& simulation) {
  const Setup& setup = simulation.setup();
  Json laws = Json::object();
  if (setup.beams) {
    const BeamParameters& beams = *setup.beams;
    const bool pair = beams.radius_from == BeamParameters::RadiusFrom::pair;
    laws["beams"] = {{"law", name_of(beams.law)},
                     {"young_modulus", beams.young_modulus},
                     {"shear_modulus", beams.shear_modulus},
                     {"shear_coefficient", beams.shear_coefficient},
                     {"radius_ratio", beams.radius_ratio},
                     {"radius_from", pair ? "pair" : "mean"},
                     {"mean_radius", mean_radius(simulation.model().specimen())}};
  }
  if (setup.beams && setup.beams->anisotropy)
    laws["beams"]["anisotropy"] = anisotropy_of(*setup.beams->anisotropy);
  if (setup.beams && setup.beams->fibres) laws["beams"]["fibres"] = fibres_of(*setup.beams->fibres);
  const auto number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  if (setup.plasticity) {
    laws["plasticity"] = {{"law", name_of(setup.plasticity->law)},
                          {"hardening", name_of(setup.plasticity->hardening)}};
    add_parameters(laws["plasticity"], setup.plasticity->hardening);
  }
  if (setup.rupture) {
    laws["rupture"] = {{"law", name_of(setup.rupture->law)},
                       {"minimal_bonds", setup.rupture->minimal_bonds}};
    add_parameters(laws["rupture"], setup.rupture->law);
  }
  if (setup.contact)
    laws["contact"] = {{"stiffness_ratio", setup.contact->stiffness_ratio},
                       {"rebonding_pressure", number(setup.contact->rebonding_pressure)}};
  if (setup.central_forces) laws["central_forces"] = central_forces_of(*setup.central_forces);
  if (setup.damage)
    laws["damage"] = {{"lip", number(setup.damage->lip)},
                      {"every", setup.damage->every},
                      {"minimal_neighbours", setup.damage->minimal_neighbours},
                      {"removal_every", setup.damage->removal_every}};
  if (setup.conduction) laws["conduction"] = conduction_of(simulation);
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
  for (const GripParameters& grip : setup.grips) {
    Json axes = Json::array();
    for (const AxisControl& axis : grip.axis)
      axes.push_back({{"kind", name_of(axis.kind)}, {"function", to_json(axis.function)}});
    report["grips"].push_back({{"name", grip.name},
                               {"axes", axes},
                               {"rotation", grip.rotation_fixed ? "fixed" : "free"}});
  }
  report["initial_velocities"] = setup.initial_velocities.size();
  report["temperatures"] = Json::array();
  for (const ImposedTemperatureParameters& imposed : setup.temperatures)
    if (imposed.wall.empty())
      report["temperatures"].push_back(
          {{"name", imposed.name}, {"value", to_json(imposed.temperature)}});
  return report;
}

/// Seconds that one step takes here and now, from a few steps on this very model.
double measured_step(Simulation& simulation) {
  using Clock = std::chrono::steady_clock;
  constexpr int steps = 10;
  simulation.advance(2);
  const auto start = Clock::now();
  simulation.advance(steps);
  return std::chrono::duration<double>(Clock::now() - start).count() / steps;
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
  report["bonds"] = model.slots().bonds();
  report["slots"] = model.slots().rows() * lanes;
  report["unbonded_elements"] = simulation.unbonded();
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
  fmt::print("{}\n\nEffects\n", report["title"].get<std::string>());
  for (const Json& effect : report["effects"])
    fmt::print("  {:<24} asked for by {}\n", effect["name"].get<std::string>(),
               effect["reason"].get<std::string>());
  fmt::print("\nHot loops\n");
  for (const Json& kernel : report["kernels"]) fmt::print("  {}\n", kernel.get<std::string>());

  const auto elements = report["elements"].get<double>(), bonds = report["bonds"].get<double>();
  fmt::print("\nColumns{:>21} {:>8}  asked by\n", "bytes", "per");
  for (const Json& column : report["columns"]) {
    std::string askers;
    for (const Json& asker : column["asked_by"]) askers += " " + asker.get<std::string>();
    fmt::print("  {:<22}{:>4} {:>8} {}\n", column["name"].get<std::string>(),
               column["bytes"].get<int>(), column["site"].get<std::string>(), askers);
  }
  fmt::print(
      "  a slot is one side of a bond (a conductor: of what conducts heat), 4 bytes more for its "
      "neighbour's number; {:.0f} slots for {:.0f} bonds\n",
      report["slots"].get<double>(), bonds);
  fmt::print("  in all {:.0f} bytes an element, {:.1f} MB\n",
             report["bytes"].get<double>() / elements, report["bytes"].get<double>() / 1e6);

  const Json& dt = report["time_step"];
  const auto step = report["seconds_per_step"].get<double>();
  const std::string limit = dt["limit"].is_number() && std::isfinite(dt["limit"].get<double>())
                                ? fmt::format("stable up to {:.5g} s", dt["limit"].get<double>())
                                : "stable at any length";
  fmt::print("\nTime step {:.5g} s = {:.3g} x {:.5g} s ({}); {}\n", dt["value"].get<double>(),
             dt["ratio"].get<double>(), dt["bound"].get<double>(),
             dt["criterion"].get<std::string>(), limit);
  if (report["laws"].contains("conduction")) {
    const Json& heat = report["laws"]["conduction"];
    fmt::print("Conduction by the law {}, areas times {:.4g}\n", heat["law"].get<std::string>(),
               heat["area_factor"].get<double>());
  }
  if (report.contains("integration"))
    fmt::print("Heat in time: {}\n", report["integration"].get<std::string>());
  fmt::print("Cost, measured here on {} thread(s), {}: {:.3g} ms a step, {:.3g} ns a bond-step\n",
             report["threads"].get<int>(), report["instruction_set"].get<std::string>(), step * 1e3,
             step * 1e9 / bonds);
  fmt::print("{} elements, {} bonds, {} steps: about {:.3g} s\n", report["elements"].get<long>(),
             report["bonds"].get<long>(), report["steps"].get<long>(),
             step * report["steps"].get<double>());
  if (report["unbonded_elements"].get<long>() > 0)
    fmt::print("{} elements have no bond: nothing moves or heats them, no measure counts them\n",
               report["unbonded_elements"].get<long>());
}

}  // namespace

void explain_scene(const std::string& path, bool json, bool force) {
  const Scene scene = read_scene(path);
  Simulation simulation(scene.setup, make_body(scene), force);
  const Json report = report_of(scene, simulation);
  if (json)
    fmt::print("{}\n", report.dump(2));
  else
    print(report);
}

}  // namespace solidem
