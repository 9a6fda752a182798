// SPDX-License-Identifier: GPL-2.0-or-later
//
// 1e11 W/m³, as of a welding tool: some 40000 K a second. What comes in is power × time, and it
// stays positive and finite also where nothing but conduction holds it back.
#include <gtest/gtest.h>

#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/heat.hpp"

namespace solidem::strong_heat_source_test {

class StrongSource : public testing::TestWithParam<HeatIntegratorName> {};

TEST_P(StrongSource, heats_by_its_power) {
  auto setup = heat_setup(HeatLaw::voronoi, GetParam());
  const Vector centre{1e-3, 1e-3, 1e-3};
  setup.all<HeatSourceParameters>().push_back(ball_source(4e-4, centre, 1e11));
  if (GetParam() != HeatIntegratorName::explicit_euler)
    setup.get<ConductionParameters>()->tolerance = 0.1;
  setup.run.steps.reset();
  setup.run.duration = 0.02;
  if (GetParam() == HeatIntegratorName::explicit_euler) setup.run.time_step_ratio = 0.95;
  Simulation simulation(setup, jittered("simple_cubic", {10, 10, 10}));
  double lowest = 298;
  while (simulation.step() < simulation.steps_to_run()) {
    simulation.advance(1);
    lowest = std::min(lowest, extremes(simulation).first);
  }
  const HistoryRow row = simulation.observe();
  const double heat = 1e11 * 4.0 / 3.0 * 3.14159265358979 * std::pow(4e-4, 3) * simulation.time();
  std::printf("  %s: heat %.4f of power x volume x time, balance %.1e, %.2g K below the start\n",
              label(GetParam()), value_of(row, "heat_input") / heat, relative_imbalance(simulation),
              298 - lowest);
  // The shape is shared out over some 34 elements: its volume is met to a few per cent.
  EXPECT_NEAR(value_of(row, "heat_input") / heat, 1, 0.03);
  EXPECT_LT(relative_imbalance(simulation), 1e-12);
  EXPECT_GT(lowest, 298 - (GetParam() == HeatIntegratorName::explicit_euler ? 1e-9 : 0.1));
}

TEST(StrongSource, of_a_given_power_brings_in_exactly_that) {
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::explicit_euler);
  auto source = ball_source(4e-4, {}, 25);
  source.is_density = false;
  source.position[0] = {{0, 1}, {2e-4, 0.2}};  // on its way through the body
  source.position[1] = source.position[2] = TimeFunction::constant(1e-3);
  setup.all<HeatSourceParameters>().push_back(source);
  Simulation simulation(setup, jittered("simple_cubic", {10, 10, 10}));
  simulation.advance(200);
  EXPECT_NEAR(value_of(simulation.observe(), "heat_input") / (25 * simulation.time()), 1, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Integrators, StrongSource,
                         testing::Values(HeatIntegratorName::explicit_euler,
                                         HeatIntegratorName::rkl2, HeatIntegratorName::implicit,
                                         HeatIntegratorName::automatic));

}  // namespace solidem::strong_heat_source_test
