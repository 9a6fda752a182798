// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/oriented_modulus.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidem::oriented_modulus_test {

using V = Vector3<double>;

constexpr GrainAxes<double> along_axes{{1, 0, 0}, {0, 1, 0}};

V direction(double theta, double phi) {
  return {std::cos(theta), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi)};
}

TEST(OrientedModulus, IsItsOwnAlongEachAxis) {
  const OrientedModulus<double> modulus{20e9, 1.4e9, 0.9e9, 5};
  EXPECT_EQ(modulus_along(modulus, along_axes, {1, 0, 0}), 20e9);
  EXPECT_DOUBLE_EQ(modulus_along(modulus, along_axes, {0, 1, 0}), 1.4e9);
  EXPECT_EQ(modulus_along(modulus, along_axes, {0, 0, 1}), 0.9e9);
}

TEST(OrientedModulus, FollowsThePowerOfTheCosine) {
  const OrientedModulus<double> modulus{20e9, 0.9e9, 0.9e9, 4};
  for (const double theta : {0.2, 0.7, 1.2, 1.5})
    for (const double phi : {0.0, 0.4, 2.9})
      EXPECT_NEAR(modulus_along(modulus, along_axes, direction(theta, phi)),
                  0.9e9 + 19.1e9 * std::pow(std::cos(theta), 4), 1e-5);
}

TEST(OrientedModulus, IsATensorAcrossTheGrain) {
  // The mean of two perpendicular transverse directions is free of their angle.
  const OrientedModulus<double> modulus{20e9, 1.4e9, 0.9e9, 4};
  const double quarter = std::acos(0.0);
  for (const double phi : {0.0, 0.3, 1.1})
    EXPECT_NEAR(modulus_along(modulus, along_axes, direction(quarter, phi)) +
                    modulus_along(modulus, along_axes, direction(quarter, phi + quarter)),
                2.3e9, 1e-5);
}

TEST(OrientedModulus, IsSmoothAlongTheGrainAndEven) {
  const OrientedModulus<double> modulus{20e9, 1.4e9, 0.9e9, 3};
  for (const double phi : {0.0, 1.0, 2.0}) {
    EXPECT_NEAR(modulus_along(modulus, along_axes, direction(1e-7, phi)), 20e9, 1e-2);
    const V n = direction(0.8, phi);
    EXPECT_EQ(modulus_along(modulus, along_axes, n), modulus_along(modulus, along_axes, -n));
  }
}

TEST(OrientedModulus, OfThreeEqualModuliIsThatModulusToTheLastBit) {
  const OrientedModulus<double> modulus{3.1e12, 3.1e12, 3.1e12, 7.3};
  for (const double theta : {0.0, 0.1, 0.9, 1.5, 3.0})
    for (const double phi : {0.0, 0.4, 2.9})
      EXPECT_EQ(modulus_along(modulus, along_axes, direction(theta, phi)), 3.1e12);
}

TEST(OrientedModulus, TurnsWithItsAxes) {
  const OrientedModulus<double> modulus{20e9, 1.4e9, 0.9e9, 4};
  const double half = 0.35;
  const Quaternion<double> turn{std::cos(half), (std::sin(half) / std::sqrt(14.0)) * V{1, 2, 3}};
  const GrainAxes<double> turned{rotate(turn, along_axes.longitudinal),
                                 rotate(turn, along_axes.radial)};
  const V n = direction(0.6, 1.9);
  EXPECT_NEAR(modulus_along(modulus, turned, rotate(turn, n)),
              modulus_along(modulus, along_axes, n), 1e-4);
}

}  // namespace solidem::oriented_modulus_test
