// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_load.hpp"

namespace solidem {

void HeatLoad::advance(Model& model, const Step& step) {
  const double* inverse_capacity = model.data(columns::inverse_heat_capacity);
  double* next = model.next(columns::temperature);
  powers_.clear();
  powers(step.time, model.data(columns::temperature), powers_);
  double power_sum = 0;  // by itself first: small figures lose digits to a large sum, step by step
  for (const ElementValue& power : powers_) {
    const auto i = static_cast<std::size_t>(power.element);
    next[i] += step.time_step * power.value * inverse_capacity[i];
    power_sum += power.value;
  }
  heat_ += step.time_step * power_sum;
}

void HeatLoad::observe(const Model& /*model*/, Observation& observation) const {
  observation.heat.heat_input += heat_;
  observation.add(column_ + ".heat", heat_);
}

}  // namespace solidem
