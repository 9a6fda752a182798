// SPDX-License-Identifier: GPL-2.0-or-later
//
// Cells at cuts and meshes: they fill what is left of the body, show what its surface has, and
// conduct as the body does, however it is told what bounds it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "laws/constants.hpp"
#include "model/error.hpp"
#include "model/outline.hpp"
#include "specimen/recipe.hpp"
#include "specimen/specimen_file.hpp"
#include "specimen/tessellation.hpp"
#include "support/meshes.hpp"

namespace solidem::cells_at_cuts_test {

Cut box_cut(const Vector& centre, const Vector& size) {
  Cut cut;
  cut.part.kind = Shape::Kind::box;
  cut.part.size = size;
  cut.part.offset = centre;
  return cut;
}

Cut cylinder_cut(const Vector& centre, double radius, int axis) {
  Cut cut;
  cut.part.kind = Shape::Kind::cylinder;
  cut.part.axis = axis;
  cut.part.radius = radius;
  cut.part.offset = centre;
  return cut;
}

Cut mesh_cut(TriangleMesh mesh) {
  Cut cut;
  cut.mesh = std::make_shared<const FacetTree>(std::move(mesh));
  return cut;
}

// An L, which is not convex: two by two less one by one, one thick.
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

SpecimenRecipe box(const Vector& size, std::int64_t elements) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = size;
  recipe.elements = elements;
  return recipe;
}

// 4 by 2 by 1 with a notch half a unit wide and 1 deep from above.
SpecimenRecipe notched_bar(std::int64_t elements) {
  SpecimenRecipe recipe = box({4, 2, 1}, elements);
  recipe.cuts = {box_cut({2, 2, 0.5}, {0.5, 2, 3})};
  return recipe;
}

// The same elements, as those of a body of another outline.
Specimen with_outline(Specimen specimen, const Outline& outline) {
  if (outline.surface != nullptr) specimen.domain.shape = "mesh";
  specimen.domain.cuts = static_cast<int>(outline.cuts.size());
  specimen.outline = std::make_shared<const Outline>(outline);
  return specimen;
}

Outline outline_of(TriangleMesh mesh) {
  return {std::make_shared<const FacetTree>(std::move(mesh)), {}};
}

// What all solids of the cells hold, signs counted; nothing scales it to the body.
double filled(const Specimen& specimen) {
  double sum = 0;
  for (const CellSolid& part : cell_solids(specimen, specimen.domain.lower, specimen.domain.upper))
    sum += (part.is_taken_away ? -1 : 1) * volume(part.solid);
  return sum;
}

double area(const std::vector<WallFace>& faces) {
  double sum = 0;
  for (const WallFace& face : faces) sum += face.area;
  return sum;
}

// Area of each element, or its area over path, on all walls together.
std::map<std::int32_t, double> on_walls(const Tessellation& cells, bool over_path) {
  std::map<std::int32_t, double> sum;
  for (const auto& [name, faces] : cells.walls)
    for (const WallFace& face : faces)
      sum[face.element] += over_path ? face.area / face.distance : face.area;
  return sum;
}

void expect_same_on_walls(const Tessellation& a, const Tessellation& b, bool over_path,
                          double tolerance) {
  const auto first = on_walls(a, over_path), second = on_walls(b, over_path);
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [element, value] : first)
    ASSERT_NEAR(value, second.at(element), tolerance) << element;
}

void expect_alike(const Tessellation& a, const Tessellation& b, double size, double tolerance) {
  ASSERT_EQ(a.faces, b.faces);
  for (std::size_t f = 0; f < a.faces.size(); ++f) {
    ASSERT_NEAR(a.area[f], b.area[f], tolerance * size * size);
    ASSERT_NEAR(a.distance[f], b.distance[f], tolerance * size);
  }
  for (std::size_t i = 0; i < a.volume.size(); ++i)
    ASSERT_NEAR(a.volume[i], b.volume[i], tolerance * size * size * size);
  expect_same_on_walls(a, b, false, tolerance * size * size);
}

