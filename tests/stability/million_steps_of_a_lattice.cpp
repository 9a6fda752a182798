// SPDX-License-Identifier: GPL-2.0-or-later
//
// A small lattice that vibrates through a million steps: the error of the energy stays within what
// the first steps show, and has no trend.
#include <gtest/gtest.h>

#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::million_steps_of_a_lattice_test {

TEST(MillionStepsOfALattice, lose_and_gain_no_energy) {
  auto setup = fixed_setup(usual<Mie>(), 5);
  setup.get<CentralForceParameters>()->bond_tolerance = 0.1;
  Simulation simulation(setup, elements_at(lattice({2, 2, 2}, 2, 0.05)));
  shake(simulation, 20);
  simulation.advance(1);
  const double energy = seen(simulation, "kinetic_energy");
  constexpr int parts = 1000;
  double mean[2] = {0, 0}, worst[2] = {0, 0};
  double slope = 0, squares = 0;
  std::vector<double> balance;
  for (int n = 0; n < parts; ++n) {
    simulation.advance(1000);
    const double error = seen(simulation, "energy_balance") / energy;
    balance.push_back(error);
    mean[n < parts / 2 ? 0 : 1] += error / (parts / 2);
    worst[n < parts / 2 ? 0 : 1] = std::max(worst[n < parts / 2 ? 0 : 1], std::fabs(error));
  }
  for (int n = 0; n < parts; ++n) {
    const double time = (n + 0.5) / parts - 0.5;
    slope += 12 * time * balance[static_cast<std::size_t>(n)] / parts;
    squares += std::pow(balance[static_cast<std::size_t>(n)] - 0.5 * (mean[0] + mean[1]), 2);
  }
  // A slope is known to this, were the errors independent of each other.
  const double scatter = std::sqrt(12 * squares) / parts;
  std::printf("  worst %.1e and %.1e, slope %.1e +- %.1e\n", worst[0], worst[1], slope, scatter);
  EXPECT_LT(std::fabs(slope), 5 * scatter);
  EXPECT_LT(worst[1], 1.5 * worst[0]);
  EXPECT_LT(worst[0], 0.02);
}

}  // namespace solidem::million_steps_of_a_lattice_test
