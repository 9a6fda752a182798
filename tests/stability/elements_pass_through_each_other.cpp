// SPDX-License-Identifier: GPL-2.0-or-later
//
// The shifted law is finite however near two elements come: they can be shot through each other,
// off the axis and head-on, where their distance goes through zero.
#include <gtest/gtest.h>

#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::elements_pass_through_each_other_test {

/// Two elements that fly at each other, `beside` radii off the axis.
struct Passage {
  double worst = 0;    ///< error of the balance over the kinetic energy at the start
  double nearest = 1;  ///< distance over that of equilibrium
  bool passed = false;
};

Passage shoot(double beside, double step, double speed = 6000) {
  ShiftedLennardJones law{25, 1.3};
  auto setup = central_setup(law, 3);
  setup.get<CentralForceParameters>()->equilibrium = CentralEquilibrium::radii;
  setup.get<CentralForceParameters>()->interpenetration = 0.999;
  setup.run.time_step = step;
  const double r = hand_radius;
  Simulation simulation(setup, elements_at({{-2.5 * r, 0, 0}, {2.5 * r, beside * r, 0}}));
  launch(simulation, 0, {speed, 0, 0});
  launch(simulation, 1, {-speed, 0, 0});
  const double start = seen(simulation, "kinetic_energy");
  Passage passage;
  while (simulation.time() < 5 * r / speed) {
    simulation.advance(1);
    const double distance = norm(place_of(simulation, 1) - place_of(simulation, 0));
    passage.nearest = std::min(passage.nearest, distance / (2 * r));
    passage.worst = std::max(passage.worst, std::fabs(seen(simulation, "energy_balance")) / start);
    EXPECT_LT(net_momentum(simulation), 1e-12);
  }
  passage.passed = place_of(simulation, 0).x > place_of(simulation, 1).x + r;
  return passage;
}

TEST(ElementsPassThroughEachOther, off_the_axis_with_energy_to_second_order) {
  double last = 0;
  for (const double step : {2e-10, 1e-10, 5e-11}) {
    const Passage passage = shoot(0.5, step);
    EXPECT_TRUE(passage.passed);
    EXPECT_LT(passage.nearest, 0.6);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / passage.worst), 2, 0.2);
    }
    last = passage.worst;
  }
}

TEST(ElementsPassThroughEachOther, head_on_with_energy_to_the_order_of_the_step) {
  // At distance zero the force turns about at once: what a step may lose is that force over its
  // path.
  const double speed = 8000;
  const double force = bare_force(ShiftedLennardJones{25, 1.3}, 1e-12, 2 * hand_radius).force;
  const double mass = 2790 * 8 * std::pow(hand_radius, 3);
  for (const double step : {4e-10, 1e-10, 2.5e-11}) {
    const Passage passage = shoot(0, step, speed);
    EXPECT_TRUE(passage.passed);
    EXPECT_LT(passage.nearest, speed * 2 * step / (2 * hand_radius));
    std::printf("  step %.1e s: balance within %.1e\n", step, passage.worst);
    EXPECT_LT(passage.worst, force * 2 * speed * step / (mass * speed * speed));
  }
}

TEST(ElementsPassThroughEachOther, not_when_they_are_too_slow) {
  const Passage passage = shoot(0, 2e-10, 100);
  EXPECT_FALSE(passage.passed);
  EXPECT_GT(passage.nearest, 0.5);
}

}  // namespace solidem::elements_pass_through_each_other_test
