// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/nearest_name.hpp"

#include <gtest/gtest.h>

namespace solidem::nearest_name_test {

TEST(NearestName, DistanceIsAMetricOnWords) {
  EXPECT_EQ(edit_distance("beams", "beams"), 0U);
  EXPECT_EQ(edit_distance("beam", "beams"), 1U);
  EXPECT_EQ(edit_distance("baems", "beams"), 1U);  // neighbours swapped
  EXPECT_EQ(edit_distance("BEAMS", "beams"), 0U);
  EXPECT_EQ(edit_distance("", "beams"), 5U);
  EXPECT_EQ(edit_distance("run", "beams"), edit_distance("beams", "run"));
}

TEST(NearestName, FindsSlipsAndAbbreviationsOnly) {
  const std::vector<std::string> names = {"young_modulus", "shear_modulus", "radius_ratio"};
  EXPECT_EQ(nearest_name("yuong_modulus", names), "young_modulus");
  EXPECT_EQ(nearest_name("shear", names), "shear_modulus");
  EXPECT_EQ(nearest_name("Radius_Ratio", names), "radius_ratio");
  EXPECT_EQ(nearest_name("temperature", names), "");
  EXPECT_EQ(nearest_name("", names), "");
}

}  // namespace solidem::nearest_name_test
