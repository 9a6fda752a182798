// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/triangle_mesh.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/meshes.hpp"

namespace solidem::triangle_mesh_test {

TriangleMesh unit_box() {
  return test::box_mesh({0, 0, 0}, {1, 1, 1});
}

TEST(TriangleMesh, ABoxHasItsVolumeAndItsCentreWhereverItStands) {
  const Vector lower{1000, -2, 3}, upper{1002, 1, 3.5};
  const TriangleMesh box = test::box_mesh(lower, upper);
  EXPECT_EQ(fault_of(box), "");
  EXPECT_EQ(gap_of(box), "");
  EXPECT_NEAR(volume(box), 3, 1e-12);
  const Vector centre = centre_of_volume(box);
  EXPECT_NEAR(centre.x, 1001, 1e-9);
  EXPECT_NEAR(centre.y, -0.5, 1e-12);
  EXPECT_NEAR(centre.z, 3.25, 1e-12);
}

TEST(TriangleMesh, FacetsOfABallSumToItsVolumeAsTheyAreSplit) {
  const double exact = 4.0 / 3 * 3.14159265358979;
  const double coarse = exact - volume(test::ball_mesh(1, 3));
  const double fine = exact - volume(test::ball_mesh(1, 4));
  EXPECT_NEAR(coarse / fine, 4, 0.05);
}

TEST(TriangleMesh, AMissingFacetIsAGapBesideItsNeighbour) {
  TriangleMesh box = unit_box();
  box.facets.pop_back();
  EXPECT_EQ(fault_of(box), "");
  EXPECT_FALSE(is_closed(box));
  EXPECT_EQ(gap_of(box),
            "is not closed: facet 4 has no neighbour at the side between (1, 0, 1) and (1, 1, 1) "
            "(3 open sides in all)");
}

TEST(TriangleMesh, AnInvertedFacetIsTold) {
  TriangleMesh box = unit_box();
  std::swap(box.facets[6][0], box.facets[6][1]);
  EXPECT_NE(fault_of(box).find("facets 2 and 7 are turned against each other"), std::string::npos)
      << fault_of(box);
}

TEST(TriangleMesh, ABodyInsideOutIsTold) {
  TriangleMesh box = unit_box();
  for (Facet& facet : box.facets) std::swap(facet[0], facet[1]);
  EXPECT_NE(fault_of(box).find("all facets are inverted"), std::string::npos);
}

TEST(TriangleMesh, AFacetWithoutAreaIsTold) {
  TriangleMesh box = unit_box();
  box.facets[4] = {0, 1, 1};
  EXPECT_EQ(fault_of(box), "facet 5 has no area (at (0, 0, 0))");
  TriangleMesh line;
  line.vertices = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  line.facets = {{0, 1, 2}};
  EXPECT_EQ(fault_of(line), "facet 1 has no area (at (0, 0, 0))");
}

TEST(TriangleMesh, AFacetThatStandsTwiceIsTold) {
  TriangleMesh box = unit_box();
  box.facets.push_back({5, 4, 6});
  EXPECT_EQ(fault_of(box), "facet 13 stands twice: it has the corners of facet 3");
}

TEST(TriangleMesh, ThreeFacetsAtOneSideAreTold) {
  TriangleMesh box = unit_box();
  box.vertices.push_back({2, 2, 2});
  box.facets.push_back({0, 1, 8});
  EXPECT_NE(fault_of(box).find("facets 1, 5 and 13 share the side between (0, 0, 0) and (1, 0, 0)"),
            std::string::npos)
      << fault_of(box);
}

TEST(TriangleMesh, CornersThatAreNowhereAreTold) {
  TriangleMesh box = unit_box();
  box.facets[1] = {0, 1, 9};
  EXPECT_EQ(fault_of(box), "facet 2 has the corner 10, but there are 8 vertices");
  box = unit_box();
  box.vertices[7].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of(box), "facet 4 has a corner that is nowhere (not finite)");
}

TEST(TriangleMesh, VerticesAtOnePlaceAreOne) {
  TriangleMesh soup;
  const TriangleMesh box = unit_box();
  for (const Facet& facet : box.facets) {
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    for (const std::int32_t corner : facet)
      soup.vertices.push_back(box.vertices[static_cast<std::size_t>(corner)]);
    soup.facets.push_back({first, first + 1, first + 2});
  }
  EXPECT_FALSE(is_closed(soup));
  const TriangleMesh joined = welded(soup);
  EXPECT_EQ(joined.vertices.size(), 8U);
  EXPECT_TRUE(is_closed(joined));
}

}  // namespace solidem::triangle_mesh_test
