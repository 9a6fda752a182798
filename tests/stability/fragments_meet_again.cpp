// SPDX-License-Identifier: GPL-2.0-or-later
//
// Fragments that fly apart and meet again, also with a kilometre between them: neighbours are found
// in time and memory in proportion to the elements.
#include <gtest/gtest.h>
#include <omp.h>

#include <ctime>

#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::fragments_meet_again_test {

TEST(FragmentsMeetAgain, and_stick_or_rebound_with_momentum_and_energy) {
  auto setup = central_setup(usual<Piecewise>(), 1.3);
  setup.get<CentralForceParameters>()->dissipation = 0.05;
  std::vector<Vector> places = lattice({4, 4, 4});
  for (const Vector& place : lattice({4, 4, 4}, 2, 0, {8 * hand_radius, 0, 0}))
    places.push_back(place);
  Simulation simulation(setup, elements_at(places));
  const double whole = seen(simulation, "interactions");
  const auto blow = [&](double speed) {
    for (std::size_t i = 0; i < 128; ++i) launch(simulation, i, {i < 64 ? -speed : speed, 0, 0});
  };
  blow(400);
  simulation.advance(1000);
  // All that held the two together is gone, whatever happened in them.
  const auto distance_between = [&] {
    double left = -1, right = 1;
    for (std::size_t i = 0; i < 128; ++i) {
      const double x = place_of(simulation, i).x;
      if (i < 64)
        left = std::max(left, x);
      else
        right = std::min(right, x);
    }
    return right - left;
  };
  EXPECT_GT(distance_between(), 10 * hand_radius);
  EXPECT_LE(seen(simulation, "interactions"), whole - 16);
  EXPECT_LT(net_momentum(simulation, 100), 1e-12);
  const double apart = seen(simulation, "interactions");
  const double before = seen(simulation, "energy_balance");
  const double kinetic = seen(simulation, "kinetic_energy");
  blow(-100);
  const double changed = seen(simulation, "kinetic_energy") - kinetic;
  double most = apart, nearest = 1;
  for (int n = 0; n < 60; ++n) {
    simulation.advance(100);
    most = std::max(most, seen(simulation, "interactions"));
    nearest = std::min(nearest, distance_between());
  }
  EXPECT_LT(nearest, 2.6 * hand_radius);
  EXPECT_GE(most, apart + 16);
  EXPECT_LT(net_momentum(simulation, 100), 1e-12);
  const double balance = seen(simulation, "energy_balance") - before - changed;
  std::printf("  balance within %.1e of the energy of the impact\n",
              std::fabs(balance) / seen(simulation, "dissipated_energy"));
  EXPECT_LT(std::fabs(balance), 0.05 * seen(simulation, "dissipated_energy"));
}

/// Fragments of a lattice, each so far from the one before.
Specimen fragments(int pieces, int side, const Vector& apart) {
  std::vector<Vector> places;
  for (int k = 0; k < pieces; ++k)
    for (const Vector& place : lattice({side, side, side}, 2, 0.1, static_cast<double>(k) * apart))
      places.push_back(place);
  return elements_at(places);
}

/// The shortest of a few searches on one thread, s of the processor, whatever else it does.
double search_time(const Specimen& body) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  double best = 1e300;
  for (int n = 0; n < 5; ++n) {
    const std::clock_t start = std::clock();
    find_neighbours(body.domain, body.position, body.radius, 1.2, 1e-5);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  omp_set_num_threads(before);
  return best;
}

TEST(FragmentsMeetAgain, however_far_apart_they_are_found_as_fast) {
  // 8000 elements near each other, and in two and eight pieces a kilometre apart along all axes.
  const double near = search_time(fragments(2, 16, {33 * hand_radius, 0, 0}));
  const double two = search_time(fragments(2, 16, {1000, 0, 0}));
  const double diagonal = search_time(fragments(2, 16, {1000, -700, 400}));
  const double eight = search_time(fragments(8, 10, {1000, 1000, 1000}));
  std::printf("  near %.1f ms, two pieces %.1f and %.1f ms, eight pieces %.1f ms\n", 1e3 * near,
              1e3 * two, 1e3 * diagonal, 1e3 * eight);
  // All pairs of a piece would take a hundred times as long.
  EXPECT_LT(two, 5 * near);
  EXPECT_LT(diagonal, 5 * near);
  EXPECT_LT(eight, 8 * near);
}

TEST(FragmentsMeetAgain, however_far_apart_they_hold_together_and_take_no_more_memory) {
  const Specimen far = fragments(2, 8, {1000, 400, 0}), near = fragments(2, 8, {1, 0.4, 0});
  Simulation parted(central_setup(usual<Piecewise>(), 1.2), far);
  Simulation together(central_setup(usual<Piecewise>(), 1.2), near);
  shake(parted, 50);
  shake(together, 50);
  parted.advance(200);
  together.advance(200);
  EXPECT_GT(parted.find<CentralForces>()->searches(), 1u);
  EXPECT_LT(static_cast<double>(parted.model().bytes()),
            1.1 * static_cast<double>(together.model().bytes()));
  // The places of the far piece are known to 1e-13 m only.
  EXPECT_NEAR(seen(parted, "potential_energy"), seen(together, "potential_energy"),
              1e-3 * std::fabs(seen(together, "potential_energy")));
}

}  // namespace solidem::fragments_meet_again_test
