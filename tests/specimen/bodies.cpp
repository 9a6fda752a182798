// SPDX-License-Identifier: GPL-2.0-or-later
//
// Several bodies as one specimen: places, bonds, masses, and bodies that stand in each other's way.
#include "specimen/bodies.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "model/error.hpp"
#include "model/region.hpp"
#include "specimen/bonds.hpp"
#include "specimen/ordering.hpp"
#include "specimen/pieces.hpp"
#include "specimen/specimen_file.hpp"
#include "support/refusal.hpp"

namespace solidem::bodies_test {

BodyRecipe block(const std::string& name, const Vector& origin, std::array<int, 3> cells) {
  BodyRecipe body;
  body.name = name;
  body.recipe.shape = "crystal";
  body.recipe.lattice = "simple_cubic";
  body.recipe.cells = cells;
  body.recipe.element_radius = 0.5;
  body.recipe.origin = origin;
  return body;
}

std::vector<BodyRecipe> two_blocks(double gap) {
  return {block("low", {0, 0, 0}, {3, 3, 2}), block("high", {0, 0, 2 + gap}, {2, 2, 2})};
}

std::string complaint_of(const std::vector<BodyRecipe>& recipes) {
  return test::refusal_of([&] { make_bodies(recipes); });
}

TEST(Bodies, AreBondedWithinThemselvesAlone) {
  const Specimen both = make_bodies(two_blocks(1e-9));
  EXPECT_EQ(both.size(), 18u + 8u);
  EXPECT_EQ(both.domain.shape, "bodies");
  EXPECT_NEAR(both.domain.volume, 26, 1e-12);
  const std::vector<std::int32_t> body = body_of_elements(both);
  for (const Pair& pair : both.bonds)
    EXPECT_EQ(body[static_cast<std::size_t>(pair.i)], body[static_cast<std::size_t>(pair.j)]);
  EXPECT_EQ(both.bonds.size(), (2u * 3 * 2 + 3u * 2 * 2 + 9) + 12u);
  EXPECT_TRUE(notes_on(both, both.bonds).empty());
}

TEST(Bodies, AreBondedWithEachOtherWhereThatIsAsked) {
  std::vector<BodyRecipe> recipes = two_blocks(0);
  recipes[1].bonded_to = {"low"};
  const Specimen both = make_bodies(recipes);
  EXPECT_EQ(both.bonds.size(), 33u + 12u + 4u);
  recipes[1].bonded_to = {"nobody"};
  EXPECT_NE(complaint_of(recipes).find("bonded_to \"nobody\""), std::string::npos);
}

TEST(Bodies, RepresentTheirOwnMassesWhateverTheirSpheresAre) {
  std::vector<BodyRecipe> recipes = two_blocks(1);
  BodyRecipe ball;
  ball.name = "ball";
  ball.recipe.shape = "sphere";
  ball.recipe.radius = 2;
  ball.recipe.elements = 60;
  ball.recipe.origin = {1, 1, 9};
  recipes.push_back(ball);
  const Specimen all = make_bodies(recipes);
  const std::vector<double> mass = represented_mass(all, {3});
  const double volumes[] = {18, 8, 4.0 / 3 * pi * 8};
  for (std::size_t b = 0; b < 3; ++b) {
    double sum = 0;
    for (const std::int32_t element : all.bodies[b].elements)
      sum += mass[static_cast<std::size_t>(element)];
    EXPECT_NEAR(sum, 3 * volumes[b], 1e-12 * sum) << all.bodies[b].name;
  }
}

TEST(Bodies, AreTurnedAboutTheirOriginAndMoved) {
  std::vector<BodyRecipe> recipes = two_blocks(1);
  recipes[1].turned = {std::cos(pi / 4), {std::sin(pi / 4), 0, 0}};  // y to z
  recipes[1].shift = {10, 0, 0};
  const Specimen both = make_bodies(recipes);
  const Body& body = both.bodies[1];
  EXPECT_NEAR(body.lower.x, 10, 1e-12);
  EXPECT_NEAR(body.lower.y, -2, 1e-12);
  EXPECT_NEAR(body.upper.y, 0, 1e-12);
  EXPECT_NEAR(body.lower.z, 3, 1e-12);
  for (const std::int32_t element : body.elements) {
    const Vector& p = both.position[static_cast<std::size_t>(element)];
    EXPECT_GT(p.y, -2);
    EXPECT_LT(p.y, 0);
  }
}

TEST(Bodies, ATurnedCylinderKnowsItsExtents) {
  std::vector<BodyRecipe> recipes = two_blocks(1);
  BodyRecipe rod;
  rod.name = "rod";
  rod.recipe.shape = "cylinder";
  rod.recipe.axis = "x";
  rod.recipe.length = 4;
  rod.recipe.radius = 1;
  rod.recipe.elements = 40;
  rod.recipe.origin = {20, 0, 0};
  rod.turned = {std::cos(pi / 8), {0, 0, std::sin(pi / 8)}};  // 45° about z
  recipes.push_back(rod);
  const Body body = make_bodies(recipes).bodies[2];
  EXPECT_NEAR(body.lower.x, 20 - std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(body.upper.x, 20 + 5 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(body.lower.z, -1, 1e-12);
}

TEST(Bodies, ThatOverlapAreRefused) {
  const std::string words = complaint_of(two_blocks(-0.25));
  EXPECT_NE(words.find("bodies overlap at the start"), std::string::npos) << words;
  EXPECT_NE(words.find("of \"low\""), std::string::npos) << words;
  EXPECT_NE(words.find("of \"high\""), std::string::npos) << words;
  EXPECT_NE(words.find("by 0.25 m, 4 pairs"), std::string::npos) << words;
  EXPECT_EQ(complaint_of(two_blocks(0)), "");
}

TEST(Bodies, WithinTheRangeOfCentralForcesAreRefused) {
  EXPECT_NO_THROW(check_apart(make_bodies(two_blocks(0.5)), 1.4));
  EXPECT_THROW(check_apart(make_bodies(two_blocks(0.5)), 1.6), InputError);
}

TEST(Bodies, ThatRepeatThemselvesAreRefused) {
  std::vector<BodyRecipe> recipes = two_blocks(1);
  recipes[0].recipe.periodic = {true, false, false};
  EXPECT_NE(complaint_of(recipes).find("\"low\" periodic"), std::string::npos);
}

TEST(Bodies, AreChosenByRegions) {
  const Specimen both = make_bodies(two_blocks(1));
  Region region;
  region.body = "high";
  EXPECT_EQ(select(region, both), both.bodies[1].elements);
  region.kind = Region::Kind::face;
  region.axis = 2;
  region.depth = 0.6;
  const std::vector<std::int32_t> lowest = select(region, both);
  EXPECT_EQ(lowest.size(), 4u);
  for (const std::int32_t element : lowest)
    EXPECT_NEAR(both.position[static_cast<std::size_t>(element)].z, 3.5, 1e-12);
  region.body = "nobody";
  EXPECT_THROW(select(region, both), InputError);
}

TEST(Bodies, KeepTheirElementsWhenTheseAreSorted) {
  const Specimen before = make_bodies(two_blocks(1));
  Specimen after = before;
  sort_elements(after);
  for (const std::int32_t element : after.bodies[1].elements)
    EXPECT_GT(after.position[static_cast<std::size_t>(element)].z, 3);
  EXPECT_EQ(after.bodies[1].elements.size(), 8u);
}

TEST(Bodies, ComeBackFromAFile) {
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("solidem_bodies_" + std::to_string(getpid()) + ".h5"))
                               .string();
  std::vector<BodyRecipe> recipes = two_blocks(0);
  recipes[1].bonded_to = {"low"};
  const Specimen written = make_bodies(recipes);
  write_specimen(path, written);
  const Specimen read = read_specimen(path);
  std::filesystem::remove(path);
  ASSERT_EQ(read.bodies.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_EQ(read.bodies[b].name, written.bodies[b].name);
    EXPECT_EQ(read.bodies[b].volume, written.bodies[b].volume);
    EXPECT_EQ(read.bodies[b].elements, written.bodies[b].elements);
    EXPECT_EQ(read.bodies[b].bonded_to, written.bodies[b].bonded_to);
  }
  EXPECT_EQ(represented_mass(read, {1}), represented_mass(written, {1}));
  for (const char* text : {"bodies.data", "bodies.txt", "bodies.csv"})
    EXPECT_THROW(write_specimen(text, written), InputError) << text;
}

}  // namespace solidem::bodies_test
