// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/plan.hpp"

#include "effects/beams.hpp"
#include "effects/conduction.hpp"

namespace solidem {

namespace {

void ask(Plan& plan, const std::string& effect, const std::vector<const Column*>& asked) {
  for (const Column* column : asked) {
    PlannedColumn* planned = nullptr;
    for (PlannedColumn& present : plan.columns)
      if (present.column == column) planned = &present;
    if (planned == nullptr) {
      plan.columns.push_back({column, {}});
      planned = &plan.columns.back();
    }
    planned->asked_by.push_back(effect);
  }
}

std::string beam_kernel(const BeamParameters& beams, bool periodic) {
  std::string kernel = "move_beams";
  if (beams.radius_from == BeamParameters::RadiusFrom::pair) kernel += ", radius from the pair";
  if (periodic) kernel += ", periodic";
  return kernel;
}

/// The hot loop of conduction: a whole explicit step where it can be, else the power alone.
std::string heat_kernel(const Setup& setup) {
  const bool varies = conductivity_varies(setup.materials) || capacity_varies(setup.materials);
  const bool fused =
      !varies && setup.conduction->integrator == ConductionParameters::Integrator::explicit_euler;
  std::string kernel = fused ? "conduct" : "conducted_power";
  if (conductivity_varies(setup.materials)) kernel += ", conductivity from the temperature";
  if (conductivity_varies(setup.materials) && !setup.conduction->contacts.empty())
    kernel += ", contacts";
  return kernel;
}

}  // namespace

Plan make_plan(const Setup& setup, bool periodic) {
  Plan plan;
  if (setup.beams) {
    plan.effects.push_back({"beams", "[beams]", beam_kernel(*setup.beams, periodic)});
    ask(plan, "beams", Beams::columns(*setup.beams, periodic));
  }
  for (const GripParameters& grip : setup.grips)
    plan.effects.push_back({"grip " + grip.name, "[[grips]]", ""});
  if (setup.conduction) {
    plan.effects.push_back({"conduction", "[conduction]", heat_kernel(setup)});
    ask(plan, "conduction", Conduction::columns(*setup.conduction, setup.materials));
  }
  for (const HeatSourceParameters& source : setup.heat_sources)
    plan.effects.push_back({"heat source " + source.name, "[[heat_sources]]", ""});
  for (const HeatFluxParameters& flux : setup.heat_fluxes)
    plan.effects.push_back({"heat flux " + flux.name, "[[heat_fluxes]]", ""});
  for (const ConvectionParameters& convection : setup.convections)
    plan.effects.push_back({"convection " + convection.name, "[[convections]]", ""});
  for (const ImposedTemperatureParameters& imposed : setup.temperatures)
    if (!imposed.wall.empty())
      plan.effects.push_back({"temperature " + imposed.name, "[[temperatures]]", ""});
  // What is imposed comes last: it sets what the others have changed.
  for (const ImposedTemperatureParameters& imposed : setup.temperatures)
    if (imposed.wall.empty())
      plan.effects.push_back({"temperature " + imposed.name, "[[temperatures]]", ""});
  return plan;
}

}  // namespace solidem
