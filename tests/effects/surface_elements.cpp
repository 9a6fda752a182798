// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/surface_elements.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace solidem::surface_elements_test {

constexpr double degree = pi / 180;

/// Two unit vectors across another.
std::pair<Vector, Vector> across(const Vector& axis) {
  const Vector helper = std::fabs(axis.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const Vector first = (1 / norm(cross(axis, helper))) * cross(axis, helper);
  return {first, cross(axis, first)};
}

/// A ball among equal ones that touch it, in rings about an axis from `nearest` degrees on. Each
/// keeps a third one from touching within 60 degrees of it.
Specimen caged(const Vector& axis, double nearest) {
  Specimen specimen;
  specimen.position = {{0, 0, 0}};
  const auto [first, second] = across(axis);
  for (double polar = nearest; polar < 180; polar += 25)
    for (int k = 0; k < 24; ++k) {
      const double side = std::sin(polar * degree), turn = k * 15 * degree;
      specimen.position.push_back(2 * (std::cos(polar * degree) * axis +
                                       side * (std::cos(turn) * first + std::sin(turn) * second)));
    }
  specimen.radius.assign(specimen.position.size(), 1);
  for (std::size_t k = 1; k < specimen.position.size(); ++k)
    specimen.bonds.push_back({0, static_cast<std::int32_t>(k)});
  return specimen;
}

bool is_exposed(const Specimen& specimen) {
  const std::vector<std::int32_t> found = surface_elements(specimen, specimen.bonds);
  return std::binary_search(found.begin(), found.end(), 0);
}

TEST(SurfaceElements, AreFoundThroughTheNarrowestGap) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 20; ++n) {
    const Vector way{normal(random), normal(random), normal(random)};
    const Vector axis = (1 / norm(way)) * way;
    EXPECT_TRUE(is_exposed(caged(axis, 60.1)));
    EXPECT_FALSE(is_exposed(caged(axis, 59.9)));
  }
}

TEST(SurfaceElements, ArePressedByBodiesThatStandNearerThanAnElementIsLarge) {
  Specimen specimen = caged({0, 0, 1}, 59.9);
  EXPECT_FALSE(is_exposed(specimen));
  specimen.bonds.clear();
  EXPECT_TRUE(is_exposed(specimen));
}

}  // namespace solidem::surface_elements_test
