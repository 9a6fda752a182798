// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/facet_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/meshes.hpp"

namespace solidem::facet_tree_test {

Vector somewhere(std::mt19937& random, double half) {
  std::uniform_real_distribution<double> place(-half, half);
  const double x = place(random), y = place(random), z = place(random);
  return {x, y, z};
}

/// Signed distance from a box of half sizes h about the origin.
double distance_from_box(const Vector& p, const Vector& h) {
  const Vector q{std::fabs(p.x) - h.x, std::fabs(p.y) - h.y, std::fabs(p.z) - h.z};
  const Vector out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
  return norm(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

TEST(FacetTree, DistanceFromABoxIsThatOfItsFormulaOnEverySide) {
  const Vector half{1, 0.5, 0.25};
  const FacetTree tree(test::box_mesh(-half, half));
  std::mt19937 random(1);
  for (int k = 0; k < 5000; ++k) {
    const Vector p = somewhere(random, 1.5);
    EXPECT_NEAR(tree.signed_distance(p), distance_from_box(p, half), 1e-14);
  }
}

TEST(FacetTree, FindsWhatASearchOfAllFacetsFinds) {
  const FacetTree tree(test::ball_mesh(1, 4));
  std::mt19937 random(2);
  for (int k = 0; k < 200; ++k) {
    const Vector p = somewhere(random, 2);
    double least = 1e9;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(tree.mesh().facets.size()); ++f)
      least = std::min(least, tree.closest_on(f, p).distance);
    EXPECT_EQ(tree.closest(p).distance, least);
    EXPECT_EQ(tree.closest(p, 0.99 * least).facet, -1);
  }
}

TEST(FacetTree, AllFacetsThatReachIntoABallAreVisitedOnce) {
  const FacetTree tree(test::ball_mesh(1, 4));
  std::mt19937 random(3);
  for (int k = 0; k < 50; ++k) {
    const Vector p = somewhere(random, 1.2);
    std::vector<int> visits(tree.mesh().facets.size(), 0);
    tree.for_each_near(p, 0.3, [&](std::int32_t f) { ++visits[static_cast<std::size_t>(f)]; });
    for (std::size_t f = 0; f < visits.size(); ++f) {
      EXPECT_LE(visits[f], 1);
      const bool reaches = tree.closest_on(static_cast<std::int32_t>(f), p).distance < 0.3;
      EXPECT_GE(visits[f], reaches ? 1 : 0);
    }
  }
}

TEST(FacetTree, InsideOfABallIsWhatIsNearerThanItsFacets) {
  const FacetTree tree(test::ball_mesh(1, 3));
  std::mt19937 random(4);
  for (int k = 0; k < 2000; ++k) {
    const Vector p = somewhere(random, 1.2);
    if (norm(p) > 0.96 && norm(p) < 1) continue;
    EXPECT_EQ(tree.contains(p), norm(p) < 1);
  }
}

/// An L: where the normals of the facets at an edge or a corner disagree on the side, the weighted
/// one is right.
TEST(FacetTree, TheSideIsRightAtEdgesAndCornersInwardAndOutward) {
  TriangleMesh notched;
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 0.3}, {0.3, 0.3}, {0.3, 2}, {0, 2}};
  for (const double z : {0.0, 0.2})
    for (const auto& p : outline) notched.vertices.push_back({p[0], p[1], z});
  const std::int32_t lid[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& [a, b, c] : lid) {
    notched.facets.push_back({a, c, b});
    notched.facets.push_back({a + 6, b + 6, c + 6});
  }
  for (std::int32_t k = 0; k < 6; ++k) {
    const std::int32_t next = (k + 1) % 6;
    notched.facets.push_back({k, next, next + 6});
    notched.facets.push_back({k, next + 6, k + 6});
  }
  ASSERT_EQ(fault_of(notched), "");
  ASSERT_TRUE(is_closed(notched));
  EXPECT_NEAR(volume(notched), (2 * 0.3 + 1.7 * 0.3) * 0.2, 1e-15);
  const FacetTree tree(notched);
  std::mt19937 random(5);
  for (int k = 0; k < 20000; ++k) {
    const Vector p = Vector{1, 1, 0.1} + somewhere(random, 1.2);
    const bool inside = p.x > 0 && p.y > 0 && p.z > 0 && p.z < 0.2 && p.x < 2 && p.y < 2 &&
                        (p.x < 0.3 || p.y < 0.3);
    EXPECT_EQ(tree.contains(p), inside) << p.x << " " << p.y << " " << p.z;
  }
}

}  // namespace solidem::facet_tree_test
