// SPDX-License-Identifier: GPL-2.0-or-later
//
// Figures of compact packings: coordination 6.2 at the solid fractions that earlier packings of
// this kind reached (0.620 at 1000 and 0.6225 at 5000 elements in a cube, 0.6405 in a periodic
// cell).
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>
#include <numeric>

#include "laws/constants.hpp"
#include "model/error.hpp"
#include "specimen/packing.hpp"
#include "specimen/quench.hpp"
#include "specimen/recipe.hpp"
#include "specimen/shape.hpp"

namespace solidem::packings_test {

SpecimenRecipe cube(std::int64_t elements) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {2e-3, 2e-3, 2e-3};
  recipe.elements = elements;
  return recipe;
}

void expect_isotropic(const Specimen& specimen, double tolerance) {
  for (const char* axis : {"fabric_x", "fabric_y", "fabric_z"})
    EXPECT_NEAR(specimen.report.at(axis), 1.0 / 3, tolerance) << axis;
}

void expect_exact_mass(const Specimen& specimen) {
  const double density = 2790;
  const std::vector<double> mass = represented_mass(specimen, {density});
  const double body = density * specimen.domain.volume;
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0), body, 1e-13 * body);
}

TEST(Packing, CubeOfThousand) {
  const Specimen specimen = make_specimen(cube(1000));
  ASSERT_EQ(specimen.size(), 1000u);
  EXPECT_NEAR(specimen.report.at("coordination_number"), 6.2, 0.03);
  EXPECT_GE(specimen.report.at("solid_fraction"), 0.618);
  EXPECT_LE(specimen.report.at("solid_fraction"), 0.63);
  EXPECT_GE(specimen.report.at("bulk_coordination_number"), 6.9);
  EXPECT_LE(specimen.report.at("mean_overlap"), 0.01);
  EXPECT_LE(specimen.report.at("rattlers"), 15);
  EXPECT_GE(specimen.report.at("largest_component"), 985);
  expect_isotropic(specimen, 0.015);
  expect_exact_mass(specimen);
}

TEST(Packing, CubeOfFiveThousand) {
  const Specimen specimen = make_specimen(cube(5000));
  EXPECT_NEAR(specimen.report.at("coordination_number"), 6.2, 0.03);
  EXPECT_GE(specimen.report.at("solid_fraction"), 0.6215);
  EXPECT_LE(specimen.report.at("mean_overlap"), 0.005);
  EXPECT_LE(specimen.report.at("rattlers"), 0.01 * 5000);
  expect_isotropic(specimen, 0.006);
}

TEST(Packing, PeriodicCell) {
  SpecimenRecipe recipe = cube(2000);
  recipe.periodic = {true, true, true};
  const Specimen specimen = make_specimen(recipe);
  EXPECT_NEAR(specimen.report.at("coordination_number"), 6.2, 0.1);
  EXPECT_NEAR(specimen.report.at("solid_fraction"), 0.6405, 0.004);
  EXPECT_EQ(specimen.report.at("bulk_elements"), 2000);
  EXPECT_LE(specimen.report.at("max_overlap"), 0.02);
  for (const Vector& p : specimen.position) {
    EXPECT_GE(p.x, 0.0);
    EXPECT_LE(p.x, 2e-3);
  }
}

TEST(Packing, RadiiAreUniformAboutTheirMean) {
  const Specimen specimen = make_specimen(cube(1000));
  const double mean = mean_radius(specimen);
  double sum2 = 0, smallest = 1, largest = 0;
  for (const double radius : specimen.radius) {
    sum2 += (radius - mean) * (radius - mean);
    smallest = std::min(smallest, radius);
    largest = std::max(largest, radius);
  }
  EXPECT_NEAR(smallest, 0.875 * mean, 1e-3 * mean);
  EXPECT_NEAR(largest, 1.125 * mean, 1e-3 * mean);
  EXPECT_NEAR(std::sqrt(sum2 / 1000), 0.125 / std::sqrt(3.0) * mean, 1e-4 * mean);
}

TEST(Packing, SpheresTouchWallsFromInside) {
  SpecimenRecipe recipe = cube(1000);
  recipe.shape = "plate";
  recipe.size = {5e-3, 3e-3, 2e-3};
  recipe.origin = {1e-3, -1.5e-3, 7e-3};
  const Specimen specimen = make_specimen(recipe);
  double overlap = 0;
  int touching = 0;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector low = specimen.position[i] - specimen.domain.lower;
    const Vector high = specimen.domain.upper - specimen.position[i];
    const double gap =
        std::min({low.x, low.y, low.z, high.x, high.y, high.z}) / specimen.radius[i] - 1;
    EXPECT_GT(gap, -0.15) << "element " << i;
    if (gap > 0) continue;
    ++touching;
    overlap -= gap;
  }
  EXPECT_GT(touching, 200);
  EXPECT_LT(overlap / touching, 0.04);
}

