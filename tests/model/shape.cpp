// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidem {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Sum of the shares of balls, centred on a fine lattice, times the lattice's cells.
double volume_by_balls(const Shape& shape, double ball_radius) {
  const double cell = 0.02, half = 1.5;
  const int cells = static_cast<int>(2 * half / cell);
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const Vector p{(i + 0.5) * cell - half, (j + 0.5) * cell - half, (k + 0.5) * cell - half};
        sum += fraction_inside(shape.signed_distance(p, ball_radius) / ball_radius);
      }
  return sum * cell * cell * cell;
}

TEST(Shape, shares_of_balls_sum_to_the_volume_of_a_sphere_and_a_cylinder) {
  Shape::Part sphere;
  sphere.radius = 1.0;
  EXPECT_NEAR(volume_by_balls({{sphere}}, 0.4), 4.0 / 3 * pi, 1e-4 * 4);
  Shape::Part cylinder;
  cylinder.kind = Shape::Kind::cylinder;
  cylinder.radius = 1.0;
  EXPECT_NEAR(volume_by_balls({{cylinder}}, 0.4), 3 * pi, 1e-4 * 9);
}

TEST(Shape, signed_distance_is_that_of_the_surface) {
  Shape::Part sphere, hole, box;
  sphere.radius = 1.0;
  hole.radius = 0.25;
  hole.is_cut_out = true;
  const Shape hollow{{sphere, hole}};
  EXPECT_DOUBLE_EQ(hollow.signed_distance({2, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(hollow.signed_distance({0.75, 0, 0}), -0.25);
  EXPECT_DOUBLE_EQ(hollow.signed_distance({0, 0, 0}), 0.25);
  box.kind = Shape::Kind::box;
  box.size = {2, 4, 6};
  EXPECT_DOUBLE_EQ(Shape{{box}}.signed_distance({4, 6, 0}), 5);
  EXPECT_DOUBLE_EQ(Shape{{box}}.signed_distance({0, 1.5, 0}), -0.5);
}

TEST(Shape, fraction_of_a_ball_is_that_of_a_cap) {
  EXPECT_EQ(fraction_inside(-1.5), 1);
  EXPECT_EQ(fraction_inside(1.5), 0);
  EXPECT_DOUBLE_EQ(fraction_inside(0), 0.5);
  for (const double x : {0.1, 0.6, 0.95})
    EXPECT_NEAR(fraction_inside(x) + fraction_inside(-x), 1, 1e-15);
  // A cap of height h has the volume π h² (3 − h) / 3.
  EXPECT_NEAR(fraction_inside(0.5), 0.25 * pi * 2.5 / 3 / (4.0 / 3 * pi), 1e-15);
}

}  // namespace
}  // namespace solidem