TEST(CellsAtCuts, FillABarWithANotchAndShowItsSurface) {
  const Specimen specimen = make_specimen(notched_bar(500));
  EXPECT_NEAR(filled(specimen), 7.5, 1e-9);
  const Tessellation cells = tessellate(specimen);
  EXPECT_NEAR(area(cells.walls.at("cut_1")), 0.5 + 2 * 1, 1e-9);
  EXPECT_NEAR(area(cells.walls.at("y_high")), 4 - 0.5, 1e-9);
  EXPECT_NEAR(area(cells.walls.at("y_low")), 4, 1e-9);
  EXPECT_NEAR(area(cells.walls.at("z_low")), 8 - 0.5, 1e-9);
  EXPECT_NEAR(area(cells.walls.at("x_high")), 2, 1e-9);
  for (const WallFace& face : cells.walls.at("cut_1")) EXPECT_GT(face.distance, 0);
  for (const double volume : cells.volume) EXPECT_GT(volume, 0);
}

TEST(CellsAtCuts, ThatOverlapOrShareAFaceAreThoseOfOneCut) {
  const Specimen specimen = make_specimen(notched_bar(300));
  const double R = mean_radius(specimen);
  const Tessellation whole = tessellate(specimen);
  const std::vector<std::vector<Cut>> same{
      {box_cut({2, 2, 0.5}, {0.5, 2, 3}), box_cut({2, 1.5, 0.5}, {0.5, 1, 3})},
      {box_cut({1.9, 2, 0.5}, {0.3, 2, 3}), box_cut({2.15, 2, 0.5}, {0.2, 2, 3})},
      {box_cut({2, 1.5, 0.5}, {0.5, 1, 1})},  // flush with the body's faces
      {mesh_cut(test::box_mesh({1.75, 1, -1}, {2.25, 3, 2}))},
      {mesh_cut(test::box_mesh({1.75, 1, 0}, {2.25, 2, 1}))}};
  for (const std::vector<Cut>& cuts : same) {
    const Tessellation cells = tessellate(with_outline(specimen, {nullptr, cuts}));
    ASSERT_NO_FATAL_FAILURE(expect_alike(cells, whole, R, 1e-8));
    double sum = 0;
    for (std::size_t k = 1; k <= cuts.size(); ++k)
      sum += area(cells.walls.at("cut_" + std::to_string(k)));
    EXPECT_NEAR(sum, 2.5, 1e-8);
  }
}

TEST(CellsAtCuts, OfAMeshOfABoxAreThoseOfTheBox) {
  const Specimen specimen = make_specimen(box({2, 1, 1}, 400));
  const Specimen mesh = with_outline(specimen, outline_of(test::box_mesh({0, 0, 0}, {2, 1, 1})));
  const double R = mean_radius(specimen);
  EXPECT_NEAR(filled(mesh), 2, 1e-12);
  const Tessellation cells = tessellate(mesh);
  const Tessellation of_box = tessellate(specimen);
  expect_alike(cells, of_box, R, 1e-12);
  expect_same_on_walls(cells, of_box, true, 1e-12 * R);
  EXPECT_NEAR(area(cells.walls.at("surface")), 10, 1e-11);
  // A notch that is flush with the facets above.
  Outline notched = *mesh.outline;
  notched.cuts = {box_cut({1, 0.75, 0.5}, {0.4, 0.5, 1})};
  Specimen whole = specimen;
  Specimen part = whole;
  part.position.clear();
  part.radius.clear();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (notched.cuts[0].distance(whole.position[i]) <= 0) continue;
    part.position.push_back(whole.position[i]);
    part.radius.push_back(whole.radius[i]);
  }
  part.domain.volume = 2 - 0.2;
  const Tessellation left = tessellate(with_outline(part, notched));
  EXPECT_NEAR(area(left.walls.at("surface")), 10 - 0.4 - 2 * 0.2, 1e-8);
  EXPECT_NEAR(area(left.walls.at("cut_1")), 0.4 + 2 * 0.5, 1e-8);
}

TEST(CellsAtCuts, OfAnAngleAreThoseOfABoxWithACornerCutOut) {
  SpecimenRecipe recipe = box({2, 2, 1}, 600);
  recipe.cuts = {box_cut({2, 2, 0.5}, {2, 2, 3})};
  const Specimen specimen = make_specimen(recipe);
  const Specimen angle = with_outline(specimen, outline_of(angle_mesh()));
  EXPECT_NEAR(filled(specimen), 3, 1e-9);
  EXPECT_NEAR(filled(angle), 3, 1e-11);
  const Tessellation cells = tessellate(angle), cut = tessellate(specimen);
  EXPECT_NEAR(area(cells.walls.at("surface")), 2 * 3 + 8, 1e-10);
  ASSERT_EQ(cells.faces, cut.faces);
  const double R = mean_radius(specimen);
  for (std::size_t f = 0; f < cells.faces.size(); ++f)
    ASSERT_NEAR(cells.area[f], cut.area[f], 1e-8 * R * R);
}

