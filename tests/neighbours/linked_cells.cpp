// SPDX-License-Identifier: GPL-2.0-or-later
#include "neighbours/linked_cells.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>

namespace solidem::linked_cells_test {

struct Cloud {
  CellBox box;
  std::vector<Vector> position;
  std::vector<double> radius;
};

// Spheres thrown into a box (and, by `beyond`, a little outside it); radii from `smallest` to
// `largest`.
Cloud cloud(int elements, Vector size, std::array<bool, 3> periodic, double smallest,
            double largest, double beyond = 0.0) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-beyond, 1.0 + beyond);
  std::uniform_real_distribution<double> radius(smallest, largest);
  Cloud result;
  result.box = {{-1.0, 2.0, 0.5}, Vector{-1.0, 2.0, 0.5} + size, periodic};
  for (int i = 0; i < elements; ++i) {
    const Vector fraction{uniform(random), uniform(random), uniform(random)};
    result.position.push_back(
        result.box.lower + Vector{fraction.x * size.x, fraction.y * size.y, fraction.z * size.z});
    result.radius.push_back(radius(random));
  }
  return result;
}

std::vector<Pair> all_pairs(const Cloud& cloud, double tolerance) {
  std::vector<Pair> pairs;
  const Vector extent = cloud.box.upper - cloud.box.lower;
  for (std::size_t i = 0; i < cloud.position.size(); ++i)
    for (std::size_t j = i + 1; j < cloud.position.size(); ++j) {
      Vector d = cloud.position[j] - cloud.position[i];
      for (int axis = 0; axis < 3; ++axis)
        if (cloud.box.periodic[axis])
          component(d, axis) -= component(extent, axis) *
                                std::nearbyint(component(d, axis) / component(extent, axis));
      if (norm(d) <= (1.0 + tolerance) * (cloud.radius[i] + cloud.radius[j]))
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  return pairs;
}

void expect_all_pairs(const Cloud& c, double tolerance) {
  const std::vector<Pair> expected = all_pairs(c, tolerance);
  ASSERT_GT(expected.size(), 20u);
  EXPECT_EQ(neighbour_pairs(c.box, c.position, c.radius, tolerance), expected);
}

TEST(LinkedCells, FindWhatAllPairsFind) {
  expect_all_pairs(cloud(800, {1.0, 1.0, 1.0}, {false, false, false}, 0.03, 0.04), 0.0);
  expect_all_pairs(cloud(800, {1.0, 1.0, 1.0}, {false, false, false}, 0.03, 0.04), 0.3);
}

TEST(LinkedCells, FindNearestImagesInPeriodicBoxes) {
  expect_all_pairs(cloud(800, {1.0, 1.0, 1.0}, {true, true, true}, 0.03, 0.04), 0.1);
  expect_all_pairs(cloud(800, {2.0, 0.5, 1.0}, {false, true, false}, 0.03, 0.04), 0.1);
}

TEST(LinkedCells, WorkWhenAPeriodHoldsOneOrTwoOrThreeCells) {
  for (const double width : {0.17, 0.25, 0.33})
    expect_all_pairs(cloud(300, {1.0, width, width}, {true, true, true}, 0.03, 0.04), 0.0);
}

TEST(LinkedCells, WorkForRadiiOfRatioTwenty) {
  expect_all_pairs(cloud(1500, {1.0, 1.0, 1.0}, {true, false, true}, 0.005, 0.1), 0.05);
}

TEST(LinkedCells, WorkForFlatAndEmptyBoxesAndElementsOutside) {
  expect_all_pairs(cloud(400, {1.0, 1.0, 0.0}, {false, false, false}, 0.02, 0.03), 0.0);
  expect_all_pairs(cloud(400, {1.0, 1.0, 1.0}, {false, false, false}, 0.05, 0.06, 0.3), 0.0);
  expect_all_pairs(cloud(400, {1.0, 1.0, 1.0}, {true, true, true}, 0.05, 0.06, 0.7), 0.0);
  const Cloud none = cloud(0, {1.0, 1.0, 1.0}, {false, false, false}, 0.1, 0.2);
  EXPECT_TRUE(neighbour_pairs(none.box, none.position, none.radius, 0.0).empty());
}

TEST(LinkedCells, VisitEachCandidatePairOnce) {
  const Cloud c = cloud(500, {1.0, 1.0, 1.0}, {true, false, true}, 0.05, 0.06);
  LinkedCells cells(c.box, 0.15, c.position.size());
  cells.sort(c.position);
  std::vector<Pair> visited;
  cells.for_each_pair(0, cells.cell_count(),
                      [&](std::int32_t i, std::int32_t j, const Vector& chord) {
                        visited.push_back({std::min(i, j), std::max(i, j)});
                        const Vector direct = c.position[j] - c.position[i];
                        EXPECT_NEAR(chord.y, direct.y, 1e-15);
                        EXPECT_NEAR(std::remainder(chord.x - direct.x, 1.0), 0.0, 1e-14);
                        EXPECT_LE(std::abs(chord.x), 0.5 + 1e-15);
                      });
  std::sort(visited.begin(), visited.end());
  EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
}

TEST(LinkedCells, MemoryStaysInProportionToElements) {
  const LinkedCells cells({{0, 0, 0}, {1e6, 1e6, 1e6}, {false, false, false}}, 1e-3, 1000);
  EXPECT_LE(cells.cell_count(), 4u * 1000 + 64);
}

TEST(LinkedCells, TouchingSpheresAreNeighboursDespiteRoundOff) {
  const double third = 1.0 / 3.0;
  const std::vector<Vector> position{{0.1, 0, 0}, {0.1 + third, 0, 0}, {0.1 + 2 * third, 0, 0}};
  const std::vector<double> radius(3, third / 2);
  const CellBox box{{0, 0, 0}, {2, 1, 1}, {false, false, false}};
  EXPECT_EQ(neighbour_pairs(box, position, radius, 0.0).size(), 2u);
  EXPECT_EQ(neighbour_pairs(box, position, radius, -1e-9).size(), 0u);
}

TEST(LinkedCells, ThreadsDoNotChangeTheResult) {
  const Cloud c = cloud(12000, {1.0, 1.0, 1.0}, {true, false, true}, 0.01, 0.03);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<Pair> alone = neighbour_pairs(c.box, c.position, c.radius, 0.0);
  for (const int count : {2, 4}) {
    omp_set_num_threads(count);
    EXPECT_EQ(neighbour_pairs(c.box, c.position, c.radius, 0.0), alone);
  }
  omp_set_num_threads(threads);
}

}  // namespace solidem::linked_cells_test
