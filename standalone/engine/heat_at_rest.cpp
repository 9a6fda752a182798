// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/heat_at_rest.hpp"

#include "effects/bond_temperature.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/selections.hpp"
#include "engine/heat.hpp"

namespace solidem {

namespace {

constexpr std::int64_t steps = 200;

/// What of a setup is heat alone.
Setup heat_of(const Simulation& simulation, double time) {
  const Setup& setup = simulation.setup();
  Setup heat;
  heat.materials = setup.materials;
  heat.get<ConductionParameters>() = setup.get<ConductionParameters>();
  ConductionParameters& conduction = *heat.get<ConductionParameters>();
  if (conduction.integrator == ConductionParameters::Integrator::explicit_euler)
    conduction.integrator = ConductionParameters::Integrator::implicit;
  if (conduction.law == ConductionParameters::Law::platonic_calibrated)
    conduction.area_factor = simulation.heat()->area_factor();
  conduction.every = 1;
  conduction.largest_change.reset();
  heat.all<HeatSourceParameters>() = setup.all<HeatSourceParameters>();
  heat.all<HeatFluxParameters>() = setup.all<HeatFluxParameters>();
  heat.all<ConvectionParameters>() = setup.all<ConvectionParameters>();
  heat.all<ImposedTemperatureParameters>() = setup.all<ImposedTemperatureParameters>();
  heat.run.steps = steps;
  heat.run.time_step = time / static_cast<double>(steps);
  return heat;
}

}  // namespace

std::vector<double> temperature_at_rest(const Simulation& simulation, double time) {
  Specimen specimen = simulation.model().specimen();
  specimen.bonds = simulation.model().conductors().pairs();
  Simulation heat(heat_of(simulation, time), std::move(specimen));
  heat.advance(steps);
  const double* temperature = heat.model().data(columns::temperature);
  return {temperature, temperature + heat.model().elements()};
}

std::vector<double> thermal_strain(const Simulation& simulation, const std::vector<Pair>& bonds,
                                   const std::vector<double>& temperature) {
  const Setup& setup = simulation.setup();
  const Specimen& specimen = simulation.model().specimen();
  const std::vector<std::size_t> material = assign_materials(setup.materials, specimen);
  const double reference = setup.get<ExpansionParameters>()->reference_temperature.value_or(
      setup.get<ConductionParameters>()->initial_temperature);
  std::vector<double> of_element;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const TemperatureFunction& alpha =
        setup.materials[material.empty() ? 0 : material[i]].expansion_coefficient;
    of_element.push_back(alpha.integral(temperature[i]) - alpha.integral(reference));
  }
  std::vector<double> strain;
  for (const Pair& pair : bonds)
    strain.push_back(0.5 * (of_element[static_cast<std::size_t>(pair.i)] +
                            of_element[static_cast<std::size_t>(pair.j)]));
  return strain;
}

}  // namespace solidem
