// SPDX-License-Identifier: GPL-2.0-or-later
//
// The tables of pairs of a model: bonds that break and form, conductors beside them.
#include <gtest/gtest.h>

#include <stdexcept>

#include "model/model.hpp"

namespace solidem::pair_tables_test {

/// Five elements in a row, each bonded to the next.
Specimen row() {
  Specimen specimen;
  for (int i = 0; i < 5; ++i) specimen.position.push_back({1.0 * i, 0, 0});
  specimen.radius.assign(5, 0.5);
  specimen.bonds = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  return specimen;
}

TEST(PairTables, a_bond_breaks_and_forms_on_both_sides_at_once) {
  Model model(row());
  model.break_bond({1, 2}, 1);
  EXPECT_EQ(model.slots().pairs(), (std::vector<Pair>{{0, 1}, {2, 3}, {3, 4}}));
  EXPECT_TRUE(model.slots().is_symmetric());
  EXPECT_TRUE(model.make_bond({1, 4}, 2.5));
  EXPECT_EQ(model.slots().pairs(), (std::vector<Pair>{{0, 1}, {1, 4}, {2, 3}, {3, 4}}));
  EXPECT_TRUE(model.slots().is_symmetric());
}

TEST(PairTables, a_bond_finds_no_place_where_all_slots_are_taken) {
  Model model(row());
  EXPECT_FALSE(model.make_bond({1, 3}, 2));
  EXPECT_EQ(model.slots().pairs(), row().bonds);
  EXPECT_TRUE(model.bond_changes().empty());
}

TEST(PairTables, every_change_of_a_bond_is_told_in_order) {
  Model model(row());
  model.break_bond({1, 2}, 1);
  model.break_bond({2, 3}, 1.5);
  ASSERT_TRUE(model.make_bond({1, 2}, 0.75));
  const std::vector<BondChange>& told = model.bond_changes();
  ASSERT_EQ(told.size(), 3u);
  EXPECT_EQ(told[0].kind, BondChange::Kind::broken);
  EXPECT_EQ(told[0].pair, (Pair{1, 2}));
  EXPECT_EQ(told[1].pair, (Pair{2, 3}));
  EXPECT_EQ(told[1].length, 1.5);
  EXPECT_EQ(told[2].kind, BondChange::Kind::made);
  EXPECT_EQ(told[2].pair, (Pair{1, 2}));
  EXPECT_EQ(told[2].length, 0.75);
}

TEST(PairTables, conductors_of_their_own_outlast_the_bonds) {
  Model model(row(), row().bonds);
  model.add(columns::conductance);
  model.data(columns::conductance)[0] = 7;
  const std::uint64_t version = model.conductors_version();
  model.break_bond({1, 2}, 1);
  EXPECT_EQ(model.conductors().pairs(), row().bonds);
  EXPECT_EQ(model.data(columns::conductance)[0], 7);
  EXPECT_EQ(model.conductors_version(), version);
  const std::vector<Pair> more = {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {2, 3}, {3, 4}};
  model.replace_conductors(more);
  EXPECT_EQ(model.conductors().pairs(), more);
  EXPECT_GT(model.conductors_version(), version);
  EXPECT_EQ(model.size(columns::conductance), 4u * lanes);
  EXPECT_EQ(model.data(columns::conductance)[0], 0);
}

TEST(PairTables, conductors_that_are_the_bonds_take_no_memory_and_do_not_change_apart) {
  Model shared(row());
  const Model apart(row(), row().bonds);
  EXPECT_TRUE(shared.shares_conductors());
  EXPECT_EQ(&shared.conductors(), &shared.slots());
  EXPECT_LT(shared.bytes(), apart.bytes());
  EXPECT_THROW(shared.replace_conductors({{0, 2}}), std::logic_error);
  EXPECT_THROW(shared.touch_conductors(), std::logic_error);
}

}  // namespace solidem::pair_tables_test
