// SPDX-License-Identifier: GPL-2.0-or-later
//
// A step of 500 K on a packing of elements of 1 µm: no temperature leaves the range between the
// two, by any integrator, and the heat balance closes.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/heat.hpp"

namespace solidem::sudden_heating_of_small_elements_test {

Specimen small_packing() {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {30e-6, 10e-6, 10e-6};
  recipe.mean_radius = 1e-6;
  return make_specimen(recipe);
}

class SuddenHeating : public testing::TestWithParam<std::tuple<HeatLaw, HeatIntegratorName>> {};

TEST_P(SuddenHeating, of_small_elements_stays_between_the_two_temperatures) {
  const auto [law, integrator] = GetParam();
  auto setup = heat_setup(law, integrator);
  setup.all<ImposedTemperatureParameters>().push_back(held_wall("x_low", 798));
  const bool is_explicit = integrator == HeatIntegratorName::explicit_euler;
  if (!is_explicit) setup.get<ConductionParameters>()->tolerance = 1;
  // α t / L² up to 0.3, where the far end has warmed by half.
  setup.run.steps.reset();
  setup.run.duration = 0.3 * 30e-6 * 30e-6 / (134 / (2790.0 * 880.0));
  if (is_explicit) setup.run.time_step_ratio = 0.95;
  Simulation simulation(setup, small_packing());
  double lowest = 298, highest = 298;
  while (simulation.step() < simulation.steps_to_run()) {
    simulation.advance(1);
    const auto [low, high] = extremes(simulation);
    lowest = std::min(lowest, low), highest = std::max(highest, high);
  }
  const double margin = std::max(298 - lowest, highest - 798);
  std::printf("  %s, %s: %.2g K outside of 298..798 K, heat balance %.1e\n", name_of(law),
              label(integrator), std::max(margin, 0.0), relative_imbalance(simulation));
  // Explicit Euler below its row-sum bound has a maximum principle; the others promise their error.
  EXPECT_LE(margin, is_explicit ? 1e-9 : 1.0);
  EXPECT_GT(highest, 700);
  EXPECT_LT(relative_imbalance(simulation), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, SuddenHeating,
    testing::Combine(testing::Values(HeatLaw::platonic, HeatLaw::platonic_calibrated,
                                     HeatLaw::voronoi),
                     testing::Values(HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2,
                                     HeatIntegratorName::implicit, HeatIntegratorName::automatic)));

}  // namespace solidem::sudden_heating_of_small_elements_test
