// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a gauge measures, and what an element's own images add.
#include "engine/gauge.hpp"
#include "effects/central_force_parameters.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "effects/beam_parameters.hpp"
#include "model/error.hpp"
#include "model/region.hpp"
#include "specimen/bonds.hpp"
#include "support/beams.hpp"
#include "support/specimens.hpp"

namespace solidem::gauge_test {

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
  EXPECT_NO_THROW(Simulation(setup, block()));
}

/// The stress of a cubic lattice, of the well depth over the cube of the distance: of all
/// neighbours within the range.
double lattice_stress(double range) {
  double sum = 0;
  const int most = static_cast<int>(range);
  for (int a = -most; a <= most; ++a)
    for (int b = -most; b <= most; ++b)
      for (int c = -most; c <= most; ++c) {
        const double distance = std::sqrt(double(a * a + b * b + c * c));
        if (distance > 0 && distance < range)
          sum += 6 * a * a * (std::pow(distance, -8) - std::pow(distance, -14));
      }
  return sum;
}

TEST(Gauge, along_a_period_counts_what_passes_from_end_to_end) {
  EXPECT_NEAR(lattice_stress(1.45), 2.625, 1e-12);  // eight neighbours at the root of 2
  constexpr double diameter = 2e-4;
  // Beyond three diameters an element sees itself.
  for (const double range : {1.45, 2.3, 4.1})
    for (const Gauge gauge : {Gauge{0, 0.4e-4, 5.6e-4}, Gauge{2, 0, 6e-4}}) {
      auto setup = with_central_forces(range);
      setup.gauge = gauge;
      const Simulation simulation(setup, block({true, true, true}, {3, 3, 3}));
      const HistoryRow row = simulation.observe();
      const double unit = 1 / (diameter * diameter * diameter);
      EXPECT_NEAR(value_of(row, "gauge.stress") / unit / lattice_stress(range), 1, 1e-12) << range;
      EXPECT_NEAR(value_of(row, "gauge.strain"), 0, 1e-15);
    }
}

TEST(Gauge, of_a_body_that_moved_over_its_period_is_the_same) {
  auto setup = with_central_forces(2.3);
  setup.gauge = Gauge{0, 0.4e-4, 3.5e-4};
  Simulation simulation(setup, block({true, true, true}, {3, 3, 3}));
  const double before = value_of(simulation.observe(), "gauge.stress");
  Model& model = simulation.model();
  for (std::size_t i = 0; i < model.elements(); ++i) model.positions()[i][0] += 1.7e-4;
  EXPECT_NEAR(value_of(simulation.observe(), "gauge.stress") / before, 1, 1e-10);
}

TEST(Sensors, far_from_the_body_are_refused) {
  auto setup = with_central_forces(1.2);
  setup.sensors.push_back({"far", {1, 0, 0}, Sensor::Quantity::displacement});
  EXPECT_THROW(Simulation(setup, block()), InputError);
  setup.sensors[0].point = {-2e-4, 0, 0};
  EXPECT_NO_THROW(Simulation(setup, block()));
}

