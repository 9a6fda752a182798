// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a gauge measures, and what an element's own images add.
#include "engine/gauge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/error.hpp"
#include "support/specimens.hpp"

namespace solidem {
namespace {

Setup with_central_forces(double range) {
  Setup setup;
  setup.materials.push_back(material_of(1000, 880, 134));
  LennardJones law;
  law.energy = 1;
  CentralForceParameters forces;
  forces.law = law;
  forces.range = range;
  forces.equilibrium = CentralForceParameters::Equilibrium::radii;
  setup.get<CentralForceParameters>() = forces;
  setup.run.steps = 1;
  return setup;
}

Specimen block(std::array<bool, 3> periodic = {false, false, false},
               std::array<int, 3> cells = {8, 4, 4}) {
  Specimen specimen = crystal("simple_cubic", cells, periodic);
  make_bonds(specimen, 0);
  return specimen;
}

TEST(Gauge, sees_no_strain_in_a_rotation_and_the_stretch_of_a_turned_body) {
  auto setup = with_central_forces(1.2);
  setup.gauge = Gauge{0, 2e-4, 14e-4};
  Simulation simulation(setup, block());
  Model& model = simulation.model();
  const double angle = 0.7, along = 1.01, across = 0.997;
  double* position = model.data(columns::position);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector& p = model.specimen().position[i];
    const double x = along * p.x, y = across * p.y;
    position[4 * i] = std::cos(angle) * x - std::sin(angle) * y;
    position[4 * i + 1] = std::sin(angle) * x + std::cos(angle) * y;
    position[4 * i + 2] = across * p.z;
  }
  const HistoryRow row = simulation.observe();
  EXPECT_NEAR(value_of(row, "gauge.strain"), along - 1, 1e-12);
  EXPECT_NEAR(value_of(row, "gauge.lateral_strain"), across - 1, 1e-12);
}

TEST(Gauge, that_would_measure_something_else_is_refused) {
  auto setup = with_central_forces(1.2);
  setup.gauge = Gauge{0, 2e-4, 17e-4};
  EXPECT_THROW(Simulation(setup, block()), InputError);
  setup.gauge = Gauge{0, 2e-4, 14e-4};
  EXPECT_THROW(Simulation(setup, block({true, false, false})), InputError);
  EXPECT_NO_THROW(Simulation(setup, block({false, true, true})));
}

TEST(Sensors, far_from_the_body_are_refused) {
  auto setup = with_central_forces(1.2);
  setup.sensors.push_back({"far", {1, 0, 0}, Sensor::Quantity::displacement});
  EXPECT_THROW(Simulation(setup, block()), InputError);
  setup.sensors[0].point = {-2e-4, 0, 0};
  EXPECT_NO_THROW(Simulation(setup, block()));
}

TEST(CentralForces, of_an_element_on_its_own_images_count) {
  // Every element sees every image within the range; each pair counts once.
  constexpr int cells = 3;
  constexpr double range = 4.1, diameter = 2e-4;
  double pairs = 0, energy = 0;
  for (int a = -5; a <= 5; ++a)
    for (int b = -5; b <= 5; ++b)
      for (int c = -5; c <= 5; ++c) {
        const double distance = std::sqrt(double(a * a + b * b + c * c));
        if (distance == 0 || distance >= range) continue;
        pairs += 0.5 * cells * cells * cells;
        // ε (δ_eq¹²/δ¹² − 2 δ_eq⁶/δ⁶), whose force is 12 ε (δ_eq¹²/δ¹³ − δ_eq⁶/δ⁷)
        const auto potential = [&](double d) { return std::pow(d, -12) - 2 * std::pow(d, -6); };
        energy += 0.5 * cells * cells * cells * (potential(distance) - potential(range));
      }
  Simulation simulation(with_central_forces(range),
                        block({true, true, true}, {cells, cells, cells}));
  const HistoryRow row = simulation.observe();
  EXPECT_EQ(value_of(row, "interactions"), pairs);
  EXPECT_EQ(pairs, 3456);
  EXPECT_NEAR(value_of(row, "potential_energy") / energy, 1, 1e-12) << diameter;
}

}  // namespace
}  // namespace solidem
