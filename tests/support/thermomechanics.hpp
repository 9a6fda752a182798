// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonded bodies that are warm, for tests.
#ifndef SOLIDEM_TESTS_SUPPORT_THERMOMECHANICS_HPP
#define SOLIDEM_TESTS_SUPPORT_THERMOMECHANICS_HPP

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "effects/bond_temperature.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/plastic_heat.hpp"
#include "laws/constants.hpp"
#include "support/beams.hpp"
#include "support/heat.hpp"

namespace solidem {

/// A setup of bonds with temperatures.
inline Setup warm(Setup setup, double temperature = 300, double expansion_coefficient = 23e-6) {
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->initial_temperature = temperature;
  for (Material& material : setup.materials) material.expansion_coefficient = expansion_coefficient;
  return setup;
}

/// The same that expands from a temperature on.
inline Setup expanding(Setup setup, double temperature, double reference,
                       double expansion_coefficient = 23e-6) {
  setup = warm(std::move(setup), temperature, expansion_coefficient);
  setup.get<ExpansionParameters>() = ExpansionParameters{reference};
  return setup;
}

/// Heat that arises everywhere, W/m³.
inline HeatSourceParameters heated_everywhere(double power_density) {
  HeatSourceParameters source;
  source.name = "all";
  source.region = Region{};
  source.power = TimeFunction::constant(power_density);
  return source;
}

/// A free bar that stretches, bends and twists at once, at a speed.
inline std::unique_ptr<Simulation> struck(const Setup& setup, const Specimen& specimen,
                                          double speed) {
  auto simulation = std::make_unique<Simulation>(setup, specimen);
  const Model& model = simulation->model();
  const Vector size = model.specimen().domain.upper;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector p = model.specimen().position[i] - 0.5 * size;
    const double wave = std::sin(pi * p.x / size.x);
    set_velocity(
        *simulation, i,
        speed * Vector{wave, wave * wave - 0.5 * wave * p.z / size.z, 0.5 * wave * p.y / size.y});
  }
  return simulation;
}

/// Brings a body to rest: takes a part of all velocities after each step.
inline void bring_to_rest(Simulation& simulation, int steps) {
  constexpr double kept = 0.95;
  double* velocity = simulation.model().data(columns::velocity);
  double* spin = simulation.model().data(columns::angular_velocity);
  const std::size_t size = simulation.model().size(columns::velocity);
  for (int n = 0; n < steps; ++n) {
    simulation.advance(1);
    for (std::size_t k = 0; k < size; ++k) {
      velocity[k] *= kept;
      spin[k] *= kept;
    }
  }
}

inline double temperature_of(const Simulation& simulation, std::size_t element) {
  return simulation.model().data(columns::temperature)[element];
}

/// The length of a bond free of load, as either of its elements has it, m.
inline double rest_length(const Simulation& simulation, std::int32_t i, std::int32_t j) {
  const Slots::Place place = *simulation.model().slots().find(i, j);
  return simulation.model().data(columns::rest_length)[place.index()];
}

}  // namespace solidem

#endif
