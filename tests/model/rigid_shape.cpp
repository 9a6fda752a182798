// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/rigid_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/meshes.hpp"

namespace solidem::rigid_shape_test {

std::vector<SurfacePoint> touching(const RigidShape& shape, const Vector& centre, double radius) {
  std::vector<SurfacePoint> found;
  NearFacets near;
  shape.find_touching(centre, radius, near, found);
  return found;
}

Vector somewhere(std::mt19937& random, double half) {
  std::uniform_real_distribution<double> place(-half, half);
  const double x = place(random), y = place(random), z = place(random);
  return {x, y, z};
}

void expect_near(const Vector& a, const Vector& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// From the surface along the normal by the distance is the point itself.
void expect_consistent(const SurfacePoint& place, const Vector& point) {
  EXPECT_NEAR(norm(place.normal), 1, 1e-14);
  expect_near(place.position + place.distance * place.normal, point, 1e-13);
}

TEST(RigidShape, EachPlaceIsAsFarAsItSaysOutsideAndInside) {
  const auto box = box_shape({2, 1, 0.6}), ball = ball_shape(0.7), plane = plane_shape(),
             cylinder = cylinder_shape(0.5, 1.2);
  const auto mesh = mesh_shape(test::ball_mesh(0.8, 2));
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    const Vector p = somewhere(random, 1.5);
    for (const RigidShape* shape : {box.get(), ball.get(), plane.get(), cylinder.get(), mesh.get()})
      for (const SurfacePoint& place : touching(*shape, p, 5)) expect_consistent(place, p);
  }
}

TEST(RigidShape, ABoxOfFacetsIsTouchedWhereTheBoxIsAtFacesEdgesAndCorners) {
  const Vector size{2, 1, 0.6};
  const auto box = box_shape(size), mesh = mesh_shape(test::box_mesh(-0.5 * size, 0.5 * size));
  std::mt19937 random(2);
  int outside = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vector p = somewhere(random, 1.4);
    const auto exact = touching(*box, p, 0.5), found = touching(*mesh, p, 0.5);
    ASSERT_EQ(found.size(), exact.size()) << p.x << " " << p.y << " " << p.z;
    if (exact.empty()) continue;
    EXPECT_NEAR(found[0].distance, exact[0].distance, 1e-14);
    expect_near(found[0].normal, exact[0].normal, 1e-13);
    outside += exact[0].distance > 0 ? 1 : 0;
  }
  EXPECT_GT(outside, 3000);
}

TEST(RigidShape, ACylinderIsTouchedAtItsSideItsEndsAndItsRims) {
  const auto cylinder = cylinder_shape(2, 6);
  const auto one = [&](const Vector& centre) { return touching(*cylinder, centre, 1).at(0); };
  expect_near(one({2.5, 0, 1}).normal, {1, 0, 0}, 1e-15);
  expect_near(one({0, 1, -3.5}).normal, {0, 0, -1}, 1e-15);
  const SurfacePoint rim = one({0, 2.3, 3.4});
  EXPECT_NEAR(rim.distance, 0.5, 1e-15);
  expect_near(rim.normal, {0, 0.6, 0.8}, 1e-14);
  EXPECT_NEAR(one({0, 1.9, 0}).distance, -0.1, 1e-15);
}

TEST(RigidShape, ABallThatPassesOverCoplanarEdgesFeelsOnePlane) {
  const auto sheet = mesh_shape(test::sheet_mesh(10, 20)), plane = plane_shape();
  // Along edges, across them, over vertices, and anywhere.
  for (int k = 0; k <= 4000; ++k) {
    const double s = -4 + 0.002 * k;
    for (const Vector& p : {Vector{s, 0, 0.9}, Vector{s, s, 0.9}, Vector{0.25, s, 0.9},
                            Vector{s, 0.123, 0.9}, Vector{s, -0.5 + 1e-13, 0.9}}) {
      const auto found = touching(*sheet, p, 1);
      ASSERT_EQ(found.size(), 1U) << p.x << " " << p.y;
      EXPECT_NEAR(found[0].distance, 0.9, 1e-15);
      expect_near(found[0].normal, {0, 0, 1}, 1e-15);
    }
  }
}

TEST(RigidShape, CoplanarFacetsThatStandAskewAreOnePlaneAsWell) {
  // Vertices rounded to doubles leave facets that are coplanar to round-off alone.
  TriangleMesh sheet = test::sheet_mesh(10, 20);
  const double a = 0.7, c = std::cos(a), s = std::sin(a);
  for (Vector& v : sheet.vertices) v = {v.x, c * v.y, s * v.y + 3};
  const auto shape = mesh_shape(sheet);
  const Vector normal{0, -s, c};
  std::mt19937 random(3);
  for (int k = 0; k < 5000; ++k) {
    Vector p = somewhere(random, 4);
    if (k % 2 == 0) p.x = 0.5 * std::round(2 * p.x);
    if (k % 3 == 0) p.y = 0.5 * std::round(2 * p.y);
    const Vector centre = Vector{p.x, c * p.y, s * p.y + 3} + 0.8 * normal;
    const auto found = touching(*shape, centre, 1);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].distance, 0.8, 1e-14);
    expect_near(found[0].normal, normal, 1e-14);
  }
}

