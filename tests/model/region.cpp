// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/region.hpp"

#include <gtest/gtest.h>

#include "model/error.hpp"

namespace solidem::region_test {

Specimen row_of_five() {
  Specimen specimen;
  for (int k = 0; k < 5; ++k) {
    specimen.position.push_back({0.5 + k, 0.5, 0.5});
    specimen.radius.push_back(0.5);
  }
  specimen.domain.upper = {5, 1, 1};
  specimen.sets["middle"] = {2};
  return specimen;
}

using Elements = std::vector<std::int32_t>;

TEST(Region, face_takes_centres_within_its_depth) {
  Region region;
  region.kind = Region::Kind::face;
  region.high_side = true;
  region.depth = 1.6;
  EXPECT_EQ(select(region, row_of_five()), (Elements{3, 4}));
  region.layers = 1;
  EXPECT_EQ(select(region, row_of_five()), Elements{4});
}

TEST(Region, box_may_be_open) {
  Region region;
  region.kind = Region::Kind::box;
  region.lower.x = 2.5;
  EXPECT_EQ(select(region, row_of_five()), (Elements{2, 3, 4}));
}

TEST(Region, set_that_is_not_there_names_those_that_are) {
  Region region;
  region.kind = Region::Kind::set;
  region.set = "middle";
  EXPECT_EQ(select(region, row_of_five()), Elements{2});
  region.set = "midle";
  try {
    select(region, row_of_five());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("middle"), std::string::npos);
  }
}

TEST(Region, nearest_element_of_a_point) {
  const std::vector<std::int32_t> all = elements_of_the_body({0, 0, 0, 0, 0});
  EXPECT_EQ(all, (std::vector<std::int32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(nearest_element(row_of_five(), all, {3.2, 9, 0}), 3);
  const std::vector<std::int32_t> joined = elements_of_the_body({1, 2, 1, 0, 0});
  EXPECT_EQ(joined, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(nearest_element(row_of_five(), joined, {3.2, 9, 0}), 2);
}

TEST(Specimen, represented_mass_is_that_of_the_body) {
  Specimen specimen = row_of_five();
  specimen.radius = {.5, .4, .3, .5, .1};
  specimen.domain.volume = 5;
  double sum = 0;
  for (const double mass : represented_mass(specimen, {2790})) sum += mass;
  EXPECT_NEAR(sum / (2790 * 5), 1, 1e-15);
}

}  // namespace solidem::region_test
