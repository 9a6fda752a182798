// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/quench.hpp"

#include <gtest/gtest.h>

namespace solidem::quench_test {

Domain box(double side) {
  Domain domain;
  domain.shape = "box";
  domain.upper = {side, side, side};
  domain.volume = side * side * side;
  return domain;
}

TEST(SoftSpheres, that_coincide_are_pulled_apart) {
  // The force between the first two vanishes, so that nothing else would part them.
  SoftSpheres spheres(box(20), {{5, 5, 5}, {5, 5, 5}, {15, 15, 15}}, {1.0, 1.0, 1.0});
  spheres.relax(0.01, 100);
  EXPECT_LT(norm(spheres.position()[1] - spheres.position()[0]), 1e-9);
  EXPECT_EQ(spheres.separate_coinciding(), 1);
  EXPECT_EQ(spheres.separate_coinciding(), 0);
  spheres.relax(0.01, 1000);
  EXPECT_GT(norm(spheres.position()[1] - spheres.position()[0]), 1.9);
}

TEST(SoftSpheres, that_overlap_as_packings_do_are_left_alone) {
  SoftSpheres spheres(box(20), {{5, 5, 5}, {6, 5, 5}}, {1.0, 1.0});
  EXPECT_EQ(spheres.separate_coinciding(), 0);
}

}  // namespace solidem::quench_test
