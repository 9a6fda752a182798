// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/time_function.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidem::time_function_test {

const TimeFunction ramp{{1.0, 3.0, 4.0}, {2.0, 6.0, 0.0}, 0, 0, 0};
const TimeFunction wave{{0.0}, {0.5}, 2.0, 3.0, 0.7};

TEST(TimeFunction, holds_its_ends_and_is_linear_between) {
  EXPECT_EQ(ramp(0), 2);
  EXPECT_EQ(ramp(2), 4);
  EXPECT_EQ(ramp(3.5), 3);
  EXPECT_EQ(ramp(9), 0);
}

TEST(TimeFunction, integral_is_exact) {
  EXPECT_DOUBLE_EQ(ramp.integral(0.5), 1);
  EXPECT_DOUBLE_EQ(ramp.integral(2), 2 + 3);
  EXPECT_DOUBLE_EQ(ramp.integral(10), 2 + 8 + 3);
  EXPECT_DOUBLE_EQ(TimeFunction::constant(3).integral(7), 21);
}

TEST(TimeFunction, rate_and_value_are_derivatives) {
  const double h = 1e-6;
  for (const TimeFunction& f : {ramp, wave})
    for (const double t : {0.4, 1.7, 3.2, 5.0}) {
      EXPECT_NEAR((f.integral(t + h) - f.integral(t - h)) / (2 * h), f(t), 1e-8);
      EXPECT_NEAR((f(t + h) - f(t - h)) / (2 * h), f.rate(t), 1e-7);
    }
}

}  // namespace solidem::time_function_test