TEST(CellsAtCuts, OfABallOfFacetsFillIt) {
  SpecimenRecipe recipe;
  recipe.shape = "sphere";
  recipe.radius = 0.97;
  recipe.elements = 300;
  Specimen specimen = make_specimen(recipe);
  const TriangleMesh mesh = test::ball_mesh(1, 3);
  specimen.domain.lower = {-1, -1, -1};
  specimen.domain.upper = {1, 1, 1};
  specimen.domain.radius = 0;
  specimen.domain.volume = volume(mesh);
  specimen = with_outline(std::move(specimen), outline_of(mesh));
  EXPECT_NEAR(filled(specimen), volume(mesh), 1e-12);
  double surface = 0;
  for (const Facet& facet : mesh.facets) surface += norm(area_vector(mesh, facet));
  EXPECT_NEAR(area(tessellate(specimen).walls.at("surface")), surface, 1e-11);
}

TEST(CellsAtCuts, AtARoundHoleAreAsExactAsItsFacets) {
  SpecimenRecipe recipe = box({4, 2, 1}, 800);
  recipe.cuts = {cylinder_cut({2, 1, 0.5}, 0.5, 2)};
  const Specimen specimen = make_specimen(recipe);
  EXPECT_NEAR(filled(specimen), 8 - 0.25 * pi, 1e-9);  // the hole is whole
  EXPECT_NEAR(area(tessellate(specimen).walls.at("cut_1")), pi, 1e-9);
  EXPECT_NEAR(area(tessellate(specimen).walls.at("z_low")), 8 - 0.25 * pi, 1e-9);
  // Half of a hole turned by what no facet is symmetric to, and a ball at an edge.
  recipe.cuts = {cylinder_cut({2, 2, 0.5}, 0.5, 2), cylinder_cut({0, 0, 0}, 0.6, 2)};
  recipe.cuts[0].turned = {std::cos(0.137), {0, 0, std::sin(0.137)}};
  recipe.cuts[1].part.kind = Shape::Kind::sphere;
  const double left = 8 - 0.125 * pi - pi * 0.216 / 6;
  EXPECT_NEAR(filled(make_specimen(recipe)), left, 1e-6 * left);
}

TEST(CellsAtCuts, CountTheImagesOfACut) {
  SpecimenRecipe recipe = box({4, 2, 1}, 500);
  recipe.periodic = {true, false, false};
  recipe.cuts = {box_cut({0.25, 2, 0.5}, {0.5, 1, 3})};
  const Specimen specimen = make_specimen(recipe);
  EXPECT_NEAR(filled(specimen), 8 - 0.25, 1e-9);
  Specimen moved = specimen;
  for (Vector& p : moved.position) p.x += p.x < 2 ? 2 : -2;
  const Tessellation cells = tessellate(specimen);
  const Tessellation other =
      tessellate(with_outline(moved, {nullptr, {box_cut({2.25, 2, 0.5}, {0.5, 1, 3})}}));
  expect_alike(cells, other, mean_radius(specimen), 1e-8);
}

// Steady heat flow per conductivity through a body between two walls at 1 and 0.
double steady_heat_flow(const Specimen& specimen, const Tessellation& cells, const std::string& hot,
                        const std::string& cold) {
  const std::size_t n = specimen.size();
  std::vector<double> to_walls(n), source(n), temperature(n), residual, search, image(n);
  for (const std::string& wall : {hot, cold})
    for (const WallFace& face : cells.walls.at(wall)) {
      to_walls[face.element] += face.area / face.distance;
      if (wall == hot) source[face.element] += face.area / face.distance;
    }
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  residual = search = source;
  for (double norm2 = product(source, source), stop = 1e-20 * norm2; norm2 > stop;) {
    for (std::size_t i = 0; i < n; ++i) image[i] = to_walls[i] * search[i];
    for (std::size_t f = 0; f < cells.faces.size(); ++f) {
      const auto [i, j] = cells.faces[f];
      const double flow = cells.area[f] / cells.distance[f] * (search[i] - search[j]);
      image[i] += flow;
      image[j] -= flow;
    }
    const double step = norm2 / product(search, image);
    for (std::size_t i = 0; i < n; ++i) {
      temperature[i] += step * search[i];
      residual[i] -= step * image[i];
    }
    const double next = product(residual, residual);
    for (std::size_t i = 0; i < n; ++i) search[i] = residual[i] + next / norm2 * search[i];
    norm2 = next;
  }
  double heat = 0;
  for (const WallFace& face : cells.walls.at(hot))
    heat += face.area / face.distance * (1.0 - temperature[face.element]);
  return heat;
}

