// SPDX-License-Identifier: GPL-2.0-or-later
//
// Setups of conduction for tests.
#ifndef SOLIDEM_TESTS_SUPPORT_HEAT_HPP
#define SOLIDEM_TESTS_SUPPORT_HEAT_HPP

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/specimens.hpp"

namespace solidem {

using HeatLaw = ConductionParameters::Law;
using HeatIntegratorName = ConductionParameters::Integrator;

/// Aluminium at 298 K.
inline Setup heat_setup(HeatLaw law, HeatIntegratorName integrator) {
  auto setup = thermal_setup();
  setup.get<ConductionParameters>()->law = law;
  setup.get<ConductionParameters>()->integrator = integrator;
  return setup;
}

/// A wall held at a temperature.
inline ImposedTemperatureParameters held_wall(const std::string& wall, double temperature) {
  return {"of_" + wall, {}, TimeFunction::constant(temperature), wall};
}

/// A shape of one part.
inline Shape ball(double radius) {
  Shape shape;
  shape.parts.push_back({Shape::Kind::sphere, radius});
  return shape;
}

/// A source that is a ball at a place.
inline HeatSourceParameters ball_source(double radius, const Vector& centre, double power_density) {
  HeatSourceParameters source;
  source.name = "ball";
  source.shape = ball(radius);
  source.position = {TimeFunction::constant(centre.x), TimeFunction::constant(centre.y),
                     TimeFunction::constant(centre.z)};
  source.power = TimeFunction::constant(power_density);
  return source;
}

/// The lowest and the highest temperature, K.
inline std::pair<double, double> extremes(const Simulation& simulation) {
  const double* t = simulation.model().data(columns::temperature);
  const auto [low, high] = std::minmax_element(t, t + simulation.model().elements());
  return {*low, *high};
}

/// |heat balance| as part of the heat that came in or is there.
inline double relative_imbalance(const Simulation& simulation) {
  const HistoryRow row = simulation.observe();
  const double scale =
      std::max(std::abs(value_of(row, "heat_input")), std::abs(value_of(row, "thermal_energy")));
  return std::abs(value_of(row, "heat_balance")) / scale;
}

inline const char* label(HeatIntegratorName integrator) {
  return name_of(integrator);
}

}  // namespace solidem

#endif
