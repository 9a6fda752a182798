// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/plan.hpp"

#include "effects/beams.hpp"
#include "effects/central_forces.hpp"
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

std::string beam_kernel(const BeamDemands& demands, bool periodic) {
  std::string kernel = demands.turning() ? "move_beams" : "move_beams, springs";
  if (demands.watch() == Watch::remembering)
    kernel += demands.needs(periodic).measured_since_made ? ", scaled offset" : ", radial return";
  if (demands.watch() == Watch::watched) kernel += ", brittle";
  if (!beams_are_alike(demands.elasticity)) kernel += ", a rigidity for each bond";
  if (periodic) kernel += ", periodic";
  if (demands.elasticity.precision == BeamParameters::Precision::mixed)
    kernel += ", law in single precision";
  return kernel;
}

std::string central_kernel(const Setup& setup, bool periodic) {
  const CentralForceParameters& forces = *setup.central_forces;
  std::string kernel = "move_by_central_forces, ";
  kernel += std::visit([](const auto& law) { return law.name; }, forces.law);
  if (forces.dissipation) kernel += ", dissipation";
  if (setup.damage && setup.damage->lip) kernel += ", cracks";
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

BeamDemands demands_of(const Setup& setup) {
  return {setup.beams.value(), setup.plasticity, setup.rupture,
          setup.contact && setup.contact->rebonding_pressure};
}

Plan make_plan(const Setup& setup, bool periodic) {
  Plan plan;
  if (setup.beams) {
    const BeamDemands demands = demands_of(setup);
    std::string reason = "[beams]";
    if (setup.beams->anisotropy) reason += " [beams.anisotropy]";
    if (setup.beams->fibres) reason += " [beams.fibres]";
    if (setup.plasticity) reason += " [plasticity]";
    plan.effects.push_back({"beams", reason, beam_kernel(demands, periodic)});
    ask(plan, "beams", Beams::columns(demands, periodic));
    if (setup.rupture) plan.effects.push_back({"rupture", "[rupture]", ""});
    if (setup.contact) plan.effects.push_back({"contact", "[contact]", ""});
  }
  if (setup.central_forces) {
    const bool cracks = setup.damage && setup.damage->lip;
    // Damage looks at the places that the next step begins with.
    if (setup.damage)
      plan.effects.push_back({"damage", "[damage]", cracks ? "find_crack_lips" : ""});
    plan.effects.push_back({"central forces", "[central_forces]", central_kernel(setup, periodic)});
    ask(plan, "central forces", CentralForces::columns(*setup.central_forces, cracks, periodic));
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