TEST(Sensors, fitted_see_a_linear_field_at_their_point_and_the_nearest_that_of_its_element) {
  const Specimen specimen = block();
  auto setup = with_central_forces(1.2);
  const Vector point{15.7e-4, 4.4e-4, 1.3e-4};  // on no element's centre, near a face
  const auto add = [&](const char* name, Sensor::Quantity quantity, Sensor::Sampling sampling) {
    setup.sensors.push_back({name, point, quantity, sampling});
  };
  add("moved", Sensor::Quantity::displacement, Sensor::Sampling::fit);
  add("place", Sensor::Quantity::position, Sensor::Sampling::fit);
  add("speed", Sensor::Quantity::velocity, Sensor::Sampling::fit);
  add("near", Sensor::Quantity::displacement, Sensor::Sampling::nearest);
  Simulation simulation(setup, specimen);
  Model& model = simulation.model();
  const auto field = [](const Vector& p) {
    return std::array{2e-6 + 0.01 * p.x - 0.02 * p.y, 0.03 * p.z, -0.005 * p.x + 0.001 * p.y};
  };
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const std::array<double, 3> moved = field(specimen.position[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      model.positions()[i][axis] += moved[axis];
      model.data(columns::velocity)[Model::at(columns::velocity, i, static_cast<int>(axis))] =
          1e3 * moved[axis];
    }
  }
  const HistoryRow row = simulation.observe();
  const std::array at = {point.x, point.y, point.z};
  const std::array<double, 3> here = field(point);
  const std::array<double, 3> there = field(specimen.position[static_cast<std::size_t>(
      nearest_element(specimen, elements_of_the_body(count_bonds(specimen)), point))]);
  constexpr std::array axes{"_x", "_y", "_z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name = axes[axis];
    EXPECT_NEAR(value_of(row, "sensor.moved.displacement" + name), here[axis], 1e-18) << name;
    EXPECT_NEAR(value_of(row, "sensor.place.position" + name), at[axis] + here[axis], 1e-17);
    EXPECT_NEAR(value_of(row, "sensor.speed.velocity" + name), 1e3 * here[axis], 1e-14) << name;
    EXPECT_NEAR(value_of(row, "sensor.near.displacement" + name), there[axis], 1e-18) << name;
    EXPECT_GT(std::abs(there[axis] - here[axis]), 0.05 * std::abs(here[axis])) << name;
  }
}

TEST(Sensors, follow_the_body_and_no_element_that_hangs_on_no_bond) {
  Specimen specimen = row_of(4);
  // In a gap of the body, and nearer to the point than any of it.
  specimen.position.push_back({3 * hand_radius, 1.9 * hand_radius, 0});
  specimen.radius.push_back(hand_radius);
  auto setup = beam_setup();
  setup.sensors.push_back({"here", specimen.position.back(), Sensor::Quantity::displacement,
                           Sensor::Sampling::nearest});
  for (const bool touches : {false, true}) {
    SCOPED_TRACE(touches);
    if (touches) setup.get<ContactParameters>() = ContactParameters{};
    Simulation simulation(setup, specimen, true);
    for (std::size_t i = 0; i < 4; ++i) simulation.model().positions()[i][1] += 1e-6;
    // With contacts a loose element may be what is to be followed.
    EXPECT_NEAR(value_of(simulation.observe(), "sensor.here.displacement_y"), touches ? 0 : 1e-6,
                1e-15);
  }
}

TEST(Sensors, see_a_periodic_body_from_any_of_its_images) {
  auto setup = thermal_setup();
  constexpr double period = 16e-4;
  const auto add = [&](const char* name, double x, Sensor::Sampling sampling) {
    setup.sensors.push_back({name, {x, 3e-4, 3e-4}, Sensor::Quantity::temperature, sampling});
  };
  for (const double x : {0.05e-4, 0.9e-4, 15.2e-4}) {
    setup.sensors.clear();
    add("here", x, Sensor::Sampling::fit);
    add("there", x + period, Sensor::Sampling::fit);
    add("middle", x + period / 2, Sensor::Sampling::fit);
    add("near", x, Sensor::Sampling::nearest);
    add("far", x - period, Sensor::Sampling::nearest);
    Simulation simulation(setup, block({true, false, false}));
    Model& model = simulation.model();
    const auto field = [&](double at) { return 300 + 10 * std::cos(2 * M_PI * at / period); };
    for (std::size_t i = 0; i < model.elements(); ++i)
      model.data(columns::temperature)[i] = field(model.specimen().position[i].x);
    const HistoryRow row = simulation.observe();
    const double here = value_of(row, "sensor.here.temperature");
    EXPECT_NEAR(value_of(row, "sensor.there.temperature"), here, 1e-9);
    // Half a period on, the field is the same but for its sign: near an end as in the middle.
    EXPECT_NEAR(300 - value_of(row, "sensor.middle.temperature"), here - 300, 1e-9);
    EXPECT_NEAR(here, field(x), 2);
    EXPECT_EQ(value_of(row, "sensor.far.temperature"), value_of(row, "sensor.near.temperature"));
  }
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

}  // namespace solidem::gauge_test
