// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/slots.hpp"

#include <gtest/gtest.h>

#include <map>

namespace solidem::slots_test {

const std::vector<Pair> bonds = {{0, 1}, {0, 9}, {1, 2}, {1, 9}, {3, 10}, {8, 9}};

TEST(Slots, every_bond_has_one_slot_on_either_side) {
  const Slots slots(11, bonds);
  std::map<std::pair<int, int>, int> seen;
  slots.for_each([&](std::int32_t i, std::int32_t j, std::size_t, int) { ++seen[{i, j}]; });
  EXPECT_EQ(seen.size(), 2 * bonds.size());
  for (const Pair& bond : bonds) {
    EXPECT_EQ((seen[{bond.i, bond.j}]), 1);
    EXPECT_EQ((seen[{bond.j, bond.i}]), 1);
  }
  EXPECT_EQ(slots.pairs(), bonds);
  EXPECT_EQ(slots.coordination(), (std::vector<int>{2, 3, 1, 1, 0, 0, 0, 0, 1, 3, 1}));
}

TEST(Slots, a_block_has_as_many_rows_as_its_best_connected_element) {
  const Slots slots(11, bonds);
  ASSERT_EQ(slots.blocks(), 2u);
  EXPECT_EQ(slots.first_row()[1], 3u);
  EXPECT_EQ(slots.first_row()[2], 6u);
}

TEST(Slots, spare_slots_point_to_their_own_element) {
  const Slots slots(11, bonds);
  EXPECT_EQ(slots.neighbours()[2 * lanes + 5], 5);
  EXPECT_EQ(slots.neighbours()[3 * lanes + 7], 15);  // fills up the last block
}

TEST(Slots, neighbours_come_in_increasing_order) {
  const Slots slots(11, bonds);
  std::vector<int> of_nine;
  slots.for_each([&](std::int32_t i, std::int32_t j, std::size_t, int) {
    if (i == 9) of_nine.push_back(j);
  });
  EXPECT_EQ(of_nine, (std::vector<int>{0, 1, 8}));
}

}  // namespace solidem::slots_test
