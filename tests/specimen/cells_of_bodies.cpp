// SPDX-License-Identifier: GPL-2.0-or-later
//
// Cells of several bodies: each has those that it has alone, wherever it is put.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "laws/constants.hpp"
#include "model/outline.hpp"
#include "specimen/bodies.hpp"
#include "specimen/ordering.hpp"
#include "specimen/specimen_file.hpp"
#include "specimen/tessellation.hpp"
#include "support/refusal.hpp"

namespace solidem::cells_of_bodies_test {

// A bar with a hole and a notch.
BodyRecipe bar() {
  BodyRecipe body;
  body.name = "bar";
  body.recipe.shape = "box";
  body.recipe.size = {4, 2, 1};
  body.recipe.elements = 150;
  body.recipe.origin = {1, 2, 3};
  Cut hole;
  hole.part.kind = Shape::Kind::cylinder;
  hole.part.axis = 2;
  hole.part.radius = 0.4;
  hole.part.offset = {2, 3, 3.5};
  Cut notch;
  notch.part.kind = Shape::Kind::box;
  notch.part.size = {0.5, 1, 2};
  notch.part.offset = {4, 4, 3.5};
  body.recipe.cuts = {hole, notch};
  return body;
}

BodyRecipe tube() {
  BodyRecipe body;
  body.name = "tube";
  body.recipe.shape = "annulus";
  body.recipe.axis = "x";
  body.recipe.length = 2;
  body.recipe.radius = 1;
  body.recipe.inner_radius = 0.5;
  body.recipe.elements = 200;
  body.recipe.origin = {0, -2, 0};
  return body;
}

// About an axis that is none of the body's.
BodyRecipe moved(BodyRecipe body, double angle, const Vector& shift) {
  const double s = std::sin(angle / 2);
  body.turned = {std::cos(angle / 2), {s / 3, 2 * s / 3, 2 * s / 3}};
  body.shift = shift;
  return body;
}

std::vector<BodyRecipe> two_bodies() {
  return {moved(bar(), 0.7, {10, 0, 0}), moved(tube(), -1.9, {0, -5, 4})};
}

// They are packed once.
const Specimen& both() {
  static const Specimen specimen = make_bodies(two_bodies());
  return specimen;
}

// That body `b` of the specimen has the cells of the recipe alone.
void expect_cells_alone(const Specimen& all, const Tessellation& cells, std::size_t b,
                        const Tessellation& alone) {
  const std::vector<std::int32_t>& elements = all.bodies[b].elements;
  const double R = mean_radius(all);
  for (std::size_t i = 0; i < elements.size(); ++i)
    EXPECT_NEAR(cells.volume[static_cast<std::size_t>(elements[i])], alone.volume[i],
                1e-11 * R * R * R);
  std::size_t f = 0;
  while (cells.faces[f].i < elements.front()) ++f;
  for (std::size_t k = 0; k < alone.faces.size(); ++k, ++f) {
    EXPECT_EQ(cells.faces[f].i, elements[static_cast<std::size_t>(alone.faces[k].i)]);
    EXPECT_EQ(cells.faces[f].j, elements[static_cast<std::size_t>(alone.faces[k].j)]);
    EXPECT_NEAR(cells.area[f], alone.area[k], 1e-11 * R * R);
    EXPECT_NEAR(cells.distance[f], alone.distance[k], 1e-11 * R);
  }
  for (const auto& [name, faces] : alone.walls) {
    const std::vector<WallFace>& wall = cells.walls.at(all.bodies[b].name + "." + name);
    ASSERT_EQ(wall.size(), faces.size()) << name;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      EXPECT_EQ(wall[k].element, elements[static_cast<std::size_t>(faces[k].element)]);
      EXPECT_NEAR(wall[k].area, faces[k].area, 1e-11 * R * R);
      EXPECT_NEAR(wall[k].distance, faces[k].distance, 1e-11 * R);
    }
  }
}

TEST(CellsOfBodies, AreThoseOfEachAloneWhereverItIs) {
  const std::vector<BodyRecipe> recipes = two_bodies();
  const Specimen& all = both();
  ASSERT_TRUE(has_cells(all));
  const Tessellation cells = tessellate(all);
  std::size_t walls = 0, faces = 0;
  for (std::size_t b = 0; b < recipes.size(); ++b) {
    const Tessellation alone = tessellate(make_specimen(recipes[b].recipe));
    expect_cells_alone(all, cells, b, alone);
    walls += alone.walls.size();
    faces += alone.faces.size();
    double volume = 0;
    for (const std::int32_t element : all.bodies[b].elements)
      volume += cells.volume[static_cast<std::size_t>(element)];
    EXPECT_NEAR(volume, all.bodies[b].volume, 1e-12 * volume);
  }
  EXPECT_EQ(cells.walls.size(), walls);
  EXPECT_EQ(cells.faces.size(), faces);
}

