// SPDX-License-Identifier: GPL-2.0-or-later
//
// Two blocks that meet at 1 km/s, more than half the speed of sound in them: momentum stays to the
// last bits and energy is balanced; where the step is too large, the run says so.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "support/central_forces.hpp"

namespace solidem::impact_of_two_blocks_test {

constexpr double speed = 500;  // of each block, m/s

Specimen two_blocks() {
  std::vector<Vector> places = lattice({5, 5, 5}, 2, 0.05);
  for (const Vector& place : lattice({5, 5, 5}, 2, 0.05, {13 * hand_radius, 0.3 * hand_radius, 0}))
    places.push_back(place);
  return elements_at(places);
}

Setup impact(const CentralLaw& law) {
  auto setup = central_setup(law, 1.3);
  setup.get<CentralForceParameters>()->interpenetration = 0.3;
  setup.all<InitialVelocity>() = {{between(-1, 10 * hand_radius), {speed, 0, 0}},
                                  {between(10 * hand_radius, 1), {-speed, 0, 0}}};
  return setup;
}

TEST(ImpactOfTwoBlocks, stays_finite_and_keeps_momentum_and_energy) {
  for (const CentralLaw& law : usual_laws()) {
    double last = 0;
    for (const double ratio : {0.3, 0.1}) {
      auto setup = impact(law);
      setup.run.time_step_ratio = ratio;
      Simulation simulation(setup, two_blocks());
      const double start = seen(simulation, "kinetic_energy");
      while (simulation.time() < 4e-6) {
        simulation.advance(10);
        ASSERT_NO_THROW(simulation.observe()) << name_of(law);
      }
      EXPECT_LT(net_momentum(simulation), 1e-13) << name_of(law);
      EXPECT_LT(seen(simulation, "kinetic_energy"), 0.9 * start) << name_of(law);
      last = std::fabs(seen(simulation, "energy_balance")) / start;
      std::printf("  %s, ratio %.1f: balance within %.1e, overlap to %.2f\n", name_of(law), ratio,
                  last, seen(simulation, "largest_interpenetration"));
    }
    EXPECT_LT(last, 0.02) << name_of(law);
  }
}

TEST(ImpactOfTwoBlocks, with_too_large_a_step_is_refused_or_reported) {
  auto setup = impact(usual<Mie>());
  setup.run.time_step = 3 * Simulation(setup, two_blocks()).time_step().limit;
  EXPECT_THROW(Simulation(setup, two_blocks()), InputError);
  // The limit holds for the deepest overlap; this is beyond that of the body at rest.
  setup.run.time_step = 9 * Simulation(impact(usual<Mie>()), two_blocks()).time_step().limit;
  Simulation simulation(setup, two_blocks(), true);
  try {
    for (int n = 0; n < 200; ++n) simulation.advance(256);
    FAIL() << "nothing was said";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("the run diverged"), std::string::npos)
        << error.what();
  }
}

}  // namespace solidem::impact_of_two_blocks_test
