// SPDX-License-Identifier: GPL-2.0-or-later
//
// Whatever the integrator, its step and its error: elements gain what the accounts and the imposed
// temperatures give.
#include <gtest/gtest.h>

#include <tuple>

#include "heat_network.hpp"

namespace solidem::heat_balance_test {

constexpr NamedIntegration integrations[] = {
    {"explicit", HeatIntegration::explicit_euler, 0},
    {"rkl2", HeatIntegration::rkl2, 0},
    {"implicit", HeatIntegration::implicit, 0},
    {"rkl2_adaptive", HeatIntegration::rkl2, 0.1},
    {"implicit_adaptive", HeatIntegration::implicit, 0.1},
    {"automatic", HeatIntegration::automatic, 0.1},
};

struct Case {
  const char* name;
  HeatNetwork (*network)();
};

HeatNetwork adiabatic() {
  return rod(30, false);
}

HeatNetwork loaded() {
  HeatNetwork network = rod(30, true);
  network.source.assign(30, 2.0);
  network.source_shape = [](double t) { return 100 * std::sin(70 * t); };
  network.exchange[29] = 40;
  network.fluid_temperature = [](double t) { return 300 + 200 * std::cos(50 * t); };
  // Starts 500 K above what is given, rises, and falls within a thousandth of a second.
  network.imposed_temperature = [](double t) {
    return t < 0.02 ? 800 + 1e3 * t : std::max(300.0, 820 - 5e5 * (t - 0.02));
  };
  return network;
}

HeatNetwork loaded_and_nonlinear() {
  HeatNetwork network = loaded();
  network.capacity_growth = 1e-3;
  network.conductance_growth = -3e-4;
  return network;
}

HeatNetwork uneven() {
  HeatNetwork network = uneven_cube(7);
  network.imposed_temperature = [](double) { return 900.0; };
  return network;
}

constexpr Case cases[] = {{"adiabatic", adiabatic},
                          {"loaded", loaded},
                          {"loaded_and_nonlinear", loaded_and_nonlinear},
                          {"uneven_cube", uneven}};

class HeatBalance : public testing::TestWithParam<std::tuple<NamedIntegration, Case>> {};

TEST_P(HeatBalance, closes_to_round_off) {
  const auto& [integration, body] = GetParam();
  HeatNetwork network = body.network();
  auto integrator = make_heat_integrator(integration.choice, {integration.tolerance});
  std::vector<double> t, heat(2, 0.0);
  for (std::size_t i = 0; i < network.elements(); ++i)
    t.push_back(300 + 200 * std::sin(static_cast<double>(i)));
  const std::vector<double> start = t;
  const double before = network.total_enthalpy(t);
  const double step = 0.8 * network.stable_step(0, t.data()) *
                      (integration.choice == HeatIntegration::explicit_euler ? 1 : 37);
  double imposed = 0, moved = 0;
  double time = 0;
  for (int k = 0; k < 200; ++k, time += step) {
    std::vector<double> account(2, 0.0);
    const double into = integrator->advance(network, time, step, t.data(), account.data());
    imposed += into;
    moved += std::fabs(into) + std::fabs(account[0]) + std::fabs(account[1]);
    heat[0] += account[0];
    heat[1] += account[1];
  }
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_TRUE(std::isfinite(t[i]));
    moved += std::fabs(network.enthalpy(i, t[i]) - network.enthalpy(i, start[i]));
  }
  const double gap = network.total_enthalpy(t) - before - heat[0] - heat[1] - imposed;
  std::printf("heat unaccounted for: %.1e of what moved\n", std::fabs(gap) / moved);
  EXPECT_LT(std::fabs(gap), 1e-12 * moved);
  EXPECT_GT(moved, 1e-3 * before);
}

INSTANTIATE_TEST_SUITE_P(Integrators, HeatBalance,
                         testing::Combine(testing::ValuesIn(integrations),
                                          testing::ValuesIn(cases)),
                         [](const auto& tested) {
                           return std::string(std::get<0>(tested.param).name) + "_" +
                                  std::get<1>(tested.param).name;
                         });

TEST(HeatBalance, of_an_implicit_step_closes_at_a_million_explicit_limits) {
  for (const bool nonlinear : {false, true}) {
    HeatNetwork network = uneven_cube(9);
    network.imposed_temperature = [](double) { return 800.0; };
    if (nonlinear) {
      network.capacity_growth = 1e-3;
      network.conductance_growth = 5e-4;
    }
    std::vector<double> t(network.elements(), 300.0), heat(2, 0.0);
    const double before = network.total_enthalpy(t);
    const double step = 1e6 * network.stable_step(0, t.data());
    auto integrator = make_heat_integrator(HeatIntegration::implicit, {});
    double imposed = 0;
    std::int64_t steps = 0;
    for (int k = 0; k < 3; ++k) {
      steps = integrator->statistics().inner_steps;
      imposed += integrator->advance(network, k * step, step, t.data(), heat.data());
    }
    EXPECT_EQ(integrator->statistics().inner_steps, steps + 1);
    const double gap = network.total_enthalpy(t) - before - imposed;
    double farthest = 0;
    for (const double value : t) farthest = std::max(farthest, std::fabs(value - 800));
    std::printf("unaccounted for: %.1e; farthest from the steady state %.1e K, %lld solves\n",
                std::fabs(gap / imposed), farthest,
                static_cast<long long>(integrator->statistics().solves));
    EXPECT_LT(std::fabs(gap), 1e-12 * imposed);
    // Each step leaves at most 4.83/z of a mode that decays by exp(−z).
    EXPECT_LT(farthest, 1e-4);
  }
}

TEST(HeatBalance, of_imposed_heat_is_the_heat_that_enters_there) {
  // Steady rod between a fluid and an imposed end: what the end gives the fluid takes.
  HeatNetwork network = rod(30, true);
  network.exchange[29] = 2;
  network.imposed_temperature = [](double) { return 90.0; };
  std::vector<double> t, heat(2, 0.0);
  // Series of 29 links of 1/30 and 1/2: the flow is 90/(29/30 + 1/2).
  const double flow = 90 / (29.0 / 30 + 0.5);
  for (int i = 0; i < 30; ++i) t.push_back(90 - flow * i / 30);
  for (const NamedIntegration& integration : integrations) {
    if (integration.choice == HeatIntegration::explicit_euler) continue;
    auto integrator = make_heat_integrator(integration.choice, {integration.tolerance});
    heat.assign(2, 0.0);
    const double imposed = integrator->advance(network, 0, 0.5, t.data(), heat.data());
    EXPECT_NEAR(imposed, 0.5 * flow, 1e-10) << integration.name;
    EXPECT_NEAR(heat[1], -0.5 * flow, 1e-10) << integration.name;
  }
}

}  // namespace solidem::heat_balance_test
