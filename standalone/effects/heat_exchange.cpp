// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_exchange.hpp"

#include "laws/heat_exchange.hpp"

namespace solidem {

HeatExchange::HeatExchange(const ImposedTemperatureParameters& parameters,
                           std::vector<WallFace> faces, const Conduction& conduction)
    : HeatLoad("temperature." + parameters.name),
      faces_(std::move(faces)),
      outside_(parameters.temperature),
      conduction_(conduction) {}

HeatExchange::HeatExchange(const ConvectionParameters& parameters, std::vector<WallFace> faces,
                           const Conduction& conduction)
    : HeatLoad("convection." + parameters.name),
      faces_(std::move(faces)),
      outside_(parameters.temperature),
      coefficient_(parameters.coefficient),
      conduction_(conduction) {}

double HeatExchange::conductance(const WallFace& face, double conductivity,
                                 double coefficient) const {
  const double path = path_conductance(conductivity, face.area, face.distance);
  return coefficient_ ? series_conductance(path, coefficient * face.area) : path;
}

void HeatExchange::powers(double time, const double* temperature,
                          std::vector<ElementValue>& powers) const {
  const std::size_t first = powers.size();
  conductances(time, temperature, powers);
  const double outside = outside_(time);
  for (std::size_t k = first; k < powers.size(); ++k)
    powers[k].value *= outside - temperature[powers[k].element];
}

void HeatExchange::conductances(double time, const double* temperature,
                                std::vector<ElementValue>& conductances) const {
  const double h = coefficient(time);
  for (const WallFace& face : faces_) {
    const auto i = static_cast<std::size_t>(face.element);
    conductances.push_back(
        {face.element, conductance(face, conduction_.conductivity(i, temperature[i]), h)});
  }
}

void HeatExchange::largest_conductances(std::vector<ElementValue>& conductances) const {
  const double h = coefficient_ ? coefficient_->largest() : 0;
  for (const WallFace& face : faces_) {
    const auto i = static_cast<std::size_t>(face.element);
    conductances.push_back(
        {face.element, conductance(face, conduction_.largest_conductivity(i), h)});
  }
}

void HeatExchange::observe(const Model& model, Observation& observation) const {
  observation.add(column() + ".value", outside_(observation.time));
  HeatLoad::observe(model, observation);
}

}  // namespace solidem
