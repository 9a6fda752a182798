// SPDX-License-Identifier: GPL-2.0-or-later
//
// Two materials whose conductivities differ by 1e6: the steady state between two walls is the exact
// one of two layers in series, nothing overshoots on the way, and the balance closes.
#include <gtest/gtest.h>

#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/heat.hpp"

namespace solidem::contrast_of_conductivities_test {

class Contrast : public testing::TestWithParam<HeatIntegratorName> {};

TEST_P(Contrast, of_a_million_reaches_the_exact_steady_state) {
  auto setup = heat_setup(HeatLaw::voronoi, GetParam());
  Region left, right;
  left.kind = right.kind = Region::Kind::box;
  left.upper.x = right.lower.x = 1e-3;  // between the fifth and the sixth layer
  setup.materials = {material_of(2790, 880, 134, left), material_of(2790, 880, 134e-6, right)};
  setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 798), held_wall("x_high", 298)};
  setup.get<ConductionParameters>()->tolerance = 0.01;
  setup.run.steps.reset();
  setup.run.duration = 2e5;  // 11 times the slow layer's L²/α
  Simulation simulation(setup, crystal("simple_cubic", {10, 3, 3}));
  double lowest = 298, highest = 798;
  while (simulation.step() < simulation.steps_to_run()) {
    simulation.advance(1);
    const auto [low, high] = extremes(simulation);
    lowest = std::min(lowest, low), highest = std::max(highest, high);
  }
  const double slow = 1e-3 / 134e-6, fast = 1e-3 / 134;
  const double flux = 500 / (slow + fast);
  double error = 0;
  const Model& model = simulation.model();
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const double x = model.specimen().position[i].x;
    const double exact = x < 1e-3 ? 798 - flux * x / 134 : 298 + flux * (2e-3 - x) / 134e-6;
    // Between the layers the pair conducts by the harmonic mean, half a way in each.
    error = std::max(error, std::abs(model.data(columns::temperature)[i] - exact));
  }
  std::printf("  %s: %.1e K from the steady state, %.1e K outside of the range, balance %.1e\n",
              label(GetParam()), error, std::max(298 - lowest, highest - 798),
              relative_imbalance(simulation));
  EXPECT_LT(error, 0.01);
  EXPECT_LT(std::max(298 - lowest, highest - 798), 0.01);
  EXPECT_LT(relative_imbalance(simulation), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Contrast,
                         testing::Values(HeatIntegratorName::implicit,
                                         HeatIntegratorName::automatic));

}  // namespace solidem::contrast_of_conductivities_test