// Volume and first moment of what the solids of a body's cells hold within a box.
std::pair<double, Vector> held(const Specimen& specimen, std::size_t b, const Vector& lower,
                               const Vector& upper) {
  double sum = 0;
  Vector moment{};
  const std::vector<std::int32_t> body = body_of_elements(specimen);
  for (const CellSolid& part : cell_solids(specimen, lower, upper)) {
    if (body[static_cast<std::size_t>(part.element)] != static_cast<std::int32_t>(b)) continue;
    const double size = (part.is_taken_away ? -1 : 1) * volume(part.solid);
    const auto [low, high] = bounds(part.solid);
    sum += size;
    moment += (0.5 * size) * (low + high);
  }
  return {sum, moment};
}

TEST(CellsOfBodies, StandAsSolidsWhereTheBodiesAre) {
  const Specimen& all = both();
  const PlacedOutline& tube = all.outline->bodies[1];
  const auto [volume, moment] = held(all, 1, all.domain.lower, all.domain.upper);
  EXPECT_NEAR(volume, all.bodies[1].volume, 1e-9 * volume);
  // The middles of their boxes stand for their centres of mass.
  const Vector centre = tube.to_place({1, -2, 0});
  EXPECT_NEAR(norm((1 / volume) * moment - centre), 0, 0.03);
  EXPECT_EQ(held(all, 0, all.bodies[1].lower, all.bodies[1].upper).first, 0);
  // A slab about a wall has its area, and lies where the wall is.
  double area = 0;
  for (const CellSolid& slab : wall_slabs(all, "tube.x_high", 1e-3)) {
    area += (slab.is_taken_away ? -1e3 : 1e3) * solidem::volume(slab.solid);
    const auto [low, high] = bounds(slab.solid);
    EXPECT_NEAR(tube.from_place(0.5 * (low + high)).x, 2, 0.05);
  }
  EXPECT_NEAR(area, 0.75 * pi, 1e-6);
}

TEST(CellsOfBodies, StayWhenTheElementsOfBodiesAreMixed) {
  Specimen all = both();
  const Tessellation before = tessellate(all);
  sort_elements(all);
  const Tessellation after = tessellate(all);
  ASSERT_EQ(before.faces.size(), after.faces.size());
  for (std::size_t f = 1; f < after.faces.size(); ++f)
    EXPECT_LT(after.faces[f - 1], after.faces[f]);
  for (std::size_t b = 0; b < all.bodies.size(); ++b) {
    double sum = 0;
    for (const std::int32_t element : all.bodies[b].elements)
      sum += after.volume[static_cast<std::size_t>(element)];
    EXPECT_NEAR(sum, all.bodies[b].volume, 1e-12 * sum);
  }
}

TEST(CellsOfBodies, AreKeptByAFile) {
  const std::string path =
      std::filesystem::temp_directory_path() / ("bodies" + std::to_string(getpid()) + ".h5");
  const Specimen& all = both();
  write_specimen(path, all);
  const Specimen read = read_specimen(path);
  std::filesystem::remove(path);
  const Tessellation before = tessellate(all), after = tessellate(read);
  EXPECT_EQ(before.volume, after.volume);
  EXPECT_EQ(before.faces, after.faces);
  EXPECT_EQ(before.area, after.area);
}

std::string complaint_of(const Specimen& specimen) {
  return test::refusal_of([&] { tessellate(specimen); });
}

TEST(CellsOfBodies, AreRefusedWhereABodyIsNotKnown) {
  Specimen all = both();
  all.outline = nullptr;
  EXPECT_FALSE(has_cells(all));
  EXPECT_NE(complaint_of(all).find("how its bodies were made"), std::string::npos);
  all = both();
  Outline outline = *all.outline;
  outline.bodies[1].domain.shape = "imported";
  all.outline = std::make_shared<const Outline>(outline);
  EXPECT_FALSE(has_cells(all));
  EXPECT_EQ(complaint_of(all).find("body \"tube\", where it was made: cells: "), 0u);
}

}  // namespace solidem::cells_of_bodies_test
