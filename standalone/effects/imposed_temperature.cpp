// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/imposed_temperature.hpp"

namespace solidem {

ImposedTemperature::ImposedTemperature(const ImposedTemperatureParameters& parameters,
                                       std::vector<std::int32_t> elements,
                                       const Conduction& conduction, Model& model)
    : parameters_(parameters), elements_(std::move(elements)), conduction_(conduction) {
  impose(model, model.data(columns::temperature), temperature(0));
}

void ImposedTemperature::impose(const Model& model, double* temperature, double value) {
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    heat_ += conduction_.heat(model, i, temperature[i], value);
    temperature[i] = value;
  }
}

void ImposedTemperature::advance(Model& model, const Step& step) {
  impose(model, model.next(columns::temperature), temperature(step.time + step.time_step));
}

void ImposedTemperature::observe(const Model& /*model*/, Observation& observation) const {
  observation.heat.heat_input += heat_;
  observation.add("temperature." + parameters_.name + ".value", temperature(observation.time));
  observation.add("temperature." + parameters_.name + ".heat", heat_);
}

}  // namespace solidem