TEST(CellsAtCuts, ConductThroughARingAsTheRingDoes) {
  SpecimenRecipe recipe;
  recipe.shape = "cylinder";
  recipe.axis = "z";
  recipe.radius = 1;
  recipe.length = 1;
  recipe.elements = 2500;
  recipe.cuts = {cylinder_cut({0, 0, 0}, 0.4, 2)};
  const Specimen specimen = make_specimen(recipe);
  const double exact = 2 * pi / std::log(1 / 0.4);
  EXPECT_NEAR(steady_heat_flow(specimen, tessellate(specimen), "cut_1", "side") / exact, 1, 0.005);
}

// The same by squares of a side, whose middles are the points: halving it shows how far it is off.
double heat_flow_by_squares(int per_unit) {
  const int columns = 4 * per_unit, rows = 2 * per_unit;
  const auto is_cut = [&](int i, int j) {
    const double x = (i + 0.5) / per_unit, y = (j + 0.5) / per_unit;
    return std::abs(x - 2) < 0.25 && y > 1;
  };
  Tessellation squares;
  Specimen specimen;
  std::map<std::pair<int, int>, std::int32_t> number;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      if (!is_cut(i, j)) number.emplace(std::pair(i, j), static_cast<std::int32_t>(number.size()));
  specimen.position.resize(number.size());
  for (const auto& [at, element] : number) {
    for (const auto& next :
         {std::pair(at.first + 1, at.second), std::pair(at.first, at.second + 1)})
      if (const auto other = number.find(next); other != number.end()) {
        squares.faces.push_back({element, other->second});
        squares.area.push_back(1);
        squares.distance.push_back(1);
      }
    if (at.first == 0) squares.walls["x_low"].push_back({element, 1, 0.5});
    if (at.first == columns - 1) squares.walls["x_high"].push_back({element, 1, 0.5});
  }
  return steady_heat_flow(specimen, squares, "x_low", "x_high");
}

TEST(CellsAtCuts, ConductPastANotchAsTheBarDoes) {
  const double coarse = heat_flow_by_squares(20), fine = heat_flow_by_squares(40);
  // At the corners of the notch the field is as r^(2/3): the error falls as the side to the 4/3.
  const double exact = fine + (fine - coarse) / (std::pow(2, 4.0 / 3) - 1);
  const Specimen specimen = make_specimen(notched_bar(3000));
  const double flow = steady_heat_flow(specimen, tessellate(specimen), "x_low", "x_high");
  EXPECT_NEAR(flow / exact, 1, 0.002);
  EXPECT_LT(exact, 1 / (3.5 / 2 + 0.5 / 1));  // what it would be if all lines were straight
}

TEST(CellsAtCuts, AreMadeOfWhatAFileKeeps) {
  SpecimenRecipe recipe = notched_bar(200);
  recipe.cuts.push_back(cylinder_cut({1, 1, 0.5}, 0.4, 2));
  recipe.cuts.push_back(mesh_cut(test::box_mesh({3, 1.2, -1}, {3.6, 3, 2})));
  const Specimen specimen = make_specimen(recipe);
  const std::string path = testing::TempDir() + "solidem_cells_at_cuts.h5";
  write_specimen(path, specimen);
  const Specimen read = read_specimen(path);
  std::remove(path.c_str());
  const Tessellation cells = tessellate(specimen), again = tessellate(read);
  EXPECT_EQ(again.faces, cells.faces);
  EXPECT_EQ(again.area, cells.area);
  EXPECT_EQ(again.volume, cells.volume);
  const std::string text = testing::TempDir() + "solidem_cells_at_cuts.csv";
  write_specimen(text, specimen);
  const Specimen bare = read_specimen(text);
  std::remove(text.c_str());
  try {
    tessellate(bare);
    ADD_FAILURE() << "expected a refusal";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("does not tell where its cuts are"),
              std::string::npos);
  }
}

TEST(CellsAtCuts, RefuseACentreThatTheOutlineDoesNotHold) {
  Specimen specimen = make_specimen(notched_bar(200));
  specimen.position[17] = {2, 1.8, 0.5};
  EXPECT_FALSE(has_cells(specimen));
  try {
    tessellate(specimen);
    ADD_FAILURE() << "expected a refusal";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("element 17"), std::string::npos) << error.what();
  }
}

}  // namespace solidem::cells_at_cuts_test
