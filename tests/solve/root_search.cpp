// SPDX-License-Identifier: GPL-2.0-or-later
//
// Roots are found, and only where there are any, with few evaluations and none twice.
#include "solve/calibration/root_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "model/error.hpp"

namespace solidem::root_search_test {

TEST(RootSearch, OfALineTakesTwoEvaluationsWhenTheSlopeIsKnown) {
  const RootSearch search = find_root([](double x) { return 3 - 2 * x; }, {-10, 10}, 0, -2, 1e-12);
  ASSERT_TRUE(search.found);
  EXPECT_DOUBLE_EQ(search.best.at, 1.5);
  EXPECT_EQ(search.trials.size(), 2u);
}

TEST(RootSearch, FindsTheRootOfACurveFromAWrongSlope) {
  const auto curve = [](double x) { return std::exp(x) - 2; };
  for (const double slope : {-1.0, 0.0, 0.01, 1.0, 50.0})
    for (const double start : {-3.0, 0.0, 2.0}) {
      const RootSearch search = find_root(curve, {-3, 3}, start, slope, 1e-10);
      ASSERT_TRUE(search.found) << slope << " " << start;
      EXPECT_NEAR(search.best.at, std::log(2.0), 1e-10);
      EXPECT_LE(search.trials.size(), 25u) << slope << " " << start;
    }
}

TEST(RootSearch, StaysInTheRangeAndTriesNoPlaceTwice) {
  std::multiset<double> tried;
  const RootSearch search = find_root(
      [&](double x) {
        tried.insert(x);
        return x * x * x - 0.001;
      },
      {-1, 1}, 0.9, 2.4, 1e-9);
  ASSERT_TRUE(search.found);
  EXPECT_NEAR(search.best.at, 0.1, 1e-6);
  for (const double x : tried) {
    EXPECT_LE(std::abs(x), 1);
    EXPECT_EQ(tried.count(x), 1u);
  }
  EXPECT_EQ(tried.size(), search.trials.size());
}

TEST(RootSearch, FindsRootsOfACurveThatHasTheSameSignAtBothEnds) {
  const RootSearch search =
      find_root([](double x) { return x * x - 0.25; }, {-1, 1}, 1, 1e-6, 1e-10);
  ASSERT_TRUE(search.found);
  EXPECT_NEAR(std::abs(search.best.at), 0.5, 1e-9);
}

TEST(RootSearch, WithoutARootShowsBothEndsAndTheNearestTrial) {
  const RootSearch search =
      find_root([](double x) { return 2 + x; }, {-0.9, 0.5}, 0.5, -0.05, 1e-6);
  EXPECT_FALSE(search.found);
  EXPECT_EQ(search.best.at, -0.9);
  EXPECT_EQ(search.best.value, 1.1);
  int at_upper_end = 0;
  for (const RootTrial& trial : search.trials) at_upper_end += trial.at > 0.5 - 1e-9 ? 1 : 0;
  EXPECT_EQ(at_upper_end, 1);
}

TEST(RootSearch, RefusesAnEmptyRangeAndAStartOutside) {
  const auto line = [](double x) { return x; };
  EXPECT_THROW(find_root(line, {1, -1}, 0, 1, 1), InputError);
  EXPECT_THROW(find_root(line, {-1, 1}, 2, 1, 1), InputError);
}

}  // namespace solidem::root_search_test
