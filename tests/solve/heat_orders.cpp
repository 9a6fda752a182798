// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "heat_network.hpp"

namespace solidem::heat_orders_test {

/// Error at time 0.1 of a rod that starts as a cosine, in `steps` equal advances.
double error_of(HeatIntegration choice, HeatNetwork network, const ExactNetwork& exact,
                const std::vector<double>& start, int steps, double duration = 0.1) {
  auto integrator = make_heat_integrator(choice, {});
  std::vector<double> t = start, heat(2, 0.0);
  for (int k = 0; k < steps; ++k)
    integrator->advance(network, duration * k / steps, duration / steps, t.data(), heat.data());
  return largest_difference(t, exact(duration));
}

std::vector<double> cosine(std::size_t n) {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i)
    t.push_back(std::cos(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(n)));
  return t;
}

/// Observed order between `steps` and twice as many.
double order_of(HeatIntegration choice, const HeatNetwork& network, const ExactNetwork& exact,
                const std::vector<double>& start, int steps) {
  const double coarse = error_of(choice, network, exact, start, steps);
  const double fine = error_of(choice, network, exact, start, 2 * steps);
  std::printf("%d steps: error %.2e, then %.2e\n", steps, coarse, fine);
  return std::log2(coarse / fine);
}

class HeatOrder : public testing::TestWithParam<bool> {
 protected:
  HeatOrder() {
    if (GetParam()) {
      // Smooth loads that move; the start is at rest with them.
      network_ = rod(40, true);
      start_.assign(40, 0.0);
      network_.imposed_temperature = [](double t) { return 10 * std::sin(30 * t); };
      network_.source.assign(40, 1.0);
      network_.source_shape = [](double t) { return 20 * std::sin(30 * t); };
      network_.exchange[39] = 3;
      network_.fluid_temperature = [](double t) { return 5 * std::sin(30 * t); };
    }
  }
  HeatNetwork network_ = rod(40, false);
  std::vector<double> start_ = cosine(40);
  double omega_ = GetParam() ? 30 : 0;
  ExactNetwork exact() const {
    return {network_, start_, omega_, {0, 20}, {0, 5}, {0, omega_ > 0 ? 10.0 : 0.0}};
  }
};

TEST_P(HeatOrder, explicit_is_of_first_order) {
  EXPECT_NEAR(order_of(HeatIntegration::explicit_euler, network_, exact(), start_, 400), 1, 0.05);
}

TEST_P(HeatOrder, rkl2_is_of_second_order) {
  // 40 steps are 8 explicit limits each, 7 stages; 80 are 4, 5 stages. The graded start is as short
  // as the explicit limit in both.
  EXPECT_NEAR(order_of(HeatIntegration::rkl2, network_, exact(), start_, 40), 2, 0.25);
}

TEST_P(HeatOrder, implicit_is_of_second_order) {
  EXPECT_NEAR(order_of(HeatIntegration::implicit, network_, exact(), start_, 160), 2, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Loads, HeatOrder, testing::Bool());

TEST(HeatOrder, finite_volumes_and_rkl2_reach_the_continuous_solution) {
  // cos(πx) decays as exp(−π² t); finite volumes are of second order in their size.
  double last = 0;
  for (const std::size_t n : {16u, 32u, 64u}) {
    HeatNetwork network = rod(n, false);
    std::vector<double> t = cosine(n), heat(2, 0.0);
    auto integrator = make_heat_integrator(HeatIntegration::rkl2, {1e-7});
    integrator->advance(network, 0, 0.1, t.data(), heat.data());
    std::vector<double> exact = cosine(n);
    for (double& value : exact) value *= std::exp(-M_PI * M_PI * 0.1);
    const double error = largest_difference(t, exact);
    std::printf("%zu volumes: error %.3e\n", n, error);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.1);
    }
    last = error;
  }
}

}  // namespace solidem::heat_orders_test
