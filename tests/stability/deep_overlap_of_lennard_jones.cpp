// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elements that begin pressed into each other by 30 % and more, where the potential of Lennard and
// Jones is hundreds of times as stiff as at rest and then as steep as one likes: the law goes on
// with its tangent from the deepest overlap that the step allows for.
#include <gtest/gtest.h>

#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::deep_overlap_of_lennard_jones_test {

Setup pressed() {
  auto setup = central_setup(usual<LennardJones>(), 20);
  setup.get<CentralForceParameters>()->equilibrium = CentralEquilibrium::radii;
  setup.get<CentralForceParameters>()->bond_tolerance = 0.5;
  setup.get<CentralForceParameters>()->interpenetration = 0.3;
  return setup;
}

/// The largest error of the balance of energy, as a part of what was stored at the start.
double worst_balance(const Specimen& body, double ratio, double time) {
  auto setup = pressed();
  setup.run.time_step_ratio = ratio;
  Simulation simulation(setup, body);
  const double start = std::fabs(seen(simulation, "potential_energy"));
  double worst = 0;
  while (simulation.time() < time) {
    simulation.advance(1);
    worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")) / start);
  }
  EXPECT_LT(net_momentum(simulation), 1e-12);
  return worst;
}

TEST(DeepOverlapOfLennardJones, of_two_elements_keeps_energy_to_second_order) {
  for (const double overlap : {0.2, 0.3, 0.4, 0.6, 0.9, 0.999}) {
    const Specimen two = row_of(2, 2 * (1 - overlap));
    // The law has a kink where it goes on along its tangent; where in a step the path crosses it
    // scatters the error, so the order is that over a step eight times finer.
    const double coarse = worst_balance(two, 0.2, 5e-7), fine = worst_balance(two, 0.025, 5e-7);
    EXPECT_LT(coarse, 0.1) << overlap;
    EXPECT_GT(std::log2(coarse / fine) / 3, 1.9) << overlap;
    std::printf("  overlap %.3f: balance within %.1e and %.1e\n", overlap, coarse, fine);
  }
}

TEST(DeepOverlapOfLennardJones, of_a_lattice_stays_finite_and_keeps_energy) {
  for (const double overlap : {0.3, 0.5}) {
    const Specimen body = elements_at(lattice({3, 3, 3}, 2 * (1 - overlap), 0.1));
    const double error = worst_balance(body, 0.2, 5e-7);
    std::printf("  overlap %.1f: balance within %.1e\n", overlap, error);
    EXPECT_LT(worst_balance(body, 0.1, 5e-7), 0.35 * error);
  }
}

TEST(DeepOverlapOfLennardJones, is_told) {
  auto setup = pressed();
  Simulation simulation(setup, row_of(2, 2 * 0.6));
  simulation.advance(1);
  EXPECT_TRUE(simulation.find<CentralForces>()->has_exceeded());
  EXPECT_NEAR(seen(simulation, "largest_interpenetration"), 0.4, 1e-12);
  Simulation shallow(setup, row_of(2, 2 * 0.75));
  shallow.advance(1);
  EXPECT_FALSE(shallow.find<CentralForces>()->has_exceeded());
}

}  // namespace solidem::deep_overlap_of_lennard_jones_test
