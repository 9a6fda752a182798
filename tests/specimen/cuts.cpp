// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is left of bodies that something is cut out of: volumes with closed formulas, exact masses,
// and cuts that make no sense.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "laws/constants.hpp"
#include "specimen/bonds.hpp"
#include "specimen/mesh_walls.hpp"
#include "specimen/packing.hpp"
#include "specimen/pieces.hpp"
#include "specimen/recipe.hpp"
#include "specimen/shape.hpp"
#include "specimen/tessellation.hpp"
#include "support/meshes.hpp"
#include "support/refusal.hpp"

namespace solidem::cuts_test {

Cut box_cut(const Vector& centre, const Vector& size) {
  Cut cut;
  cut.part.kind = Shape::Kind::box;
  cut.part.size = size;
  cut.part.offset = centre;
  return cut;
}

Cut sphere_cut(const Vector& centre, double radius) {
  Cut cut;
  cut.part.radius = radius;
  cut.part.offset = centre;
  return cut;
}

Cut cylinder_cut(const Vector& centre, double radius, int axis) {
  Cut cut = sphere_cut(centre, radius);
  cut.part.kind = Shape::Kind::cylinder;
  cut.part.axis = axis;
  return cut;
}

Quaternion<double> turned_about(const Vector& axis, double angle) {
  return {std::cos(angle / 2), std::sin(angle / 2) * axis};
}

Domain box_body(const Vector& size) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = size;
  return shape_of(recipe);
}

Domain cylinder_body(double radius, double length, const char* axis = "z") {
  SpecimenRecipe recipe;
  recipe.shape = "cylinder";
  recipe.axis = axis;
  recipe.radius = radius;
  recipe.length = length;
  return shape_of(recipe);
}

Domain sphere_body(double radius) {
  SpecimenRecipe recipe;
  recipe.shape = "sphere";
  recipe.radius = radius;
  return shape_of(recipe);
}

TEST(VolumeLeft, BoxesOutOfABoxAreExact) {
  const Domain body = box_body({4, 2, 1});
  EXPECT_NEAR(volume_left(body, {box_cut({2, 2, 0.5}, {1, 1, 3})}), 8 - 0.5, 1e-13);
  // Two that share a quarter of each.
  EXPECT_NEAR(
      volume_left(body, {box_cut({1, 1, 0.5}, {1, 1, 3}), box_cut({1.5, 1.5, 0.5}, {1, 1, 3})}),
      8 - 1.75, 1e-13);
}

TEST(VolumeLeft, ATurnedBoxIsANotch) {
  Cut notch = box_cut({2, 2, 0.5}, {std::sqrt(2.0), std::sqrt(2.0), 3});
  notch.turned = turned_about({0, 0, 1}, pi / 4);
  EXPECT_NEAR(volume_left(box_body({4, 2, 1}), {notch}), 8 - 1, 1e-13);
}

TEST(VolumeLeft, RoundHolesInABoxAreExact) {
  const Domain body = box_body({4, 2, 1});
  EXPECT_NEAR(volume_left(body, {cylinder_cut({1, 1, 0}, 0.3, 2)}), 8 - 0.09 * pi, 1e-13);
  EXPECT_NEAR(volume_left(body, {cylinder_cut({1, 1, 0}, 0.3, 2), cylinder_cut({3, 1, 0}, 0.4, 2)}),
              8 - 0.25 * pi, 1e-12);
  EXPECT_NEAR(volume_left(body, {sphere_cut({0, 0, 0}, 0.5)}), 8 - pi * 0.125 / 6, 1e-13);
  Cut oblique = cylinder_cut({2, 1, 0.5}, 0.2, 2);
  oblique.turned = turned_about({0, 1, 0}, pi / 6);
  EXPECT_NEAR(volume_left(body, {oblique}), 8 - 0.04 * pi / std::cos(pi / 6), 1e-12);
}

TEST(VolumeLeft, WhereRoundSurfacesMeetItIsCloseTo) {
  // Steinmetz' solid: two cylinders of one radius that cross.
  const double steinmetz = 16.0 / 3;
  EXPECT_NEAR(volume_left(cylinder_body(1, 4), {cylinder_cut({0, 0, 2}, 1, 0)}), 4 * pi - steinmetz,
              1e-7 * 4 * pi);
  // A sphere that is bored through: what is left hangs on the height of the ring alone.
  const double ring = 4.0 / 3 * pi * std::pow(1 - 0.25, 1.5);
  EXPECT_NEAR(volume_left(sphere_body(1), {cylinder_cut({}, 0.5, 0)}), ring, 1e-7 * 4);
  // Two spheres share two caps.
  const double cap = pi * 0.16 / 3 * (3 * 0.8 - 0.4), ball = 4.0 / 3 * pi * 0.512;
  EXPECT_NEAR(volume_left(box_body({4, 4, 4}),
                          {sphere_cut({1.6, 2, 2}, 0.8), sphere_cut({2.4, 2, 2}, 0.8)}),
              64 - 2 * ball + 2 * cap, 1e-7 * 64);
}

