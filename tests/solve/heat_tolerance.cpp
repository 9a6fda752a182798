// SPDX-License-Identifier: GPL-2.0-or-later
//
// Adaptive steps: the tolerance is met, the choice is the one the case calls for, a resumed run
// goes on with the same bits.
#include <gtest/gtest.h>

#include "heat_network.hpp"
#include "model/error.hpp"

namespace solidem::heat_tolerance_test {

constexpr NamedIntegration adaptive[] = {{"rkl2", HeatIntegration::rkl2, 0},
                                         {"implicit", HeatIntegration::implicit, 0},
                                         {"automatic", HeatIntegration::automatic, 0}};

class HeatTolerance : public testing::TestWithParam<NamedIntegration> {};

/// Largest error of a rod, one end of which jumps by 500 K, over ten advances.
double error_after_a_jump(HeatIntegration choice, double tolerance,
                          HeatIntegratorStatistics& statistics) {
  HeatNetwork network = rod(60, true);
  network.imposed_temperature = [](double) { return 500.0; };
  std::vector<double> t(60, 0.0), heat(2, 0.0);
  const ExactNetwork exact(network, t, 0, {}, {}, {500, 0});
  auto integrator = make_heat_integrator(choice, {tolerance});
  double error = 0;
  for (int k = 0; k < 10; ++k) {
    integrator->advance(network, 0.05 * k, 0.05, t.data(), heat.data());
    error = std::max(error, largest_difference(t, exact(0.05 * (k + 1))));
  }
  statistics = integrator->statistics();
  return error;
}

TEST_P(HeatTolerance, is_met_after_a_jump) {
  for (const double tolerance : {10.0, 1.0, 0.1, 0.01}) {
    HeatIntegratorStatistics s;
    const double error = error_after_a_jump(GetParam().choice, tolerance, s);
    std::printf(
        "tolerance %g K: error %.2e K; %lld steps (%lld explicit, %lld rkl2, %lld implicit), %lld "
        "rejected, %lld evaluations, %lld solves, %lld factorisations\n",
        tolerance, error, (long long)s.inner_steps, (long long)s.explicit_steps,
        (long long)s.rkl2_steps, (long long)s.implicit_steps, (long long)s.rejected,
        (long long)s.evaluations, (long long)s.solves, (long long)s.factorisations);
    EXPECT_LT(error, 3 * tolerance);
    EXPECT_GT(error, 1e-3 * tolerance);  // nor is work wasted
    EXPECT_LT(s.rejected, s.inner_steps / 2 + 5);
  }
}

TEST_P(HeatTolerance, is_met_with_loads_that_move) {
  HeatNetwork network = rod(40, true);
  network.imposed_temperature = [](double t) { return 100 * std::sin(60 * t); };
  network.source.assign(40, 1.0);
  network.source_shape = [](double t) { return 200 * std::sin(60 * t); };
  network.exchange[39] = 3;
  network.fluid_temperature = [](double t) { return 300 * std::sin(60 * t); };
  const std::vector<double> start(40, 0.0);
  const ExactNetwork exact(network, start, 60, {0, 200}, {0, 300}, {0, 100});
  for (const double tolerance : {1.0, 0.01}) {
    std::vector<double> t = start, heat(2, 0.0);
    auto integrator = make_heat_integrator(GetParam().choice, {tolerance});
    double error = 0;
    for (int k = 0; k < 5; ++k) {
      integrator->advance(network, 0.06 * k, 0.06, t.data(), heat.data());
      error = std::max(error, largest_difference(t, exact(0.06 * (k + 1))));
    }
    std::printf("tolerance %g K: error %.2e K\n", tolerance, error);
    EXPECT_LT(error, 3 * tolerance);
  }
}

TEST_P(HeatTolerance, is_met_by_a_body_that_changes_with_temperature) {
  HeatNetwork network = rod(40, true);
  network.imposed_temperature = [](double) { return 800.0; };
  network.capacity_growth = 1e-3;
  network.conductance_growth = -4e-4;
  const auto run = [&](HeatIntegration choice, double tolerance) {
    std::vector<double> t(40, 300.0), heat(2, 0.0);
    auto integrator = make_heat_integrator(choice, {tolerance});
    for (int k = 0; k < 4; ++k) integrator->advance(network, 0.05 * k, 0.05, t.data(), heat.data());
    return t;
  };
  // The reference is another method, explicit, with steps of a thousandth of its limit's scale.
  std::vector<double> reference(40, 300.0), heat(2, 0.0);
  auto euler = make_heat_integrator(HeatIntegration::explicit_euler, {});
  const int steps = 100000;
  for (int k = 0; k < steps; ++k)
    euler->advance(network, 0.2 * k / steps, 0.2 / steps, reference.data(), heat.data());
  for (const double tolerance : {1.0, 0.02}) {
    const double error = largest_difference(run(GetParam().choice, tolerance), reference);
    std::printf("tolerance %g K: error %.2e K\n", tolerance, error);
    EXPECT_LT(error, 3 * tolerance);
  }
}

TEST_P(HeatTolerance, resumed_run_goes_on_with_the_same_bits) {
  for (const bool nonlinear : {false, true})
    for (const double tolerance : {0.0, 0.5}) {
      if (GetParam().choice == HeatIntegration::automatic && tolerance == 0) continue;
      HeatNetwork network = uneven_cube(8);
      if (nonlinear) network.capacity_growth = 1e-3;
      network.imposed_temperature = [](double t) { return 500 + 50 * std::sin(t); };
      std::vector<double> t(network.elements(), 300.0), heat(2, 0.0);
      auto through = make_heat_integrator(GetParam().choice, {tolerance});
      const double duration = 1.7;
      double time = 0;
      for (int k = 0; k < 6; ++k, time += duration)
        through->advance(network, time, duration, t.data(), heat.data());
      std::vector<double> resumed_t = t, resumed_heat = heat;
      HeatNetwork resumed_network = network;
      auto resumed = make_heat_integrator(GetParam().choice, {tolerance});
      resumed->restore(through->save());
      for (int k = 0; k < 6; ++k, time += duration) {
        const double a = through->advance(network, time, duration, t.data(), heat.data());
        const double b = resumed->advance(resumed_network, time, duration, resumed_t.data(),
                                          resumed_heat.data());
        EXPECT_EQ(a, b);
      }
      EXPECT_EQ(t, resumed_t);
      EXPECT_EQ(heat, resumed_heat);
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, HeatTolerance, testing::ValuesIn(adaptive),
                         [](const auto& tested) { return tested.param.name; });

TEST(HeatTolerance, automatic_takes_what_the_time_span_calls_for) {
  // The end of a rod jumps by 500 K.
  HeatNetwork network = rod(200, true);
  network.imposed_temperature = [](double) { return 500.0; };
  std::vector<double> heat(2, 0.0), t(200, 0.0);
  const double limit = network.stable_step(0, t.data());
  auto brief = make_heat_integrator(HeatIntegration::automatic, {50});
  brief->advance(network, 0, 0.5 * limit, t.data(), heat.data());
  std::puts(brief->explanation().c_str());
  EXPECT_EQ(brief->statistics().explicit_steps, brief->statistics().inner_steps);
  // Into the decay.
  t.assign(200, 0.0);
  auto integrator = make_heat_integrator(HeatIntegration::automatic, {0.5});
  const HeatIntegratorStatistics& steps = integrator->statistics();
  integrator->advance(network, 0, 30 * limit, t.data(), heat.data());
  std::puts(integrator->explanation().c_str());
  EXPECT_GT(steps.rkl2_steps, steps.explicit_steps);
  EXPECT_GT(steps.rkl2_steps, steps.implicit_steps);
  // On to the steady state.
  const HeatIntegratorStatistics before = steps;
  integrator->advance(network, 30 * limit, 1e6 * limit, t.data(), heat.data());
  std::puts(integrator->explanation().c_str());
  EXPECT_GT(steps.implicit_steps - before.implicit_steps, steps.rkl2_steps - before.rkl2_steps);
  EXPECT_GT(steps.implicit_steps - before.implicit_steps,
            steps.explicit_steps - before.explicit_steps);
  for (const double value : t) EXPECT_NEAR(value, 500, 0.5);
}

TEST(HeatTolerance, is_refused_where_it_has_no_use_and_asked_for_where_it_has) {
  EXPECT_THROW(make_heat_integrator(HeatIntegration::automatic, {}), InputError);
  EXPECT_THROW(make_heat_integrator(HeatIntegration::explicit_euler, {0.1}), InputError);
  EXPECT_THROW(make_heat_integrator(HeatIntegration::rkl2, {-1}), InputError);
}

TEST(HeatTolerance, that_no_step_meets_ends_the_run) {
  HeatNetwork network = rod(10, false);
  network.source.assign(10, 1.0);
  network.source_shape = [](double) { return std::nan(""); };
  for (const NamedIntegration& integration : adaptive) {
    std::vector<double> t(10, 300.0), heat(2, 0.0);
    auto integrator = make_heat_integrator(integration.choice, {0.1});
    EXPECT_THROW(integrator->advance(network, 0, 1, t.data(), heat.data()), RunError);
  }
  std::vector<double> t(10, 300.0), heat(2, 0.0);
  auto integrator = make_heat_integrator(HeatIntegration::implicit, {});
  EXPECT_THROW(integrator->advance(network, 0, 1, t.data(), heat.data()), RunError);
}

}  // namespace solidem::heat_tolerance_test
