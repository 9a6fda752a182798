// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elements that have lost bonds and keep too few are removed.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "effects/rupture.hpp"
#include "support/beams.hpp"

namespace solidem::removal_of_elements_test {

/// A row whose two halves fly apart, so that its bond in the middle breaks.
Setup flying_apart(int minimal_bonds) {
  auto setup = elastic_setup();
  setup.get<RuptureParameters>() = breaking_at_strain(0.01, minimal_bonds);
  for (const bool high : {false, true}) {
    InitialVelocity initial;
    initial.region.kind = Region::Kind::box;
    initial.region.lower = {high ? 0.9e-3 : -1.0, -1, -1};
    initial.region.upper = {high ? 1.0 : 0.9e-3, 1, 1};
    initial.velocity = {high ? 200.0 : -200.0, 0, 0};
    setup.all<InitialVelocity>().push_back(initial);
  }
  return setup;
}

TEST(RemovalOfElements, spares_those_that_keep_enough) {
  Simulation simulation(flying_apart(1), row_of(10));
  simulation.advance(60);
  EXPECT_GT(simulation.find<Rupture>()->broken().size(), 0u);
  for (std::int32_t e = 0; e < 10; ++e)
    EXPECT_EQ(simulation.find<Rupture>()->is_removed(e),
              simulation.model().slots().coordination(e) == 0);
}

TEST(RemovalOfElements, goes_on_to_neighbours_that_it_leaves_with_too_few) {
  // In a row every element inside has two bonds: one broken bond unravels all of it.
  Simulation simulation(flying_apart(2), row_of(10));
  simulation.advance(60);
  EXPECT_EQ(simulation.find<Rupture>()->removed(), 10u);
  EXPECT_EQ(simulation.find<Rupture>()->broken().size(), 9u);
  std::vector<Vector> places;
  const double* pose = simulation.model().data(columns::pose);
  for (std::size_t i = 0; i < 10; ++i) places.push_back({pose[8 * i], pose[8 * i + 1], 0});
  simulation.advance(50);
  pose = simulation.model().data(columns::pose);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(pose[8 * i], places[i].x) << "removed, at rest";
}

TEST(RemovalOfElements, loses_no_energy_unseen) {
  for (const int minimal_bonds : {1, 2}) {
    // A bond acts through the step in which it breaks: what that leaves open shrinks with the step.
    const auto left_open = [&](int divisor) {
      auto setup = flying_apart(minimal_bonds);
      setup.run.time_step_ratio = 0.3 / divisor;
      Simulation simulation(setup, row_of(10));
      const double at_first = value_of(simulation.observe(), "kinetic_energy");
      simulation.advance(60 * divisor);
      const HistoryRow row = simulation.observe();
      EXPECT_GT(value_of(row, "fracture_energy"), 0);
      EXPECT_EQ(value_of(row, "removed_elements"),
                static_cast<double>(simulation.find<Rupture>()->removed()));
      return std::fabs(value_of(row, "energy_balance")) / at_first;
    };
    EXPECT_LT(left_open(1), 0.05) << minimal_bonds;
    EXPECT_LT(left_open(8), 0.2 * 0.05) << minimal_bonds;
  }
}

TEST(RemovalOfElements, never_happens_to_those_that_lost_nothing) {
  // The ends of the row have one bond from the beginning.
  auto setup = flying_apart(2);
  setup.get<RuptureParameters>() = breaking_at_strain(0.5, 2);
  Simulation simulation(setup, row_of(10));
  simulation.advance(60);
  EXPECT_EQ(simulation.find<Rupture>()->removed(), 0u);
}

}  // namespace solidem::removal_of_elements_test
