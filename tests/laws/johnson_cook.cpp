// SPDX-License-Identifier: GPL-2.0-or-later
//
// The yield law of Johnson and Cook, alone: its cuts, its derivatives, and how warm adiabatic
// compression makes aluminium.
#include "laws/johnson_cook.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "laws/dual.hpp"

namespace solidem::johnson_cook_test {

using State = YieldState<double>;

constexpr double young_modulus = 70e9;

/// AA6082: Terreros 2013, table 4.2.
JohnsonCook aluminium() {
  JohnsonCook law;
  law.yield_strain = 219e6 / young_modulus;
  law.hardening_strain = 276e6 / young_modulus;
  law.hardening_exponent = 0.249;
  law.rate_sensitivity = 0.025;
  law.softening_exponent = 1.36;
  law.reference_temperature = 296;
  law.melting_temperature = 855;
  return law;
}

TEST(JohnsonCook, is_the_product_of_hardening_rate_and_softening) {
  const JohnsonCook law = aluminium();
  EXPECT_DOUBLE_EQ(law.limit(0.0, State{296, 1}) * young_modulus, 219e6);
  EXPECT_NEAR(law.limit(1.0, State{296, 1}) * young_modulus, 495e6, 1);
  EXPECT_NEAR(law.limit(1.0, State{296, std::exp(4.0)}) * young_modulus, 1.1 * 495e6, 1);
  const double half_way = 296 + 0.5 * (855 - 296);
  EXPECT_NEAR(law.limit(1.0, State{half_way, 1}) * young_modulus, 495e6 * (1 - std::pow(0.5, 1.36)),
              1);
}

TEST(JohnsonCook, is_cut_where_it_would_make_no_sense) {
  const JohnsonCook law = aluminium();
  for (const double strain : {0.0, 1e-12, 0.3, 10.0}) {
    const double slow_and_cold = law.limit(strain, State{296, 1});
    for (const double rate : {0.0, 1e-300, 0.5})
      EXPECT_EQ(law.limit(strain, State{0, rate}), slow_and_cold);
    double before = slow_and_cold;
    for (double temperature = 296; temperature < 3000; temperature += 20) {
      const double now = law.limit(strain, State{temperature, 1});
      EXPECT_LE(now, before);
      EXPECT_GE(now, 0);
      before = now;
    }
    for (const double temperature : {855.0, 1e4})
      for (const double rate : {0.0, 1e6})
        EXPECT_EQ(law.limit(strain, State{temperature, rate}), 0);
    EXPECT_TRUE(std::isfinite(law.limit(strain, State{500, 1e6})));
  }
}

TEST(JohnsonCook, has_the_derivatives_of_dual_numbers) {
  const JohnsonCook law = aluminium();
  using Dual = DualNumber<double>;
  const double strain = 0.07, rate = 900, temperature = 420;
  const auto at = [&](double k, double r, double t) { return law.limit(k, State{t, r}); };
  const auto check = [](double derivative, double above, double below, double step) {
    const double expected = (above - below) / (2 * step);
    EXPECT_NEAR(derivative, expected, 1e-7 * std::fabs(expected));
  };
  const auto slope = [&](Dual k, Dual r, Dual t) {
    return law.limit(k, YieldState<Dual>{t, r}).derivative;
  };
  check(slope({strain, 1}, {rate, 0}, {temperature, 0}), at(strain + 1e-6, rate, temperature),
        at(strain - 1e-6, rate, temperature), 1e-6);
  check(slope({strain, 0}, {rate, 1}, {temperature, 0}), at(strain, rate + 1e-2, temperature),
        at(strain, rate - 1e-2, temperature), 1e-2);
  check(slope({strain, 0}, {rate, 0}, {temperature, 1}), at(strain, rate, temperature + 1e-2),
        at(strain, rate, temperature - 1e-2), 1e-2);
}

TEST(JohnsonCook, complains_about_melting_below_the_reference) {
  JohnsonCook law = aluminium();
  EXPECT_EQ(law.complaint(), nullptr);
  law.melting_temperature = law.reference_temperature;
  EXPECT_NE(law.complaint(), nullptr);
}

/// Temperature rises of one point that is compressed at a rate without losing heat, K, when it has
/// reached each of some strains.
std::vector<double> rises(double start, double rate, const std::vector<double>& strains,
                          double fraction, int steps) {
  constexpr double density = 2700, specific_heat = 900;
  const JohnsonCook law = aluminium();
  double plastic = 0, temperature = start;
  std::vector<double> found;
  for (int n = 1; found.size() < strains.size(); ++n) {
    const double strain = strains.back() * n / steps;
    const YieldCurve<JohnsonCook, double> curve{law, {temperature, rate}};
    const double elastic = strain - plastic;
    if (elastic > curve.limit(plastic)) {
      const double left = returned_strain(curve, elastic, plastic);
      const double flow = elastic - left;
      plastic += flow;
      temperature += fraction * young_modulus * left * flow / (density * specific_heat);
    }
    if (strain >= strains[found.size()] * (1 - 1e-12)) found.push_back(temperature - start);
  }
  return found;
}

struct Compression {
  double start, rate;
  std::vector<double> strain, measured;
};

/// Terreros 2013, table 4.1.
const std::vector<Compression> table = {
    {296, 600, {0.014, 0.027, 0.046}, {1.4, 3.0, 5.8}},
    {296, 1000, {0.026, 0.047, 0.070, 0.092}, {3.1, 6.1, 9.7, 13.0}},
    {373, 1500, {0.038, 0.127, 0.195}, {3.5, 15.0, 20.0}}};

/// The root mean square of what the law misses in the ten rows, K.
double misses(double fraction, std::vector<double>& found) {
  double square = 0;
  for (const Compression& test : table) {
    const auto of_test = rises(test.start, test.rate, test.strain, fraction, 4000);
    for (std::size_t k = 0; k < of_test.size(); ++k)
      square += (of_test[k] - test.measured[k]) * (of_test[k] - test.measured[k]);
    found.insert(found.end(), of_test.begin(), of_test.end());
  }
  return std::sqrt(square / static_cast<double>(found.size()));
}

// Figures of an integration by bisection in steps a fifth as long, written apart from this code.
TEST(JohnsonCook, warms_aluminium_as_an_independent_integration_says) {
  std::vector<double> most, less;
  EXPECT_NEAR(misses(0.9, most), 2.535, 0.005);
  EXPECT_NEAR(misses(0.8, less), 1.726, 0.005);
  const double by_most[] = {1.11, 2.82, 5.51, 2.71, 5.71, 9.17, 12.61, 4.18, 17.11, 27.64};
  const double by_less[] = {0.98, 2.51, 4.90, 2.41, 5.08, 8.16, 11.21, 3.71, 15.22, 24.62};
  ASSERT_EQ(most.size(), 10u);
  for (std::size_t k = 0; k < most.size(); ++k) {
    EXPECT_NEAR(most[k], by_most[k], 0.01);
    EXPECT_NEAR(less[k], by_less[k], 0.01);
  }
}

TEST(JohnsonCook, warms_the_same_in_finer_steps_to_first_order) {
  const auto end = [](int steps) { return rises(373, 1500, {0.195}, 0.9, steps)[0]; };
  const double exact = end(64000);
  const double order = std::log2(std::fabs(end(500) - exact) / std::fabs(end(1000) - exact));
  EXPECT_GT(order, 0.8);
  EXPECT_LT(std::fabs(end(1000) - exact), 0.05);
}

}  // namespace solidem::johnson_cook_test
