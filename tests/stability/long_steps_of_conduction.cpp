// SPDX-License-Identifier: GPL-2.0-or-later
//
// RKL2 and the implicit method in steps of 100 times the explicit limit, without a tolerance that
// would shorten them: they stay in the range of the temperatures, end where the explicit method
// ends and keep the balance.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/heat.hpp"

namespace solidem::long_steps_of_conduction_test {

class LongSteps : public testing::TestWithParam<std::tuple<HeatLaw, HeatIntegratorName>> {};

TEST_P(LongSteps, of_a_hundred_explicit_limits_hold) {
  const auto [law, integrator] = GetParam();
  const Specimen body = jittered("bcc", {40, 4, 4});
  auto setup = heat_setup(law, HeatIntegratorName::explicit_euler);
  setup.all<ImposedTemperatureParameters>().push_back(held_wall("x_low", 798));
  setup.run.time_step_ratio = 1;
  Simulation reference(setup, body);
  const double limit = reference.time_step().limit;

  setup.get<ConductionParameters>()->integrator = integrator;
  setup.run.time_step_ratio.reset();
  setup.run.time_step = 100 * limit;
  Simulation simulation(setup, body);
  double worst = 0;
  for (int n = 0; n < 40; ++n) {
    simulation.advance(1);
    const auto [low, high] = extremes(simulation);
    worst = std::max({worst, 298 - low, high - 798});
  }
  while (reference.time() < simulation.time()) reference.advance(1);
  double difference = 0;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    difference = std::max(difference, std::abs(simulation.model().data(columns::temperature)[i] -
                                               reference.model().data(columns::temperature)[i]));
  std::printf(
      "  %s, %s: %.2g K outside of the range, %.2g K from explicit at the end, balance %.1e\n",
      name_of(law), label(integrator), worst, difference, relative_imbalance(simulation));
  EXPECT_LT(worst, 5);
  EXPECT_LT(difference, 1);
  EXPECT_LT(relative_imbalance(simulation), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Laws, LongSteps,
                         testing::Combine(testing::Values(HeatLaw::platonic, HeatLaw::voronoi),
                                          testing::Values(HeatIntegratorName::rkl2,
                                                          HeatIntegratorName::implicit)));

}  // namespace solidem::long_steps_of_conduction_test
