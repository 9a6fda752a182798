// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/platonic_conduction.hpp"

#include <gtest/gtest.h>

#include "laws/heat_exchange.hpp"

namespace solidem::platonic_conduction_test {

struct Row {
  int neighbours;
  double face_area, volume_fraction;
};

/// Terreros 2013, table 2.1.
const Row table_2_1[] = {
    {1, 19.98076, .08502}, {2, 16.78460, .17004}, {3, 13.58845, .25506}, {4, 10.39230, .34008},
    {5, 7.19615, .43184},  {6, 4.0, .52359},      {7, 3.29903, .60188},  {8, 2.59807, .68017},
    {9, 2.29545, .69525},  {10, 1.99282, .71032}, {11, 1.69019, .72540}, {12, 1.38757, .74048},
    {13, 1.30888, .75555}, {14, 1.23020, .77063}, {15, 1.15152, .78570}, {16, 1.07284, .80078},
    {17, .99415, .81586},  {18, .91547, .83093},  {19, .83679, .84601},  {20, .75810, .86109}};

TEST(PlatonicConduction, gives_table_2_1) {
  for (const Row& row : table_2_1) {
    EXPECT_NEAR(platonic_face_area(row.neighbours), row.face_area, 2e-5) << row.neighbours;
    EXPECT_NEAR(platonic_volume_fraction(row.neighbours), row.volume_fraction, 2e-5)
        << row.neighbours;
  }
}

TEST(PlatonicConduction, simple_cubic_is_a_cube_of_the_continuum) {
  const double R = 1e-4, lambda = 134;
  const PlatonicElement element{R, 6};
  // A cube of side 2R: face 4R² over distance 2R, mass of 8R³.
  EXPECT_NEAR(path_conductance(lambda, platonic_transmission_area(element, element), 2 * R),
              lambda * 2 * R, 1e-15 * lambda * R * 10);
  EXPECT_NEAR(platonic_heat_capacity(element, 2790, 880) / (2790 * 880.0 * 8 * R * R * R), 1,
              1e-15);
}

TEST(PlatonicConduction, both_sides_exchange_the_same_heat) {
  const PlatonicElement a{1e-4, 5}, b{1.2e-4, 9};
  EXPECT_EQ(platonic_transmission_area(a, b), platonic_transmission_area(b, a));
}

TEST(PlatonicConduction, stays_positive_beyond_the_table) {
  for (int n = 1; n < 100; ++n) {
    EXPECT_GT(platonic_face_area(n), 0);
    EXPECT_LE(platonic_volume_fraction(n), 1);
  }
}

}  // namespace solidem::platonic_conduction_test
