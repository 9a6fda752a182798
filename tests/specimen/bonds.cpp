// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/bonds.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "model/error.hpp"
#include "specimen/report.hpp"

namespace solidem {
namespace {

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
  EXPECT_DOUBLE_EQ(report.at("overlap_share"), 0.5);
  EXPECT_DOUBLE_EQ(report.at("fabric_x"), 1.0);
  EXPECT_DOUBLE_EQ(report.at("bulk_elements"), 0.0);
  EXPECT_NE(format_report(specimen).find("of the box around the spheres"), std::string::npos);
}

}  // namespace
}  // namespace solidem
