// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is read off a tension curve, on curves whose figures are known.
#include <gtest/gtest.h>

#include "engine/tension_test.hpp"

namespace solidem::tension_figures_test {

constexpr double modulus = 70e9;

/// Elastic to `yield`, then along a line of slope `hardening`; falls to nothing at `rupture`.
std::vector<TensionPoint> bilinear(double yield, double hardening, double rupture) {
  std::vector<TensionPoint> points;
  for (int k = 0; k <= 3000; ++k) {
    const double strain = 1e-4 * k, knee = yield / modulus;
    const double stress = strain < knee ? modulus * strain : yield + hardening * (strain - knee);
    points.push_back({strain, strain, strain < rupture ? stress : 0});
  }
  return points;
}

TEST(TensionFigures, OfAHardeningBarAreExact) {
  const double yield = 280e6, hardening = 1e9;
  const TensionFigures figures = figures_of(bilinear(yield, hardening, 0.15005), modulus);
  // E (ε − .002) = σ_y + H (ε − σ_y / E)
  const double strain =
      (yield - hardening * yield / modulus + 0.002 * modulus) / (modulus - hardening);
  ASSERT_TRUE(figures.yield_stress && figures.peak_stress && figures.rupture_strain);
  EXPECT_NEAR(*figures.yield_stress, modulus * (strain - 0.002), 1);
  EXPECT_NEAR(*figures.peak_stress, yield + hardening * (0.15 - yield / modulus), 1);
  EXPECT_NEAR(*figures.rupture_strain, 0.15005, 1e-4);
}

TEST(TensionFigures, OfAnUnbrokenBarHaveNoRupture) {
  const TensionFigures figures = figures_of(bilinear(280e6, 1e9, 1), modulus);
  EXPECT_TRUE(figures.yield_stress);
  EXPECT_FALSE(figures.rupture_strain);
}

TEST(TensionFigures, OfABrittleBarHaveNoYieldStress) {
  const TensionFigures figures = figures_of(bilinear(1e9, 0, 0.003), modulus);
  EXPECT_FALSE(figures.yield_stress);
  ASSERT_TRUE(figures.peak_stress && figures.rupture_strain);
  EXPECT_NEAR(*figures.peak_stress, modulus * 0.0029, 1);
  EXPECT_NEAR(*figures.rupture_strain, 0.003, 1.01e-4);
}

}  // namespace solidem::tension_figures_test
