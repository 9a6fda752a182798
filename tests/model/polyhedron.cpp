// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/polyhedron.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/shape.hpp"

namespace solidem::polyhedron_test {

/// A box from −1.5 to 1.5 cut into many solids by planes in all directions.
std::vector<Polyhedron> pieces(int planes) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Polyhedron> solids{box_between({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5})};
  for (int k = 0; k < planes; ++k) {
    Vector n{normal(random), normal(random), normal(random)};
    n = (1 / norm(n)) * n;
    const double offset = 0.4 * normal(random);
    std::vector<Polyhedron> cut;
    for (const Polyhedron& solid : solids)
      for (const Polyhedron& side : {clipped(solid, n, offset), clipped(solid, -n, -offset)})
        if (volume(side) > 0) cut.push_back(side);
    solids = cut;
  }
  return solids;
}

Shape::Part sphere_of(double radius, const Vector& offset = {}) {
  Shape::Part part;
  part.radius = radius;
  part.offset = offset;
  return part;
}

Shape::Part cylinder_of(double radius, int axis) {
  Shape::Part part;
  part.kind = Shape::Kind::cylinder;
  part.radius = radius;
  part.axis = axis;
  return part;
}

Shape::Part box_of(const Vector& size) {
  Shape::Part part;
  part.kind = Shape::Kind::box;
  part.size = size;
  return part;
}

Shape::Part cut_out(Shape::Part part) {
  part.is_cut_out = true;
  return part;
}

double sum_inside(const std::vector<Polyhedron>& solids, const Shape& shape,
                  const Vector& position = {}) {
  double sum = 0;
  for (const Polyhedron& solid : solids) sum += volume_inside(solid, shape, position);
  return sum;
}

TEST(Polyhedron, volumes_of_the_pieces_of_a_box_sum_to_the_box) {
  const std::vector<Polyhedron> solids = pieces(9);
  EXPECT_GT(solids.size(), 60u);
  double sum = 0;
  for (const Polyhedron& solid : solids) sum += volume(solid);
  EXPECT_NEAR(sum, 27, 1e-11);
}

TEST(Polyhedron, shares_of_any_pieces_sum_to_the_volume_of_the_shape) {
  const std::vector<Polyhedron> solids = pieces(9);
  for (const double radius : {1e-3, 0.05, 0.4, 1.0, 1.5})
    EXPECT_NEAR(sum_inside(solids, {{sphere_of(radius)}}) / (4 * pi / 3 * std::pow(radius, 3)), 1,
                1e-7)
        << radius;
  for (const int axis : {0, 1, 2})
    for (const double radius : {1e-3, 0.05, 0.4, 1.5})
      EXPECT_NEAR(sum_inside(solids, {{cylinder_of(radius, axis)}}) / (3 * pi * radius * radius), 1,
                  1e-7)
          << radius;
  for (const Vector& size : {Vector{1e-3, 1e-3, 1e-3}, Vector{2, 1e-3, 0.5}, Vector{3, 3, 3}})
    EXPECT_NEAR(sum_inside(solids, {{box_of(size)}}, {}) / (size.x * size.y * size.z), 1, 1e-9);
}

TEST(Polyhedron, a_ball_in_the_corner_of_a_box_is_an_eighth_and_across_a_face_a_cap) {
  const Polyhedron box = box_between({0, 0, 0}, {2, 2, 2});
  EXPECT_NEAR(volume_in_ball(box, {}, 1), pi / 6, 1e-14);
  EXPECT_NEAR(volume_in_ball(box, {0, 1, 1}, 1), 2 * pi / 3, 1e-14);
  // A cap of height h has the volume π h² (3 − h) / 3.
  EXPECT_NEAR(volume_in_ball(box, {-0.5, 1, 1}, 1), pi * 0.25 * 2.5 / 3, 1e-14);
  EXPECT_NEAR(volume_in_ball(box, {-1.5, 1, 1}, 1), 0, 1e-14);
  EXPECT_NEAR(volume_in_cylinder(box, {0, 1, 0}, 2, 1), pi, 1e-14);
  EXPECT_NEAR(volume_in_cylinder(box, {0, 0, 0}, 0, 1), pi / 2, 1e-14);
}