TEST(Packing, CylinderAlongEachAxis) {
  for (const char* axis : {"x", "y", "z"}) {
    SpecimenRecipe recipe;
    recipe.shape = "cylinder";
    recipe.axis = axis;
    recipe.length = 0.5e-3;
    recipe.radius = 0.2e-3;
    recipe.elements = 500;
    recipe.origin = {1e-3, 2e-3, 3e-3};
    const Specimen specimen = make_specimen(recipe);
    EXPECT_DOUBLE_EQ(specimen.domain.volume, pi * 0.04e-6 * 0.5e-3);
    EXPECT_NEAR(specimen.report.at("coordination_number"), 6.2, 0.1);
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      Vector p = specimen.position[i] - recipe.origin;
      double& along = *axis == 'x' ? p.x : *axis == 'y' ? p.y : p.z;
      const double reach = 0.85 * specimen.radius[i];
      EXPECT_GT(along, reach);
      EXPECT_LT(along, recipe.length - reach);
      along = 0;
      EXPECT_LT(norm(p), recipe.radius - reach);
    }
    expect_exact_mass(specimen);
  }
}

SpecimenRecipe ring(const std::string& shape, const std::string& axis) {
  SpecimenRecipe recipe;
  recipe.shape = shape;
  recipe.axis = axis;
  recipe.length = 1e-3;
  recipe.inner_radius = 0.5e-3;
  recipe.radius = 1.2e-3;
  recipe.angle = 2.0;
  recipe.elements = 1000;
  recipe.origin = {1e-3, 2e-3, 3e-3};
  return recipe;
}

void expect_compact_inside(const SpecimenRecipe& recipe, double sector) {
  const Specimen specimen = make_specimen(recipe);
  const double R = recipe.radius, r = recipe.inner_radius;
  EXPECT_DOUBLE_EQ(specimen.domain.volume, sector / 2 * (R * R - r * r) * recipe.length);
  EXPECT_NEAR(specimen.report.at("coordination_number"), 6.2, 0.05);
  EXPECT_NEAR(specimen.report.at("solid_fraction"), 0.62, 0.01);
  EXPECT_GT(specimen.report.at("bulk_elements"), 20);
  EXPECT_LE(specimen.report.at("mean_overlap"), largest_mean_overlap);
  EXPECT_LE(specimen.report.at("rattlers"), 0.015 * 1000);
  expect_isotropic(specimen, 0.02);
  expect_exact_mass(specimen);
  const int axis = recipe.axis[0] - 'x';
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector p = specimen.position[i] - recipe.origin;
    const double reach = 0.85 * specimen.radius[i];
    const double first = component(p, (axis + 1) % 3), second = component(p, (axis + 2) % 3);
    EXPECT_GT(component(p, axis), reach);
    EXPECT_LT(component(p, axis), recipe.length - reach);
    EXPECT_GT(std::hypot(first, second), r + reach);
    EXPECT_LT(std::hypot(first, second), R - reach);
    if (recipe.shape != "wedge") continue;
    EXPECT_GT(second, reach);
    EXPECT_GT(first * std::sin(sector) - second * std::cos(sector), reach);
  }
}

TEST(Packing, Annulus) {
  expect_compact_inside(ring("annulus", "y"), 2 * pi);
}

TEST(Packing, WedgeAlongEachAxis) {
  for (const char* axis : {"x", "y", "z"}) expect_compact_inside(ring("wedge", axis), 2.0);
}

TEST(Packing, BoundingBoxOfAWedge) {
  SpecimenRecipe recipe = ring("wedge", "z");
  recipe.origin = {};
  const Domain wide = shape_of(recipe);
  EXPECT_DOUBLE_EQ(wide.lower.x, 1.2e-3 * std::cos(2.0));
  EXPECT_DOUBLE_EQ(wide.upper.x, 1.2e-3);
  EXPECT_DOUBLE_EQ(wide.lower.y, 0);
  EXPECT_DOUBLE_EQ(wide.upper.y, 1.2e-3);
  recipe.angle = 1.0;
  const Domain narrow = shape_of(recipe);
  EXPECT_DOUBLE_EQ(narrow.lower.x, 0.5e-3 * std::cos(1.0));
  EXPECT_DOUBLE_EQ(narrow.upper.y, 1.2e-3 * std::sin(1.0));
  for (const Domain& domain : {wide, narrow}) EXPECT_NEAR(norm(domain.axis_point()), 0, 1e-18);
}

