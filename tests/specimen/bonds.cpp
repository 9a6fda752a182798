// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/bonds.hpp"
#include "effects/beam_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "specimen/recipe.hpp"
#include "specimen/report.hpp"

namespace solidem::bonds_test {

// Spheres of radius 1 in a row at the given places.
Specimen row(const std::vector<double>& places) {
  Specimen specimen;
  for (const double x : places) {
    specimen.position.push_back({x, 0, 0});
    specimen.radius.push_back(1.0);
  }
  specimen.domain.lower = {-1, -1, -1};
  specimen.domain.upper = {30, 1, 1};
  specimen.domain.volume = 31 * 4;
  return specimen;
}

TEST(Bonds, ToleranceDecides) {
  Specimen specimen = row({0, 2.0, 4.1, 6.5});
  EXPECT_EQ(find_bonds(specimen, 0.0), (std::vector<Pair>{{0, 1}}));
  EXPECT_EQ(find_bonds(specimen, 0.06), (std::vector<Pair>{{0, 1}, {1, 2}}));
  EXPECT_EQ(find_bonds(specimen, 0.21), (std::vector<Pair>{{0, 1}, {1, 2}, {2, 3}}));
  make_bonds(specimen, 0.06);
  EXPECT_EQ(specimen.bond_tolerance, 0.06);
  EXPECT_EQ(count_bonds(specimen), (std::vector<std::int32_t>{1, 2, 1, 0}));
}

TEST(Bonds, CrossPeriodicFaces) {
  Specimen specimen = row({0, 15, 29.5});
  EXPECT_TRUE(find_bonds(specimen, 0.0).empty());
  specimen.domain.periodic = {true, false, false};
  EXPECT_EQ(find_bonds(specimen, 0.0), (std::vector<Pair>{{0, 2}}));
  EXPECT_DOUBLE_EQ(rest_chord(specimen, {0, 2}).x, -1.5);
}

TEST(Bonds, RefuseTolerancesThatAreNone) {
  EXPECT_THROW(find_bonds(row({0, 2}), -1.0), InputError);
  EXPECT_THROW(find_bonds(row({0, 2}), std::numeric_limits<double>::quiet_NaN()), InputError);
}

TEST(Fibres, JoinAlignedPairsBeyondContactAndWithinReach) {
  // From element 0: 2 (bonded), 4 along x, 8.1 along x, and 3.9 at an angle of cosine 0.77.
  Specimen specimen = row({0, 2, 4, 8.1});
  specimen.position.push_back({3.0, 2.5, 0});
  specimen.radius.push_back(1.0);
  make_bonds(specimen, 0.0);
  const std::vector<Pair> bonds = specimen.bonds;
  EXPECT_EQ(bonds, (std::vector<Pair>{{0, 1}, {1, 2}}));
  const FibreRule rule;
  EXPECT_EQ(find_fibres(specimen, rule), (std::vector<Pair>{{0, 2}}));
  FibreRule wide = rule;
  wide.alignment = 0.7;
  EXPECT_EQ(find_fibres(specimen, wide), (std::vector<Pair>{{0, 2}, {0, 4}}));
  FibreRule across = rule;
  across.direction = {0, 1, 0};
  across.alignment = 0.9;
  EXPECT_EQ(find_fibres(specimen, across), (std::vector<Pair>{{1, 4}, {2, 4}}));
  FibreRule far = rule;
  far.reach = 2.06;
  EXPECT_EQ(find_fibres(specimen, far), (std::vector<Pair>{{0, 2}, {2, 3}}));
}

TEST(Fibres, AreOrdinaryBondsKnownByTheirLength) {
  Specimen specimen = row({0, 2, 4});
  make_bonds(specimen, 0.0);
  add_fibres(specimen, {});
  add_fibres(specimen, {});  // changes nothing
  EXPECT_EQ(specimen.bonds, (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_FALSE(is_fibre(specimen, {0, 1}));
  EXPECT_TRUE(is_fibre(specimen, {0, 2}));
}

TEST(Fibres, LieAlongTheirDirectionInAPacking) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {1e-3, 1e-3, 1e-3};
  recipe.elements = 300;
  recipe.periodic = {true, true, true};
  Specimen specimen = make_specimen(recipe);
  const std::size_t contacts = specimen.bonds.size();
  const double c = std::sqrt(0.5);
  add_fibres(specimen, {{c, 0, c}, 2, 0.94});
  std::size_t fibres = 0;
  for (const Pair& pair : specimen.bonds) {
    if (!is_fibre(specimen, pair)) continue;
    ++fibres;
    const Vector chord = rest_chord(specimen, pair);
    EXPECT_GT(std::abs(c * (chord.x + chord.z)), 0.94 * norm(chord));
    EXPECT_LE(norm(chord), 2 * (specimen.radius[pair.i] + specimen.radius[pair.j]));
  }
  EXPECT_EQ(specimen.bonds.size(), contacts + fibres);
  EXPECT_GT(fibres, 100u);
}

TEST(Fibres, RefuseWhatCannotBe) {
  Specimen specimen = row({0, 2, 4});
  EXPECT_THROW(find_fibres(specimen, {}), InputError);  // the tolerance is not known
  make_bonds(specimen, 0.3);
  FibreRule short_reach;
  short_reach.reach = 1.3;
  EXPECT_THROW(find_fibres(specimen, short_reach), InputError);
  specimen.domain.upper.x = 7;  // the image of every element is within reach
  specimen.domain.periodic = {true, false, false};
  EXPECT_THROW(find_fibres(specimen, {}), InputError);
}

TEST(Bonds, LargestComponentLeavesRattlersAndIslandsOut) {
  Specimen specimen = row({0, 2, 20, 5, 7, 9, 22});
  make_bonds(specimen, 0.0);
  EXPECT_EQ(largest_component(specimen), (std::vector<std::int32_t>{3, 4, 5}));
  specimen.bonds.clear();
  EXPECT_EQ(largest_component(specimen), (std::vector<std::int32_t>{0}));
  EXPECT_TRUE(largest_component(Specimen{}).empty());
}

TEST(Report, CountsWhatIsThere) {
  Specimen specimen = row({0, 1.98, 3.97, 25});
  make_bonds(specimen, 0.0);
  measure_specimen(specimen);
  const auto& report = specimen.report;
  EXPECT_DOUBLE_EQ(report.at("coordination_number"), 1.0);
  EXPECT_DOUBLE_EQ(report.at("rattlers"), 1.0);
  EXPECT_DOUBLE_EQ(report.at("largest_component"), 3.0);
  EXPECT_NEAR(report.at("max_overlap"), 0.01, 1e-12);
  EXPECT_NEAR(report.at("mean_overlap"), 0.0075, 1e-12);
  EXPECT_DOUBLE_EQ(report.at("overlap_fraction"), 0.5);
  EXPECT_DOUBLE_EQ(report.at("fabric_x"), 1.0);
  EXPECT_DOUBLE_EQ(report.at("bulk_elements"), 0.0);
  EXPECT_NE(format_report(specimen).find("walls are not known"), std::string::npos);
}

}  // namespace solidem::bonds_test
