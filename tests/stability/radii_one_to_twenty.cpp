// SPDX-License-Identifier: GPL-2.0-or-later
//
// Large elements among small ones of a twentieth of their radius: the step follows the small ones,
// the range the large ones.
#include <gtest/gtest.h>

#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::radii_one_to_twenty_test {

/// Two large elements that touch, and small ones on a sphere about each, just touching it.
Specimen large_and_small() {
  const double large = 20 * hand_radius, small = hand_radius;
  Specimen body = elements_at({{0, 0, 0}, {2 * large, 0, 0}});
  body.radius = {large, large};
  for (int k = 0; k < 150; ++k) {
    // Spread evenly by the golden angle.
    const double z = 1 - 2 * (k + 0.5) / 150, turn = 2.399963229728653 * k;
    const double across = std::sqrt(1 - z * z);
    const Vector direction{z, across * std::cos(turn), across * std::sin(turn)};
    for (const double x : {0.0, 2 * large}) {
      const Vector place = Vector{x, 0, 0} + (large + small) * direction;
      const double other = x > 0 ? norm(place) : norm(place - Vector{2 * large, 0, 0});
      if (other < large + small) continue;
      body.position.push_back(place);
      body.radius.push_back(small);
    }
  }
  body.domain.lower = {-25 * small, -25 * small, -25 * small};
  body.domain.upper = {65 * small, 25 * small, 25 * small};
  body.domain.volume = sphere_volume(body);
  return body;
}

TEST(RadiiOneToTwenty, run_with_energy_to_second_order_and_momentum) {
  double last = 0;
  for (const double ratio : {0.2, 0.1}) {
    auto setup = fixed_setup(usual<Mie>(), 3);
    setup.get<CentralForceParameters>()->bond_tolerance = 0.1;
    setup.run.time_step_ratio = ratio;
    Simulation simulation(setup, large_and_small());
    shake(simulation, 2);
    double worst = 0;
    while (simulation.time() < 5e-5) {
      simulation.advance(5);
      worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
    }
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / worst), 2, 0.4);
    }
    last = worst;
  }
}

TEST(RadiiOneToTwenty, find_all_neighbours_while_they_move) {
  auto setup = central_setup(usual<Piecewise>(), 1.2);
  setup.run.time_step_ratio = 0.2;
  Simulation simulation(setup, large_and_small());
  shake(simulation, 100);
  for (int n = 0; n < 20; ++n) {
    simulation.advance(50);
    const Specimen& body = simulation.model().specimen();
    double pairs = 0;
    for (std::size_t i = 0; i < body.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (norm(place_of(simulation, i) - place_of(simulation, j)) <
            1.2 * (body.radius[i] + body.radius[j]))
          ++pairs;
    EXPECT_EQ(seen(simulation, "interactions"), pairs);
  }
  EXPECT_GT(simulation.find<CentralForces>()->searches(), 5u);
}

TEST(RadiiOneToTwenty, have_the_stable_step_of_the_smallest) {
  auto setup = central_setup(usual<Piecewise>(), 1.05);
  const Simulation simulation(setup, large_and_small());
  const double smallest = 1 / simulation.model().data(columns::inverse_mass)[5];
  EXPECT_NEAR(simulation.time_step().bound, std::sqrt(smallest / 1.5e6), 1e-9 * 1e-6);
}

}  // namespace solidem::radii_one_to_twenty_test
