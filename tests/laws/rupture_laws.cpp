// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/rupture_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "laws/bond_limit.hpp"

namespace solidem::rupture_laws_test {

/// A strain with these parts; the equivalent one follows.
BondStrain<double> strained(double normal, double bending, double twist, double plastic = 0) {
  const double edge = std::fabs(normal) + bending;
  return {std::sqrt(edge * edge + 3 * twist * twist), plastic, normal, bending, twist};
}

MohrCoulombRupture mohr_coulomb() {
  MohrCoulombRupture law;
  law.tensile_strain = 3e-3;
  law.cohesion_strain = 4e-3;
  law.friction_coefficient = 0.6;
  return law;
}

TEST(StrainLimit, breaks_by_stress_or_by_strain) {
  EXPECT_FALSE((StrainLimit{3e-3, unlimited}.breaks(strained(2.9e-3, 0, 0, 1.0))));
  EXPECT_TRUE((StrainLimit{3e-3, unlimited}.breaks(strained(3.1e-3, 0, 0, 0.0))));
  EXPECT_FALSE((StrainLimit{unlimited, 0.2}.breaks(strained(2e-3, 0, 0, 0.197))));
  EXPECT_TRUE((StrainLimit{unlimited, 0.2}.breaks(strained(2e-3, 0, 0, 0.199))));
}

TEST(StrainLimit, without_limits_is_complained_about) {
  EXPECT_NE(StrainLimit{}.complaint(), nullptr);
  EXPECT_EQ((StrainLimit{unlimited, 0.2}.complaint()), nullptr);
}

TEST(MohrCoulombRupture, breaks_in_tension_but_not_under_pressure) {
  EXPECT_FALSE(mohr_coulomb().breaks(strained(2.9e-3, 0, 0)));
  EXPECT_TRUE(mohr_coulomb().breaks(strained(3.1e-3, 0, 0)));
  EXPECT_TRUE(mohr_coulomb().breaks(strained(2e-3, 1.1e-3, 0)));
  EXPECT_FALSE(mohr_coulomb().breaks(strained(-1.0, 0, 0)));
}

TEST(MohrCoulombRupture, bears_more_twist_under_pressure) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_FALSE(mohr_coulomb().breaks(strained(0, 0, sign * 3.9e-3)));
    EXPECT_TRUE(mohr_coulomb().breaks(strained(0, 0, sign * 4.1e-3)));
    EXPECT_FALSE(mohr_coulomb().breaks(strained(-1e-3, 0, sign * 4.5e-3)));
    EXPECT_TRUE(mohr_coulomb().breaks(strained(-1e-3, 0, sign * 4.7e-3)));
  }
}

/// The law with limits of this size.
template <class Law>
Law typical() {
  Law law;
  for (const auto& parameter : law.parameters()) law.*parameter.member = 3e-3;
  return law;
}

TEST(RuptureLaws, no_bond_breaks_below_the_lower_bound_and_some_do_just_above) {
  RuptureLaws::for_each([](auto empty) {
    const auto law = typical<decltype(empty)>();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(-1, 1);
    int broken_above = 0;
    for (int n = 0; n < 200000; ++n) {
      const double plastic = 1e-3 * (1 + part(random));
      BondStrain<double> at = strained(part(random), std::fabs(part(random)), part(random));
      if (n % 2 == 0) at = strained(at.normal, 0, 0.01 * at.twist);
      const double bound = law.lower_bound(plastic);
      const auto scaled = [&](double size) {
        const double fraction = size * bound / at.equivalent;
        return BondStrain<double>{size * bound, plastic, fraction * at.normal,
                                  fraction * at.bending, fraction * at.twist};
      };
      ASSERT_FALSE(law.breaks(scaled(1 - 1e-12))) << law.name;
      broken_above += law.breaks(scaled(1.05)) ? 1 : 0;
    }
    EXPECT_GT(broken_above, 0) << law.name;
  });
}

TEST(BondLimit,
     is_the_nearer_of_yield_and_rupture_and_falls_to_none_when_scaled_offset_has_flowed) {
  const YieldLaw yield = LinearHardening{2e-3, 0.1};
  const RuptureLaw rupture = StrainLimit{unlimited, 0.02};
  const auto limit = [&](FlowRule rule, double plastic) {
    return limit_strain(&yield, rule, &rupture, plastic);
  };
  EXPECT_DOUBLE_EQ(limit(FlowRule::radial_return, 0), 2e-3);
  EXPECT_DOUBLE_EQ(limit(FlowRule::radial_return, 0.01), 3e-3);
  EXPECT_DOUBLE_EQ(limit(FlowRule::radial_return, 0.019), 1e-3);
  EXPECT_DOUBLE_EQ(limit(FlowRule::radial_return, 0.03), 0);
  EXPECT_DOUBLE_EQ(limit(FlowRule::scaled_offset, 0), 2e-3);
  EXPECT_EQ(limit(FlowRule::scaled_offset, 1e-9), 0);
  EXPECT_EQ(limit_strain(nullptr, FlowRule::radial_return, nullptr, 0), unlimited);
}

}  // namespace solidem::rupture_laws_test
