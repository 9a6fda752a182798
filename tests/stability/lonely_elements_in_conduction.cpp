// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elements with one neighbour and with none: the first follow their only neighbour, the second keep
// their temperature, neither makes a number infinite or the balance open, and the run says how many
// there are.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/heat.hpp"

namespace solidem::lonely_elements_in_conduction_test {

/// A chain that ends in an element with one neighbour, and one far off with none.
Specimen chain_and_hermit() {
  Specimen specimen = crystal("simple_cubic", {8, 1, 1});
  specimen.position.back().x += 1e-3;  // the last of the chain
  specimen.domain.upper.x += 1e-3;
  make_bonds(specimen, 0);
  return specimen;
}

class LonelyElements : public testing::TestWithParam<std::tuple<HeatLaw, HeatIntegratorName>> {};

TEST_P(LonelyElements, follow_their_neighbour_or_stay) {
  const auto [law, integrator] = GetParam();
  auto setup = heat_setup(law, integrator);
  setup.get<ConductionParameters>()->area_factor =
      law == HeatLaw::platonic_calibrated ? std::optional<double>(0.8) : std::nullopt;
  setup.all<ImposedTemperatureParameters>().push_back(
      {"hot", face(0, false, 0.6), TimeFunction::constant(798)});
  const bool is_explicit = integrator == HeatIntegratorName::explicit_euler;
  if (!is_explicit) setup.get<ConductionParameters>()->tolerance = 1e-3;
  setup.run.steps.reset();
  setup.run.duration = 1.0;
  if (is_explicit) setup.run.time_step_ratio = 1;
  Simulation simulation(setup, chain_and_hermit());
  EXPECT_EQ(simulation.unbonded(), 1u);
  simulation.advance(simulation.steps_to_run());
  const Model& model = simulation.model();
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const bool hermit = model.specimen().position[i].x > 2e-3;
    EXPECT_NEAR(model.data(columns::temperature)[i], hermit ? 298 : 798, hermit ? 0 : 0.01);
  }
  std::printf("  %s, %s: one element alone at 298 K, the others within %.1e K of 798 K\n",
              name_of(law), label(integrator), 798 - model.data(columns::temperature)[6]);
  EXPECT_LT(relative_imbalance(simulation), 1e-12);
}

TEST(LonelyElements, take_no_heat_from_a_source_and_are_no_sensors) {
  auto setup = heat_setup(HeatLaw::platonic, HeatIntegratorName::explicit_euler);
  setup.all<HeatSourceParameters>().push_back(ball_source(1, {}, 1e11));
  const Specimen body = chain_and_hermit();
  setup.sensors.push_back({"hermit", body.position.back()});
  Simulation simulation(setup, body);
  simulation.advance(1000);
  EXPECT_EQ(simulation.model().data(columns::temperature)[7], 298);
  EXPECT_GT(value_of(simulation.observe(), "sensor.hermit.temperature"), 299);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, LonelyElements,
    testing::Combine(testing::Values(HeatLaw::platonic, HeatLaw::platonic_calibrated),
                     testing::Values(HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2,
                                     HeatIntegratorName::implicit, HeatIntegratorName::automatic)));

}  // namespace solidem::lonely_elements_in_conduction_test