TEST(RigidShape, InAHollowCornerABallTouchesEachFaceAndNoEdge) {
  // Three squares that meet in the origin, seen from where all coordinates are positive.
  TriangleMesh corner;
  corner.vertices = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 9}, {9, 0, 9}, {0, 9, 9}};
  corner.facets = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {1, 4, 5}, {0, 3, 4}, {3, 6, 4}};
  ASSERT_EQ(fault_of(corner), "");
  const auto shape = mesh_shape(corner);
  const auto found = touching(*shape, {0.9, 0.8, 0.7}, 1);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].distance, 0.7, 1e-15);
  EXPECT_NEAR(found[1].distance, 0.8, 1e-15);
  EXPECT_NEAR(found[2].distance, 0.9, 1e-15);
  EXPECT_EQ(touching(*shape, {0.9, 5, 3}, 1).size(), 1U);
  EXPECT_EQ(touching(*shape, {0.9, 0.9, 3}, 1).size(), 2U);
}

TEST(RigidShape, AShallowHollowOfFacetsIsOneContactThatNeverJumps) {
  // The inside of a pipe of 60 facets around: six degrees between neighbours.
  TriangleMesh pipe;
  constexpr int around = 60;
  for (int k = 0; k < around; ++k)
    for (const double z : {-5.0, 5.0}) {
      const double angle = 6.283185307179586 * k / around;
      pipe.vertices.push_back({3 * std::cos(angle), 3 * std::sin(angle), z});
    }
  for (std::int32_t k = 0; k < around; ++k) {
    const std::int32_t a = 2 * k, b = 2 * ((k + 1) % around);
    pipe.facets.push_back({a, a + 1, b});
    pipe.facets.push_back({b, a + 1, b + 1});
  }
  const auto shape = mesh_shape(pipe);
  double last = -1;
  for (int k = 0; k <= 5000; ++k) {
    const double angle = 1e-3 * k, reach = 2.02;
    const auto found = touching(*shape, {reach * std::cos(angle), reach * std::sin(angle), 0.3}, 1);
    ASSERT_EQ(found.size(), 1U);
    if (last < 0) last = found[0].distance;
    EXPECT_NEAR(found[0].distance, last, 2e-4);
    last = found[0].distance;
  }
}

TEST(RigidShape, APlateThinnerThanABallIsFeltFromTheSideTheBallIsOn) {
  const auto plate = mesh_shape(test::box_mesh({-5, -5, -0.05}, {5, 5, 0.05}));
  const auto above = touching(*plate, {0.3, 0.1, 0.9}, 1);
  ASSERT_EQ(above.size(), 1U);
  expect_near(above[0].normal, {0, 0, 1}, 1e-15);
  EXPECT_NEAR(above[0].distance, 0.85, 1e-15);
  const auto below = touching(*plate, {0.3, 0.1, -0.9}, 1);
  ASSERT_EQ(below.size(), 1U);
  expect_near(below[0].normal, {0, 0, -1}, 1e-15);
}

TEST(RigidShape, AnOpenSheetIsFeltFromBothSides) {
  const auto sheet = mesh_shape(test::sheet_mesh(10, 4));
  for (const double side : {1.0, -1.0}) {
    const auto found = touching(*sheet, {0.3, 0.1, 0.9 * side}, 1);
    ASSERT_EQ(found.size(), 1U);
    expect_near(found[0].normal, {0, 0, side}, 1e-15);
    EXPECT_NEAR(found[0].distance, 0.9, 1e-15);
  }
}

TEST(RigidShape, ABallThatLeavesAMeshAtItsEdgeRollsOverIt) {
  const auto sheet = mesh_shape(test::sheet_mesh(10, 4));
  const auto at = [&](double x) { return touching(*sheet, {x, 0.2, 0.8}, 1); };
  EXPECT_EQ(at(4.9).size(), 1U);
  ASSERT_EQ(at(5.4).size(), 1U);
  expect_near(at(5.4)[0].position, {5, 0.2, 0}, 1e-15);
  EXPECT_NEAR(at(5.4)[0].distance, std::sqrt(0.4 * 0.4 + 0.8 * 0.8), 1e-15);
  EXPECT_TRUE(at(5.7).empty());
}

TEST(RigidShape, WhatAWanderingBallKnowsOfAMeshChangesNothingThatItFinds) {
  const auto mesh = mesh_shape(test::ball_mesh(0.8, 3));
  std::mt19937 random(7);
  const double radius = 0.15;
  NearFacets near;
  Vector centre{0.94, 0, 0};
  std::size_t touched = 0;
  for (int step = 0; step < 20000; ++step) {
    // Small steps about the surface, now and then a leap.
    centre += (step % 500 == 0 ? 30 : 1) * somewhere(random, 0.002);
    centre = (0.94 / norm(centre)) * centre + somewhere(random, 0.01);
    std::vector<SurfacePoint> found;
    mesh->find_touching(centre, radius, near, found);
    const auto afresh = touching(*mesh, centre, radius);
    ASSERT_EQ(found.size(), afresh.size()) << "step " << step;
    for (std::size_t k = 0; k < found.size(); ++k) {
      ASSERT_EQ(found[k].distance, afresh[k].distance) << "step " << step;
      ASSERT_EQ(norm(found[k].normal - afresh[k].normal), 0) << "step " << step;
    }
    touched += found.size();
  }
  EXPECT_GT(touched, 5000U);
}

TEST(RigidShape, WhatIsDrawnOfASolidEnclosesItsVolume) {
  EXPECT_NEAR(volume(box_shape({2, 1, 0.5})->drawn(1)), 1, 1e-15);
  EXPECT_NEAR(volume(ball_shape(1)->drawn(1)) / 4.18879, 1, 0.01);
  EXPECT_NEAR(volume(cylinder_shape(1, 2)->drawn(1)) / 6.28319, 1, 0.01);
  for (const auto& mesh : {box_shape({2, 1, 0.5})->drawn(1), ball_shape(1)->drawn(1),
                           cylinder_shape(1, 2)->drawn(1), plane_shape()->drawn(1)})
    EXPECT_EQ(fault_of(mesh), "");
}

}  // namespace solidem::rigid_shape_test
