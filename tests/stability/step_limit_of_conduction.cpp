// SPDX-License-Identifier: GPL-2.0-or-later
//
// The explicit limit that solidem tells against the true one, found by bisection on runs: below .97
// of the estimate they stay bounded, above 1.03 they diverge.
#include <gtest/gtest.h>

#include "effects/heat_load_parameters.hpp"
#include "support/heat.hpp"

namespace solidem::step_limit_of_conduction_test {

class StepLimit : public testing::TestWithParam<HeatLaw> {};

/// Whether a rough temperature field grows at a step.
bool grows(Setup setup, const Specimen& body, double time_step) {
  setup.run.time_step = time_step;
  Simulation simulation(setup, body, true);
  double* temperature = simulation.model().data(columns::temperature);
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    temperature[i] = 298 + (i * 2654435761u >> 7 & 1 ? 1 : -1);
  for (int n = 0; n < 4000; ++n) {
    simulation.advance(1);
    if (n % 100 == 0 && extremes(simulation).second - extremes(simulation).first > 100) return true;
  }
  return extremes(simulation).second - extremes(simulation).first > 2;
}

TEST_P(StepLimit, is_met_by_the_estimate) {
  auto setup = heat_setup(GetParam(), HeatIntegratorName::explicit_euler);
  setup.all<ImposedTemperatureParameters>().push_back(held_wall("x_low", 298));
  setup.all<ConvectionParameters>().push_back(
      {"air", "x_high", TimeFunction::constant(1e6), TimeFunction::constant(298)});
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {3e-3, 1e-3, 1e-3};
  recipe.elements = 400;
  const Specimen body = make_specimen(recipe);
  const double estimate = Simulation(setup, body).time_step().limit;
  double low = 0.5 * estimate, high = 2 * estimate;
  ASSERT_FALSE(grows(setup, body, low));
  ASSERT_TRUE(grows(setup, body, high));
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (grows(setup, body, middle) ? high : low) = middle;
  }
  std::printf("  %s: estimate / true limit = %.3f\n", name_of(GetParam()), estimate / low);
  EXPECT_NEAR(estimate / low, 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Laws, StepLimit,
                         testing::Values(HeatLaw::platonic, HeatLaw::platonic_calibrated,
                                         HeatLaw::voronoi));

}  // namespace solidem::step_limit_of_conduction_test