TEST(Polyhedron, a_ball_and_a_cylinder_are_cut_as_a_fine_grid_of_points_says) {
  const std::vector<Polyhedron> solids = pieces(4);
  const Vector centre{0.2, -0.1, 0.3};
  constexpr int n = 120;
  for (std::size_t k = 0; k < solids.size(); k += 3) {
    const auto [lower, upper] = bounds(solids[k]);
    const Vector cell = (1.0 / n) * (upper - lower);
    double ball = 0, cylinder = 0;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        for (int c = 0; c < n; ++c) {
          const Vector p =
              lower + Vector{(a + 0.5) * cell.x, (b + 0.5) * cell.y, (c + 0.5) * cell.z};
          bool inside = true;
          for (const std::vector<Vector>& face : solids[k].faces)
            inside = inside && dot(cross(face[1] - face[0], face[2] - face[0]), p - face[0]) <= 0;
          const Vector d = p - centre;
          const double weight = inside ? cell.x * cell.y * cell.z : 0;
          if (dot(d, d) < 0.81) ball += weight;
          if (d.x * d.x + d.z * d.z < 0.81) cylinder += weight;
        }
    const double tolerance = 1e-3 * (upper.x - lower.x) * (upper.y - lower.y) * (upper.z - lower.z);
    EXPECT_NEAR(volume_in_ball(solids[k], centre, 0.9), ball, tolerance);
    EXPECT_NEAR(volume_in_cylinder(solids[k], centre, 1, 0.9), cylinder, tolerance);
  }
}

TEST(Polyhedron, shapes_of_several_parts_hold_what_they_hold_together) {
  const std::vector<Polyhedron> solids = pieces(5);
  // A ring, a box with a round hole, two boxes that share a part, two balls that overlap.
  EXPECT_NEAR(sum_inside(solids, {{cylinder_of(1, 2), cut_out(cylinder_of(0.5, 2))}}),
              3 * pi * 0.75, 1e-3 * 3 * pi);
  EXPECT_NEAR(sum_inside(solids, {{box_of({2, 2, 2}), cut_out(cylinder_of(0.5, 0))}}),
              8 - 2 * pi * 0.25, 1e-3 * 8);
  Shape::Part moved = box_of({1, 1, 1});
  moved.offset = {0.5, 0.5, 0.5};
  EXPECT_NEAR(sum_inside(solids, {{box_of({1, 1, 1}), moved}}), 2 - 0.125, 1e-9);
  const double lens = pi / 12 * 5 * 1 / 1.0;  // of two unit balls whose centres are 1 apart
  EXPECT_NEAR(sum_inside(solids, {{sphere_of(1, {-0.5, 0, 0}), sphere_of(1, {0.5, 0, 0})}}),
              8 * pi / 3 - lens, 5e-3);
}

TEST(Polyhedron, a_gaussian_over_the_tiles_of_a_plane_is_whole) {
  const double w = 0.3;
  double sum = 0;
  constexpr int tiles = 13;
  for (int a = 0; a < tiles; ++a)
    for (int b = 0; b < tiles; ++b) {
      const double size = 3.0 / tiles, x = a * size - 1.5, y = b * size - 1.5;
      const std::vector<Vector> tile{
          {x, y, 0}, {x + size, y, 0}, {x + size, y + size, 0}, {x, y + size, 0}};
      sum += gaussian_over(tile, {0.07, -0.11, 0.4}, w);
    }
  EXPECT_NEAR(sum / (0.5 * pi * w * w * (1 - std::exp(-8))), 1, 1e-9);
  // Of a square between 0 and a from the centre: the error function squared.
  const double a = 0.2;
  const double root = std::sqrt(2.0) / w;
  const double exact = pi / 4 / (root * root) * std::pow(std::erf(root * a), 2);
  EXPECT_NEAR(gaussian_over({{0, 0, 0}, {a, 0, 0}, {a, a, 0}, {0, a, 0}}, {}, w) / exact, 1, 1e-9);
}

}  // namespace solidem::polyhedron_test