TEST(VolumeLeft, AnnulusAndWedgeKnowTheirOwnWalls) {
  SpecimenRecipe recipe;
  recipe.shape = "wedge";
  recipe.axis = "z";
  recipe.inner_radius = 1;
  recipe.radius = 2;
  recipe.angle = pi / 2;
  recipe.length = 1;
  const Domain wedge = shape_of(recipe);
  EXPECT_NEAR(volume_left(wedge, {}), wedge.volume, 1e-12);
  EXPECT_NEAR(volume_left(wedge, {box_cut({0, 0, 1}, {9, 9, 1})}), 0.5 * wedge.volume, 1e-12);
}

Cut mesh_cut(const TriangleMesh& mesh) {
  Cut cut;
  cut.mesh = std::make_shared<const FacetTree>(mesh);
  return cut;
}

TEST(VolumeLeft, MeshesAreCutAndCutExactly) {
  const Domain body = box_body({4, 2, 1});
  const Cut notch = mesh_cut(test::box_mesh({1.5, 1, -1}, {2.5, 3, 2}));
  EXPECT_NEAR(volume_left(body, {notch}), 8 - 1, 1e-12);
  // With a round hole that shares a half with the notch.
  EXPECT_NEAR(volume_left(body, {notch, cylinder_cut({2, 1, 0}, 0.25, 2)}), 7 - 0.5 * 0.0625 * pi,
              1e-12);
  const FacetTree ball(test::ball_mesh(1, 2));
  Domain of_ball;
  of_ball.shape = "mesh";
  of_ball.lower = {-1, -1, -1};
  of_ball.upper = {1, 1, 1};
  const double whole = volume(ball.mesh());
  EXPECT_NEAR(volume_left(of_ball, {box_cut({0.5, 0, 0}, {1, 9, 9})}, &ball), 0.5 * whole, 1e-12);
  EXPECT_NEAR(volume_left(of_ball, {mesh_cut(test::box_mesh({0, 0, -9}, {9, 9, 9}))}, &ball),
              0.75 * whole, 1e-12);
}

// A body of an L, which is not convex.
TriangleMesh angle_mesh() {
  TriangleMesh mesh;
  const double corners[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const double z : {0.0, 1.0})
    for (const auto& c : corners) mesh.vertices.push_back({c[0], c[1], z});
  for (std::int32_t k = 0; k < 6; ++k) {
    const std::int32_t next = (k + 1) % 6;
    mesh.facets.push_back({k, next, next + 6});
    mesh.facets.push_back({k, next + 6, k + 6});
  }
  for (const Facet& f : {Facet{0, 1, 3}, Facet{1, 2, 3}, Facet{0, 3, 5}, Facet{3, 4, 5}}) {
    mesh.facets.push_back({f[0], f[2], f[1]});
    mesh.facets.push_back({f[0] + 6, f[1] + 6, f[2] + 6});
  }
  return mesh;
}

TEST(Meshes, ArePackedBetweenTheirFacets) {
  SpecimenRecipe recipe;
  recipe.shape = "mesh";
  recipe.elements = 800;
  const FacetTree surface(angle_mesh());
  const Specimen specimen = make_packing(recipe, {}, &surface);
  EXPECT_NEAR(specimen.domain.volume, 3, 1e-13);
  double deepest = 0;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double inside = -surface.signed_distance(specimen.position[i]);
    ASSERT_GT(inside, 0);
    deepest = std::max(deepest, 1 - inside / specimen.radius[i]);
  }
  EXPECT_LT(deepest, 0.2);
  Specimen bonded = specimen;
  make_bonds(bonded, 0);
  EXPECT_GT(2.0 * static_cast<double>(bonded.bonds.size()) / 800, 6.0);
}

TEST(Meshes, OfABoxArePackedAsTheBox) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {2, 1, 1};
  recipe.elements = 500;
  const FacetTree surface(test::box_mesh({0, 0, 0}, {2, 1, 1}));
  Specimen box = make_packing(recipe), mesh = make_packing(recipe, {}, &surface);
  EXPECT_NEAR(sphere_volume(mesh), sphere_volume(box), 0.01 * sphere_volume(box));
}

SpecimenRecipe notched_bar() {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {5e-3, 2e-3, 2e-3};
  recipe.elements = 600;
  Cut notch = box_cut({2.5e-3, 2e-3, 1e-3}, {0.7e-3, 0.7e-3, 3e-3});
  notch.turned = turned_about({0, 0, 1}, pi / 4);
  recipe.cuts = {notch};
  return recipe;
}

