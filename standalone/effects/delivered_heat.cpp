// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/delivered_heat.hpp"

#include <algorithm>

#include "model/blocks.hpp"

namespace solidem {

void deliver_heat(Model& model, const Conduction& conduction, double fraction, const Column& made,
                  const Column& given) {
  const double* whole = model.data(made);
  double* so_far = model.data(given);
  double* temperature = model.data(columns::temperature);
  for_blocks(model.elements(), 1 << 14, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double heat = fraction * whole[i] - so_far[i];
      if (heat == 0) continue;
      const double before = temperature[i];
      temperature[i] = conduction.heated(model, i, before, heat);
      so_far[i] += conduction.heat(model, i, before, temperature[i]);
    }
  });
}

double sum_of(const Model& model, const Column& column) {
  const double* value = model.data(column);
  long double sum = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) sum += static_cast<long double>(value[i]);
  return static_cast<double>(sum);
}

void observe_waiting_heat(Observation& observation, double heat) {
  const auto known = std::find_if(observation.values.begin(), observation.values.end(),
                                  [](const auto& value) { return value.first == "waiting_heat"; });
  if (known == observation.values.end())
    observation.add("waiting_heat", heat);
  else
    known->second += heat;
}

}  // namespace solidem
