// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/imposed_temperature.hpp"

namespace solidem {

ImposedTemperature::ImposedTemperature(const ImposedTemperatureParameters& parameters,
                                       std::vector<std::int32_t> elements, Model& model)
    : parameters_(parameters), elements_(std::move(elements)) {
  impose(model, model.data(columns::temperature), parameters_.temperature(0));
}

void ImposedTemperature::impose(const Model& model, double* temperature, double value) {
  const double* inverse_capacity = model.data(columns::inverse_heat_capacity);
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    heat_ += (value - temperature[i]) / inverse_capacity[i];
    temperature[i] = value;
  }
}

void ImposedTemperature::advance(Model& model, const Step& step) {
  impose(model, model.next(columns::temperature),
         parameters_.temperature(step.time + step.time_step));
}

void ImposedTemperature::observe(const Model& /*model*/, Observation& observation) const {
  observation.heat.heat_input += heat_;
  observation.add("temperature." + parameters_.name + ".value",
                  parameters_.temperature(observation.time));
  observation.add("temperature." + parameters_.name + ".heat", heat_);
}

}  // namespace solidem
