// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/conduction.hpp"

#include <algorithm>
#include <limits>

#include "effects/kernels/kernels.hpp"
#include "laws/platonic_conduction.hpp"

namespace solidem {

namespace {

double of_element(const std::vector<double>& values, std::size_t i) {
  return values[values.size() == 1 ? 0 : i];
}

double harmonic_mean(double a, double b) {
  return a == b ? a : 2 * a * b / (a + b);
}

}  // namespace

std::vector<const Column*> Conduction::columns() {
  return {&columns::temperature, &columns::inverse_heat_capacity, &columns::conductance};
}

Conduction::Conduction(const ConductionParameters& parameters, const ThermalProperties& properties,
                       Model& model)
    : initial_temperature_(parameters.initial_temperature) {
  const Specimen& specimen = model.specimen();
  const std::vector<int> coordination = model.slots().coordination();
  const auto element = [&](std::size_t i) {
    return PlatonicElement{specimen.radius[i], static_cast<double>(coordination[i])};
  };
  double* temperature = model.data(columns::temperature);
  double* inverse_capacity = model.data(columns::inverse_heat_capacity);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    temperature[i] = parameters.initial_temperature;
    inverse_capacity[i] = 1 / platonic_heat_capacity(element(i), of_element(properties.density, i),
                                                     of_element(properties.specific_heat, i));
  }
  double* conductance = model.data(columns::conductance);
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const auto a = static_cast<std::size_t>(std::min(i, j));
    const auto b = static_cast<std::size_t>(std::max(i, j));
    const double lambda = harmonic_mean(of_element(properties.conductivity, a),
                                        of_element(properties.conductivity, b));
    const double distance = norm(rest_chord(specimen, {std::min(i, j), std::max(i, j)}));
    conductance[Model::at_slot(columns::conductance, row, lane)] =
        platonic_conductance(element(a), element(b), lambda, distance);
  });
}

TimeStepCriterion Conduction::time_step_criterion(const Model& model) const {
  const double* inverse_capacity = model.data(columns::inverse_heat_capacity);
  const double* conductance = model.data(columns::conductance);
  std::vector<double> sum(model.elements(), 0.0);
  model.slots().for_each([&](std::int32_t i, std::int32_t, std::size_t row, int lane) {
    sum[static_cast<std::size_t>(i)] +=
        conductance[Model::at_slot(columns::conductance, row, lane)];
  });
  double rate = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) rate = std::max(rate, sum[i] * inverse_capacity[i]);
  return {"sum of an element's conductances",
          rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity()};
}

void Conduction::advance(Model& model, const Step& step) {
  const HeatFlow flow{model.slots().first_row(),
                      model.slots().neighbours(),
                      model.data(columns::temperature),
                      model.next(columns::temperature),
                      model.data(columns::inverse_heat_capacity),
                      model.data(columns::conductance),
                      step.time_step};
  const auto conduct = kernels().conduct;
  for_blocks(model.slots().blocks(), 640,
             [&](std::size_t first, std::size_t last) { conduct(flow, first, last); });
}

void Conduction::observe(const Model& model, Observation& observation) const {
  const double* temperature = model.data(columns::temperature);
  const double* inverse_capacity = model.data(columns::inverse_heat_capacity);
  long double energy = 0;
  for (std::size_t i = 0; i < model.elements(); ++i)
    energy += static_cast<long double>(temperature[i] - initial_temperature_) / inverse_capacity[i];
  observation.heat.thermal_energy = static_cast<double>(energy);
}

}  // namespace solidem