TEST(Cuts, ElementsInTheCutAreTakenOutAndTheMassIsWhatIsLeft) {
  const SpecimenRecipe recipe = notched_bar();
  const Specimen specimen = make_specimen(recipe);
  EXPECT_LT(specimen.size(), 600u);
  for (const Vector& p : specimen.position) EXPECT_GT(recipe.cuts[0].distance(p), 0);
  const double body = 20e-9 - 0.7e-3 * 0.7e-3 / 2 * 2e-3;
  EXPECT_NEAR(specimen.domain.volume, body, 1e-12 * body);
  EXPECT_EQ(specimen.domain.cuts, 1);
  const std::vector<double> mass = represented_mass(specimen, {2790});
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0), 2790 * body, 1e-12 * 2790 * body);
  EXPECT_TRUE(has_cells(specimen));
}

TEST(Cuts, ElementsThatReachIntoTheCutGoWhereThatIsAsked) {
  SpecimenRecipe recipe = notched_bar();
  recipe.cuts = {cylinder_cut({2.5e-3, 1e-3, 0}, 0.5e-3, 2)};
  recipe.cuts[0].takes_touched = true;
  const Specimen specimen = make_specimen(recipe);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector from_axis = specimen.position[i] - Vector{2.5e-3, 1e-3, specimen.position[i].z};
    EXPECT_GT(norm(from_axis), 0.5e-3 + specimen.radius[i]);
  }
}

TEST(Cuts, ACrystalLosesWholeElements) {
  SpecimenRecipe recipe;
  recipe.shape = "crystal";
  recipe.lattice = "simple_cubic";
  recipe.cells = {4, 4, 4};
  recipe.element_radius = 0.5;
  recipe.cuts = {box_cut({2, 2, 2}, {2, 2, 9})};
  const Specimen specimen = make_specimen(recipe);
  EXPECT_EQ(specimen.size(), 64u - 16u);
  EXPECT_NEAR(specimen.domain.volume, 48, 1e-12);
}

TEST(Cuts, ThatCutABodyInTwoAreTold) {
  SpecimenRecipe recipe = notched_bar();
  recipe.cuts = {box_cut({2.5e-3, 1e-3, 1e-3}, {1e-3, 9e-3, 9e-3})};
  const Specimen specimen = make_specimen(recipe);
  const std::vector<std::string> notes = notes_on(specimen, specimen.bonds);
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("2 pieces that do not see each other") != std::string::npos;
  }));
}

std::string complaint_of(const SpecimenRecipe& recipe) {
  return test::refusal_of([&] { make_specimen(recipe); });
}

TEST(Cuts, ThatMakeNoSenseAreRefused) {
  SpecimenRecipe recipe = notched_bar();
  recipe.cuts.push_back(box_cut({9e-3, 0, 0}, {1e-3, 1e-3, 1e-3}));
  EXPECT_NE(complaint_of(recipe).find("cut 2: it lies outside of the body"), std::string::npos);
  recipe.cuts = {box_cut({2.5e-3, 1e-3, 1e-3}, {1, 1, 1})};
  EXPECT_NE(complaint_of(recipe).find("leave nothing of the body"), std::string::npos);
  recipe.cuts = {box_cut({2.5e-3, 1e-3, 1e-3}, {1e-6, 1, 1})};
  EXPECT_NE(complaint_of(recipe).find("bonds would join what it parts"), std::string::npos);
  recipe = notched_bar();
  recipe.periodic = {true, false, false};
  recipe.cuts = {box_cut({0, 1e-3, 1e-3}, {1e-3, 1, 1})};
  EXPECT_NE(complaint_of(recipe).find("along which the body repeats itself"), std::string::npos);
}

SpecimenRecipe ball(std::int64_t elements) {
  SpecimenRecipe recipe;
  recipe.shape = "sphere";
  recipe.radius = 1e-3;
  recipe.elements = elements;
  recipe.origin = {1e-3, 2e-3, -1e-3};
  return recipe;
}

TEST(Spheres, ArePackedWithinTheirSurface) {
  const Specimen specimen = make_specimen(ball(1000));
  EXPECT_EQ(specimen.size(), 1000u);
  EXPECT_NEAR(specimen.domain.volume, 4.0 / 3 * pi * 1e-9, 1e-22);
  EXPECT_NEAR(specimen.report.at("coordination_number"), 6.2, 0.05);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double from_centre = norm(specimen.position[i] - Vector{1e-3, 2e-3, -1e-3});
    EXPECT_LT(from_centre, 1e-3 - 0.8 * specimen.radius[i]);
  }
}

TEST(Spheres, AreFilledByTheirCells) {
  const Specimen specimen = make_specimen(ball(200));
  const Tessellation cells = tessellate(specimen);
  EXPECT_NEAR(std::accumulate(cells.volume.begin(), cells.volume.end(), 0.0),
              specimen.domain.volume, 1e-12 * specimen.domain.volume);
  const std::vector<WallFace>& surface = cells.walls.at("surface");
  double area = 0;
  for (const WallFace& face : surface) area += face.area;
  EXPECT_NEAR(area, 4e-6 * pi, 1e-12 * 4e-6 * pi);
}

}  // namespace solidem::cuts_test
