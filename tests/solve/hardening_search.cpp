// SPDX-License-Identifier: GPL-2.0-or-later
//
// The hardening of bonds that a curve asks for is found with few tests of bodies, here formulas.
#include "solve/calibration/hardening_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace solidem::hardening_search_test {

constexpr double young_modulus = 100e9;
const std::vector<double> strains{0.005, 0.01, 0.02, 0.05, 0.1};

double limit_of(const YieldLaw& any, double plastic) {
  return std::visit([&](const auto& law) { return law.limit(plastic, YieldState<double>{}); }, any);
}

/// A body whose bonds flow more than it does, and of which not all yield at first.
double bears(const YieldLaw& law, double plastic) {
  const double knee = 1 - std::exp(-plastic / 0.004);
  return young_modulus * (0.8 + 1.4 * knee) * limit_of(law, 1.4 * plastic);
}

/// The curve of such a body with known bonds, at given lasting strains.
CurveTarget curve_of(const YieldLaw& law, double tolerance) {
  CurveTarget target{{}, tolerance};
  for (const double plastic : strains) {
    const double stress = bears(law, plastic);
    target.points.push_back({plastic + stress / young_modulus, stress});
  }
  return target;
}

/// Tests of such a body, counted.
struct Bodies {
  int tests = 0;

  HardeningSearch meet(const CurveTarget& target, const YieldLaw& form, int most = 12) {
    return find_hardening(target, young_modulus, form, most, [&](const YieldLaw& law) {
      ++tests;
      std::vector<double> stresses;
      for (const double plastic : strains) stresses.push_back(bears(law, plastic));
      return stresses;
    });
  }
};

JohnsonCook copper() {
  JohnsonCook law;
  law.yield_strain = 5e-4;
  law.hardening_strain = 2e-3;
  law.hardening_exponent = 0.35;
  return law;
}

TEST(HardeningSearch, finds_the_bonds_that_a_body_was_made_of) {
  const std::vector<YieldLaw> laws{LinearHardening{2e-3, 0.01}, VoceHardening{1e-3, 2e-3, 0.03},
                                   copper()};
  for (const YieldLaw& law : laws) {
    Bodies bodies;
    const HardeningSearch search = bodies.meet(curve_of(law, 1e-3), law);
    EXPECT_LE(search.worst, 1e-3);
    EXPECT_LE(bodies.tests, 6);
    const auto found = hardening_parameters(search.law), known = hardening_parameters(law);
    ASSERT_EQ(found.size(), known.size());
    for (std::size_t k = 0; k < known.size(); ++k)
      EXPECT_NEAR(found[k].value / known[k].value, 1, 0.05) << known[k].name;
  }
}

TEST(HardeningSearch, keeps_what_rate_and_temperature_do_but_does_not_look_at_it) {
  JohnsonCook law = copper();
  law.rate_sensitivity = 0.025;
  law.softening_exponent = 1.09;
  law.reference_temperature = 298;
  law.melting_temperature = 1356;
  const auto found = std::get<JohnsonCook>(Bodies().meet(curve_of(copper(), 1e-3), law).law);
  EXPECT_EQ(found.rate_sensitivity, law.rate_sensitivity);
  EXPECT_EQ(found.melting_temperature, law.melting_temperature);
  EXPECT_NEAR(found.yield_strain / law.yield_strain, 1, 0.05);
  const auto bare = std::get<JohnsonCook>(slow_and_cold(found));
  EXPECT_FALSE(bare.follows_rate() || bare.follows_temperature());
  EXPECT_EQ(bare.hardening_strain, found.hardening_strain);
}

TEST(HardeningSearch, ends_with_the_nearest_where_no_hardening_will_do) {
  CurveTarget target = curve_of(copper(), 0.01);
  target.points.back().stress *= 3;  // at once, after a plateau
  Bodies bodies;
  const HardeningSearch search = bodies.meet(target, copper());
  EXPECT_GT(search.worst, 0.01);
  EXPECT_LE(bodies.tests, 12);
  for (std::size_t k = 0; k < strains.size(); ++k)
    EXPECT_EQ(search.stresses[k], bears(search.law, strains[k])) << "of the law that it tells";
}

TEST(HardeningSearch, tells_a_point_that_no_body_reached) {
  const CurveTarget target = curve_of(copper(), 0.01);
  const HardeningSearch search =
      find_hardening(target, young_modulus, copper(), 3, [](const YieldLaw&) {
        return std::vector<double>{1e8, 1e8, 1e8, 1e8, std::nan("")};
      });
  EXPECT_EQ(search.worst, HUGE_VAL);
  EXPECT_TRUE(std::isnan(search.stresses.back()));
}

TEST(FlowCurve, of_true_measures_has_the_work_of_the_engineering_ones) {
  const auto stress = [](double e) { return 1e8 * std::sqrt(e); };
  const int steps = 20000;
  for (const auto measured : {true_point, compressed_point}) {
    double work = 0, engineering = 0;
    for (int n = 0; n < steps; ++n) {
      const double from = 0.3 * n / steps, to = 0.3 * (n + 1) / steps;
      const FlowPoint p = measured(from, stress(from)), q = measured(to, stress(to));
      work += 0.5 * (p.stress + q.stress) * (q.strain - p.strain);
      engineering += 0.5 * (stress(from) + stress(to)) * (to - from);
    }
    EXPECT_NEAR(work, engineering, 1e-6 * engineering);
  }
}

TEST(FlowCurve, of_compression_is_that_of_tension_seen_from_the_other_side) {
  const FlowPoint tension = true_point(0.25, 1e8), compression = compressed_point(0.2, 1.25e8);
  EXPECT_DOUBLE_EQ(tension.strain, compression.strain);  // 1.25 times as long, and back
  EXPECT_DOUBLE_EQ(1.25e8 * 0.8, compression.stress);
  EXPECT_DOUBLE_EQ(1e8 * 1.25, tension.stress);
}

TEST(FlowCurve, of_johnson_and_cook_is_elastic_and_then_flows_by_the_formula) {
  const JohnsonCookCurve copper{90e6, 292e6, 0.31};
  const auto points = points_of(copper, 124e9, {0.0005, 0.005, 0.1});
  EXPECT_DOUBLE_EQ(points[0].stress, 124e9 * 0.0005);
  for (const std::size_t k : {1u, 2u}) {
    const double lasting = lasting_strain(points[k], 124e9);
    EXPECT_NEAR(points[k].stress, 90e6 + 292e6 * std::pow(lasting, 0.31), 1);
  }
}

TEST(FlowCurve, is_straight_between_its_points_and_ends_with_them) {
  const std::vector<FlowPoint> curve{{0.01, 1e8}, {0.03, 2e8}, {0.04, 2e8}};
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.02), 1.5e8);
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.01), 1e8);
  EXPECT_DOUBLE_EQ(stress_at(curve, 0.04), 2e8);
  EXPECT_TRUE(std::isnan(stress_at(curve, 0.005)));
  EXPECT_TRUE(std::isnan(stress_at(curve, 0.05)));
}

}  // namespace solidem::hardening_search_test
