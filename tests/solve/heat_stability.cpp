// SPDX-License-Identifier: GPL-2.0-or-later
//
// Far beyond the explicit limit nothing may grow, and temperatures should stay between those given.
#include <gtest/gtest.h>

#include "heat_network.hpp"

namespace solidem::heat_stability_test {

using Limits = double;  // step over the explicit limit

class HeatStability : public testing::TestWithParam<std::tuple<HeatIntegration, Limits>> {};

TEST_P(HeatStability, step_of_temperature_stays_between_its_bounds) {
  const auto [choice, limits] = GetParam();
  HeatNetwork network = rod(100, true);
  network.imposed_temperature = [](double) { return 500.0; };
  std::vector<double> t(100, 0.0), heat(2, 0.0);
  const ExactNetwork exact(network, t, 0, {}, {}, {500, 0});
  const double step = limits * network.stable_step(0, t.data());
  auto integrator = make_heat_integrator(choice, {});
  double below = 0, above = 0, error = 0, first_error = 0;
  for (int k = 1; k <= 40; ++k) {
    integrator->advance(network, (k - 1) * step, step, t.data(), heat.data());
    for (const double value : t) {
      below = std::max(below, -value);
      above = std::max(above, value - 500);
    }
    error = largest_difference(t, exact(k * step));
    if (k == 1) first_error = error;
  }
  std::printf(
      "%g limits: %.1e K below the bounds, %.1e K above; error %.2e K at first, then %.2e\n",
      limits, below, above, first_error, error);
  EXPECT_LT(error, std::max(first_error, 1e-6));
  EXPECT_LT(std::max(below, above), 1.0);  // 0.2 % of the jump
}

TEST_P(HeatStability, rough_temperatures_do_not_grow) {
  const auto [choice, limits] = GetParam();
  HeatNetwork network = rod(100, false);
  std::vector<double> t, heat(2, 0.0);
  for (int i = 0; i < 100; ++i) t.push_back(i % 2 == 0 ? 1.0 : -1.0);
  const double step = limits * network.stable_step(0, t.data());
  auto integrator = make_heat_integrator(choice, {});
  double last = 1;
  for (int k = 0; k < 20; ++k) {
    integrator->advance(network, k * step, step, t.data(), heat.data());
    const double size = largest_difference(t, std::vector<double>(100, 0.0));
    EXPECT_LT(size, std::max(last, 1e-9));
    last = size;
  }
  std::printf("%g limits: alternating temperatures shrink to %.1e\n", limits, last);
  EXPECT_LT(last, 1e-2);
}

TEST_P(HeatStability, body_with_a_contrast_of_a_million_does_not_grow) {
  const auto [choice, limits] = GetParam();
  HeatNetwork network = uneven_cube(6);
  for (std::size_t k = 0; k < network.links.size(); k += 3) network.links[k].conductance *= 1e6;
  network.imposed_temperature = [](double) { return 100.0; };
  std::vector<double> t(network.elements(), 0.0), heat(2, 0.0);
  const double step = limits * network.stable_step(0, t.data());
  auto integrator = make_heat_integrator(choice, {});
  double beyond = 0;
  for (int k = 0; k < 20; ++k) {
    integrator->advance(network, k * step, step, t.data(), heat.data());
    for (const double value : t) beyond = std::max({beyond, -value, value - 100});
  }
  std::printf("%g limits: %.1e K beyond the bounds\n", limits, beyond);
  EXPECT_LT(beyond, 1.0);  // 1 % of the jump
}

INSTANTIATE_TEST_SUITE_P(
    Beyond, HeatStability,
    testing::Combine(testing::Values(HeatIntegration::rkl2, HeatIntegration::implicit),
                     testing::Values(100.0, 1e4)),
    [](const auto& tested) {
      return std::string(std::get<0>(tested.param) == HeatIntegration::rkl2 ? "rkl2" : "implicit") +
             (std::get<1>(tested.param) > 1e3 ? "_10000" : "_100");
    });

TEST(HeatStability, explicit_steps_hold_up_to_the_limit_and_not_beyond) {
  HeatNetwork network = rod(50, false);
  for (const double limits : {0.99, 1.02}) {
    std::vector<double> t, heat(2, 0.0);
    for (int i = 0; i < 50; ++i) t.push_back(i % 2 == 0 ? 1.0 : -1.0);
    const double step = limits * network.stable_step(0, t.data());
    auto integrator = make_heat_integrator(HeatIntegration::explicit_euler, {});
    for (int k = 0; k < 1000; ++k)
      integrator->advance(network, k * step, step, t.data(), heat.data());
    const double size = largest_difference(t, std::vector<double>(50, 0.0));
    EXPECT_EQ(size < 1, limits < 1) << size;
    EXPECT_EQ(integrator->statistics().evaluations, 1000);  // exactly one step each
  }
}

}  // namespace solidem::heat_stability_test
