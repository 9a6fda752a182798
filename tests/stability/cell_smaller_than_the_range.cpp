// SPDX-License-Identifier: GPL-2.0-or-later
//
// A periodic cell that is smaller than the range of the forces, so that an element meets several
// images of each other one, moves as the same crystal in a large cell does.
#include <gtest/gtest.h>

#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::cell_smaller_than_the_range_test {

/// `copies` of a cell of 2 × 2 × 2 elements along each axis, of which each copy is alike.
Specimen cells(int copies) {
  const std::vector<Vector> one = lattice({2, 2, 2}, 2, 0.1);
  const double period = 4 * hand_radius;
  std::vector<Vector> places;
  for (int x = 0; x < copies; ++x)
    for (int y = 0; y < copies; ++y)
      for (int z = 0; z < copies; ++z)
        for (const Vector& place : one)
          places.push_back(place + period * Vector{double(x), double(y), double(z)});
  Specimen body = elements_at(places);
  body.domain.lower = {-hand_radius, -hand_radius, -hand_radius};
  body.domain.upper = body.domain.lower + copies * period * Vector{1, 1, 1};
  body.domain.periodic = {true, true, true};
  body.domain.volume = std::pow(copies * period, 3);
  return body;
}

class CellSmallerThanTheRange : public testing::TestWithParam<CentralEquilibrium> {};

TEST_P(CellSmallerThanTheRange, moves_as_a_large_cell_does) {
  // A range of 2.4 and 5 radii about a cell of 4.
  for (const double range : {1.2, 2.5}) {
    auto setup = central_setup(usual<Mie>(), range);
    setup.get<CentralForceParameters>()->equilibrium = GetParam();
    setup.get<CentralForceParameters>()->dissipation = 0.01;
    setup.run.time_step = 5e-9;
    Simulation small(setup, cells(1), true), large(setup, cells(4), true);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-50, 50);
    Vector velocity[8], sum{};
    for (Vector& v : velocity) sum += v = {uniform(random), uniform(random), uniform(random)};
    for (Vector& v : velocity) v -= (1.0 / 8) * sum;
    for (std::size_t i = 0; i < 8; ++i) launch(small, i, velocity[i]);
    for (std::size_t i = 0; i < 512; ++i) launch(large, i, velocity[i % 8]);
    small.advance(100);
    large.advance(100);
    double moved = 0, apart = 0;
    for (std::size_t i = 0; i < 512; ++i) {
      const Vector here = place_of(small, i % 8) - small.model().specimen().position[i % 8];
      const Vector there = place_of(large, i) - large.model().specimen().position[i];
      moved = std::max(moved, norm(here));
      apart = std::max(apart, norm(here - there));
    }
    EXPECT_GT(moved, 1e-3 * hand_radius);
    EXPECT_LT(apart, 1e-9 * moved) << range;
    EXPECT_NEAR(64 * seen(small, "kinetic_energy"), seen(large, "kinetic_energy"),
                1e-9 * seen(large, "kinetic_energy"));
    // Pairs of an element with its own images pull evenly and are not counted.
    if (range < 2) {
      EXPECT_NEAR(64 * seen(small, "interactions"), seen(large, "interactions"), 0.1);
      EXPECT_NEAR(64 * seen(small, "potential_energy"), seen(large, "potential_energy"),
                  1e-9 * std::fabs(seen(large, "potential_energy")));
    }
    EXPECT_LT(net_momentum(small), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Equilibria, CellSmallerThanTheRange,
                         testing::Values(CentralEquilibrium::initial, CentralEquilibrium::radii));

}  // namespace solidem::cell_smaller_than_the_range_test