TEST(Packing, MeanRadiusGivesTheNumberOfElements) {
  SpecimenRecipe recipe = cube(0);
  recipe.mean_radius = 1e-4;
  const Specimen specimen = make_specimen(recipe);
  EXPECT_NEAR(mean_radius(specimen), 1e-4, 1e-6);
}

void expect_same(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vector)), 0);
}

class PackingThreads : public ::testing::Test {
 protected:
  void TearDown() override { omp_set_num_threads(before_); }

 private:
  int before_ = omp_get_max_threads();
};

TEST_F(PackingThreads, SameSeedSameSpecimen) {
  omp_set_num_threads(1);
  const Specimen alone = make_specimen(cube(3200));
  omp_set_num_threads(2);
  const Specimen together = make_specimen(cube(3200));
  expect_same(together.position, alone.position);
  EXPECT_EQ(together.radius, alone.radius);
  EXPECT_EQ(together.bonds, alone.bonds);
}

TEST_F(PackingThreads, SamePathOfSoftSpheres) {
  const Specimen crystal = [] {
    SpecimenRecipe recipe;
    recipe.shape = "crystal";
    recipe.lattice = "simple_cubic";
    recipe.cells = {20, 20, 20};
    recipe.element_radius = 1.0;
    recipe.periodic = {true, false, true};
    return make_specimen(recipe);
  }();
  std::vector<Vector> start = crystal.position;
  for (std::size_t i = 0; i < start.size(); ++i)
    start[i] += 0.4 * Vector{std::sin(1.0 * i), std::sin(2.0 * i), std::sin(3.0 * i)};
  const auto end_on = [&](int threads) {
    omp_set_num_threads(threads);
    SoftSpheres spheres(crystal.domain, start, crystal.radius);
    spheres.inflate(1.06);
    EXPECT_EQ(spheres.relax(1e-9, 100), 100);
    return spheres.position();
  };
  const std::vector<Vector> alone = end_on(1);
  expect_same(end_on(2), alone);
  expect_same(end_on(4), alone);
}

TEST(Packing, AnotherSeedMakesAnotherSpecimen) {
  SpecimenRecipe other = cube(300);
  other.seed = 2;
  EXPECT_NE(make_specimen(cube(300)).position[0].x, make_specimen(other).position[0].x);
}

void expect_refusal(const SpecimenRecipe& recipe, const std::string& text) {
  try {
    make_specimen(recipe);
    ADD_FAILURE() << "no error; expected one with: " << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(Packing, RefusesIncompleteAndImpossibleRecipes) {
  expect_refusal(cube(0), "either elements or mean_radius");
  SpecimenRecipe recipe = cube(100);
  recipe.mean_radius = 1e-4;
  expect_refusal(recipe, "either elements or mean_radius");
  recipe = cube(-5);
  expect_refusal(recipe, "[specimen] elements = -5");
  recipe = cube(100);
  recipe.shape = "pyramid";
  expect_refusal(recipe, "\"pyramid\"");
  recipe = cube(100);
  recipe.size.y = -1;
  expect_refusal(recipe, "size (along y)");
  recipe = cube(10);
  recipe.size = {50e-3, 30e-3, 2e-3};
  expect_refusal(recipe, "take more elements");
  recipe = cube(10);
  recipe.periodic = {true, true, true};
  expect_refusal(recipe, "repeats itself");
  recipe = cube(100);
  recipe.radius_spread = 0.9;
  expect_refusal(recipe, "radius_spread");
  recipe.shape = "cylinder";
  recipe.radius_spread = 0.1;
  recipe.length = recipe.radius = 1e-3;
  recipe.axis = "q";
  expect_refusal(recipe, "[specimen] axis");
  recipe.axis = "x";
  recipe.periodic = {false, true, false};
  expect_refusal(recipe, "along its axis");
  recipe = ring("annulus", "x");
  recipe.inner_radius = recipe.radius;
  expect_refusal(recipe, "below outer_radius");
  recipe.inner_radius = 0;
  expect_refusal(recipe, "[specimen] inner_radius = 0 m");
  recipe = ring("annulus", "x");
  recipe.inner_radius = 1.19e-3;
  expect_refusal(recipe, "take more elements");
  recipe = ring("wedge", "z");
  recipe.angle = 3.2;
  expect_refusal(recipe, "[specimen] angle = 3.2 rad");
  recipe.angle = 0.01;
  expect_refusal(recipe, "take more elements");
}

}  // namespace solidem::packings_test
