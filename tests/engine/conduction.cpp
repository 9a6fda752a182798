// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "effects/heat_load_parameters.hpp"
#include "support/specimens.hpp"

namespace solidem::conduction_test {

TEST(Conduction, on_a_simple_cubic_lattice_is_central_finite_differences) {
  constexpr int nx = 8, ny = 6, nz = 5;
  auto setup = thermal_setup();
  setup.run.time_step_ratio = 0.5;
  Simulation simulation(setup, crystal("simple_cubic", {nx, ny, nz}, {true, true, true}));
  const Specimen& specimen = simulation.model().specimen();
  const double h = 2e-4, dt = simulation.time_step().value;
  const double diffusivity = 134 / (2790.0 * 880.0);
  const auto node = [&](std::size_t i) {
    const Vector& p = specimen.position[i];
    return std::array<int, 3>{static_cast<int>(p.x / h), static_cast<int>(p.y / h),
                              static_cast<int>(p.z / h)};
  };
  const auto at = [&](int x, int y, int z) {
    return static_cast<std::size_t>(((x + nx) % nx * ny + (y + ny) % ny) * nz + (z + nz) % nz);
  };
  std::vector<double> grid(nx * ny * nz);
  double* temperature = simulation.model().data(columns::temperature);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const auto [x, y, z] = node(i);
    temperature[i] = grid[at(x, y, z)] = 500 + 200 * std::sin(5.0 * x + 3.0 * y * y + 7.0 * z);
  }
  for (int step = 1; step <= 20; ++step) {
    std::vector<double> next = grid;
    for (int x = 0; x < nx; ++x)
      for (int y = 0; y < ny; ++y)
        for (int z = 0; z < nz; ++z)
          next[at(x, y, z)] +=
              dt * diffusivity / (h * h) *
              (grid[at(x + 1, y, z)] + grid[at(x - 1, y, z)] + grid[at(x, y + 1, z)] +
               grid[at(x, y - 1, z)] + grid[at(x, y, z + 1)] + grid[at(x, y, z - 1)] -
               6 * grid[at(x, y, z)]);
    simulation.advance(1);
    temperature = simulation.model().data(columns::temperature);
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const auto [x, y, z] = node(i);
      ASSERT_NEAR(temperature[i] / next[at(x, y, z)], 1, 1e-14) << "step " << step;
      grid[at(x, y, z)] = temperature[i];  // each step is compared by itself
    }
  }
}

TEST(Conduction, keeps_the_heat_of_an_adiabatic_body) {
  Simulation simulation(thermal_setup(), jittered("bcc", {5, 4, 3}));
  double* temperature = simulation.model().data(columns::temperature);
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    temperature[i] += 500 * static_cast<double>(i % 3);
  const double before = value_of(simulation.observe(), "thermal_energy");
  simulation.advance(1000);
  const double after = value_of(simulation.observe(), "thermal_energy");
  EXPECT_NEAR(after / before, 1, 1e-12);
}

TEST(Conduction, heat_through_imposed_temperatures_is_what_the_body_gains) {
  auto setup = thermal_setup();
  setup.all<ImposedTemperatureParameters>().push_back(
      {"hot", face(0, true), {{0, 1e-3}, {400, 800}, 20, 300, 0}});
  setup.all<ImposedTemperatureParameters>().push_back(
      {"cold", face(0, false), TimeFunction::constant(298)});
  Simulation simulation(setup, jittered("bcc", {6, 3, 3}));
  simulation.advance(500);
  const HistoryRow row = simulation.observe();
  EXPECT_GT(value_of(row, "heat_input"), 0);
  EXPECT_NEAR(value_of(row, "heat_balance") / value_of(row, "heat_input"), 0, 1e-12);
}

TEST(Conduction, steady_profile_between_two_ends_is_linear_on_a_lattice) {
  auto setup = thermal_setup();
  setup.all<ImposedTemperatureParameters>().push_back(
      {"hot", face(0, true, 0.6), TimeFunction::constant(400)});
  setup.all<ImposedTemperatureParameters>().push_back(
      {"cold", face(0, false, 0.6), TimeFunction::constant(300)});
  // Periodic across: every inner element has six neighbours.
  Simulation simulation(setup, crystal("simple_cubic", {11, 3, 3}, {false, true, true}));
  simulation.advance(4000);
  const Model& model = simulation.model();
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const double x = (model.specimen().position[i].x - 1e-4) / 20e-4;
    // The ends have five neighbours, so that their contacts conduct better by a common factor.
    const double contact = std::sqrt(7.19615242270663 / 4);
    const double fraction = x <= 0   ? 0
                            : x >= 1 ? 1
                                     : (1 / contact + x * 10 - 1) / (2 / contact + 8);
    EXPECT_NEAR(model.data(columns::temperature)[i], 300 + 100 * fraction, 1e-6) << x;
  }
}

}  // namespace solidem::conduction_test
