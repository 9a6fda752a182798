// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "laws/constants.hpp"
#include "model/error.hpp"
#include "specimen/bonds.hpp"
#include "specimen/recipe.hpp"

namespace solidem::crystals_test {

SpecimenRecipe crystal(const std::string& lattice, std::array<int, 3> cells, bool periodic) {
  SpecimenRecipe recipe;
  recipe.shape = "crystal";
  recipe.lattice = lattice;
  recipe.cells = cells;
  recipe.element_radius = 0.7e-3;
  recipe.periodic = {periodic, periodic, periodic};
  recipe.origin = {-1e-3, 2e-3, 5e-3};
  return recipe;
}

struct Expected {
  const char* lattice;
  std::array<int, 3> cells;
  int elements_per_cell;
  int neighbours;
  double fraction;
};

const Expected lattices[] = {
    {"simple_cubic", {4, 3, 5}, 1, 6, pi / 6},
    {"bcc", {3, 4, 3}, 2, 8, pi* std::sqrt(3.0) / 8},
    {"fcc", {3, 2, 4}, 4, 12, pi / std::sqrt(18.0)},
    {"hcp", {3, 2, 2}, 4, 12, pi / std::sqrt(18.0)},
};

TEST(Crystal, PeriodicOnesHaveTheLatticesExactNeighboursAndFraction) {
  for (const Expected& expected : lattices) {
    SCOPED_TRACE(expected.lattice);
    const Specimen specimen = make_specimen(crystal(expected.lattice, expected.cells, true));
    const std::size_t cells =
        static_cast<std::size_t>(expected.cells[0] * expected.cells[1] * expected.cells[2]);
    EXPECT_EQ(specimen.size(), cells * expected.elements_per_cell);
    for (const std::int32_t count : count_bonds(specimen)) EXPECT_EQ(count, expected.neighbours);
    EXPECT_NEAR(specimen.report.at("solid_fraction"), expected.fraction, 1e-14);
    for (const Pair& pair : specimen.bonds)
      EXPECT_NEAR(norm(rest_chord(specimen, pair)), 1.4e-3, 1e-15);
  }
}

TEST(Crystal, FabricOfCubicLatticesIsIsotropic) {
  for (const char* lattice : {"simple_cubic", "bcc", "fcc"}) {
    const Specimen specimen = make_specimen(crystal(lattice, {3, 3, 3}, true));
    for (const char* axis : {"fabric_x", "fabric_y", "fabric_z"})
      EXPECT_NEAR(specimen.report.at(axis), 1.0 / 3, 1e-14) << lattice;
  }
}

TEST(Crystal, FreeSimpleCubicHasGridBondsAndStaysInside) {
  const Specimen specimen = make_specimen(crystal("simple_cubic", {5, 4, 3}, false));
  EXPECT_EQ(specimen.bonds.size(), 4u * 4 * 3 + 5 * 3 * 3 + 5 * 4 * 2);
  const Domain& body = specimen.domain;
  EXPECT_NEAR(body.volume, 60 * std::pow(1.4e-3, 3), 1e-21);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    EXPECT_GE(p.x - body.lower.x, specimen.radius[i] * (1 - 1e-12));
    EXPECT_GE(body.upper.z - p.z, specimen.radius[i] * (1 - 1e-12));
  }
}

TEST(Crystal, RefusesWhatCannotBe) {
  EXPECT_THROW(make_specimen(crystal("diamond", {3, 3, 3}, false)), InputError);
  EXPECT_THROW(make_specimen(crystal("bcc", {3, 0, 3}, false)), InputError);
  SpecimenRecipe negative = crystal("bcc", {3, 3, 3}, false);
  negative.element_radius = -1;
  EXPECT_THROW(make_specimen(negative), InputError);
}

TEST(Crystal, RefusesPeriodsWithTwoImagesOfOneBond) {
  try {
    make_specimen(crystal("simple_cubic", {2, 5, 5}, true));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("periodic along x"), std::string::npos)
        << error.what();
  }
}

}  // namespace solidem::crystals_test
