// SPDX-License-Identifier: GPL-2.0-or-later
//
// Cells of crystals are known polyhedra. Cells of any specimen fill the body and are closed, which
// makes linear temperature fields exact: no element heats up, and the flux is that of the solid.
#include "specimen/tessellation.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numeric>

#include "model/error.hpp"
#include "specimen/crystal.hpp"
#include "specimen/recipe.hpp"

namespace solidem::tessellation_test {

Specimen crystal(const std::string& lattice, std::array<int, 3> cells, bool periodic,
                 double radius = 1.3e-4) {
  SpecimenRecipe recipe;
  recipe.shape = "crystal";
  recipe.lattice = lattice;
  recipe.cells = cells;
  recipe.element_radius = radius;
  recipe.periodic = {periodic, periodic, periodic};
  recipe.origin = {1e-3, 0.2, -3e-3};
  return make_crystal(recipe);
}

// Elements off their sites and of different size.
Specimen shaken_crystal(int cells, bool periodic) {
  Specimen specimen = crystal("simple_cubic", {cells, cells, cells}, periodic);
  const double radius = specimen.radius[0];
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double phase = static_cast<double>(i);
    specimen.position[i] +=
        0.5 * radius * Vector{std::sin(phase), std::sin(2.3 * phase), std::sin(4.1 * phase)};
    specimen.radius[i] *= 1.0 + 0.2 * std::sin(5.7 * phase);
  }
  return specimen;
}

const Specimen& packing(const std::string& shape) {
  static std::map<std::string, Specimen> made;
  if (made.count(shape)) return made.at(shape);
  SpecimenRecipe recipe;
  recipe.shape = shape;
  recipe.size = {2e-3, 1e-3, 3e-3};
  recipe.axis = "z";
  recipe.length = 2e-3;
  recipe.radius = 1e-3;
  recipe.inner_radius = 0.4e-3;
  recipe.angle = 2.0;
  recipe.elements = 800;
  recipe.origin = {0.1, -0.2, 0.05};
  return made.emplace(shape, make_specimen(recipe)).first->second;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double total_area(const std::vector<WallFace>& faces) {
  double area = 0;
  for (const WallFace& face : faces) area += face.area;
  return area;
}

Vector unit_chord(const Specimen& specimen, Pair pair) {
  const Vector chord = rest_chord(specimen, pair);
  return (1.0 / norm(chord)) * chord;
}

// Σ area × outward normal of each cell, in squared mean radii. Curved walls have no normal along
// the axis.
std::vector<Vector> openings(const Specimen& specimen, const Tessellation& cells) {
  const double unit = std::pow(mean_radius(specimen), -2);
  std::vector<Vector> opening(specimen.size());
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    const Pair pair = cells.faces[f];
    const Vector face = unit * cells.area[f] * unit_chord(specimen, pair);
    opening[pair.i] += face;
    opening[pair.j] -= face;
  }
  for (const Wall& wall : walls_of(specimen.domain))
    for (const WallFace& face : cells.walls.at(wall.name))
      if (!(wall.radius > 0)) opening[face.element] += unit * face.area * wall.direction;
  return opening;
}

// Flux through the body for a unit temperature gradient along an axis, over that of the solid:
// Σ A d n² over faces and Σ A d over the walls across the axis, by volume.
double relative_conductivity(const Specimen& specimen, const Tessellation& cells, int axis) {
  double flux = 0;
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    const double n = component(unit_chord(specimen, cells.faces[f]), axis);
    flux += cells.area[f] * cells.distance[f] * n * n;
  }
  for (const char* side : {"_low", "_high"}) {
    const auto wall = cells.walls.find(std::string(1, "xyz"[axis]) + side);
    if (wall == cells.walls.end()) continue;
    for (const WallFace& face : wall->second) flux += face.area * face.distance;
  }
  return flux / specimen.domain.volume;
}

TEST(Tessellation, SimpleCubicCellsAreCubes) {
  const Specimen specimen = crystal("simple_cubic", {4, 3, 2}, false);
  const double R = specimen.radius[0];
  const Tessellation cells = tessellate(specimen);
  EXPECT_EQ(cells.faces.size(), 3u * 6 + 2 * 8 + 1 * 12);
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    EXPECT_NEAR(cells.area[f], 4 * R * R, 1e-12 * R * R);
    EXPECT_NEAR(cells.distance[f], 2 * R, 1e-12 * R);
  }
  for (const double volume : cells.volume) EXPECT_NEAR(volume, 8 * R * R * R, 1e-11 * R * R * R);
  ASSERT_EQ(cells.walls.size(), 6u);
  EXPECT_EQ(cells.walls.at("y_high").size(), 8u);
  for (const auto& [name, faces] : cells.walls)
    for (const WallFace& face : faces) {
      EXPECT_NEAR(face.area, 4 * R * R, 1e-12 * R * R) << name;
      EXPECT_NEAR(face.distance, R, 1e-11 * R) << name;
    }
}

TEST(Tessellation, FaceCentredCellsAreRhombicDodecahedra) {
  const Specimen specimen = crystal("fcc", {3, 4, 5}, true);
  const double R = specimen.radius[0];
  const Tessellation cells = tessellate(specimen);
  EXPECT_EQ(cells.faces.size(), 12 * specimen.size() / 2);
  const double volume = 4 * std::sqrt(2.0) * R * R * R;
  for (const double v : cells.volume) EXPECT_NEAR(v, volume, 1e-11 * volume);
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    EXPECT_NEAR(cells.area[f], volume / (4 * R), 1e-10 * R * R);
    EXPECT_NEAR(cells.distance[f], 2 * R, 1e-11 * R);
  }
}

TEST(Tessellation, BodyCentredCellsAreTruncatedOctahedra) {
  const Specimen specimen = crystal("bcc", {4, 3, 3}, true);
  const double side = 4 / std::sqrt(3.0) * specimen.radius[0];
  const Tessellation cells = tessellate(specimen);
  std::size_t hexagons = 0, squares = 0;
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    const bool near = cells.distance[f] < 0.9 * side;
    ++(near ? hexagons : squares);
    EXPECT_NEAR(cells.distance[f], near ? std::sqrt(0.75) * side : side, 1e-11 * side);
    EXPECT_NEAR(cells.area[f], (near ? std::sqrt(27.0) / 16 : 0.125) * side * side,
                1e-10 * side * side);
  }
  EXPECT_EQ(hexagons, 4 * specimen.size());
  EXPECT_EQ(squares, 3 * specimen.size());
}

TEST(Tessellation, TwoSpheresMeetInTheirRadicalPlane) {
  Specimen specimen;
  specimen.domain.shape = "box";
  specimen.domain.upper = {8, 3, 2};
  specimen.domain.volume = 48;
  specimen.position = {{2, 1.5, 1}, {5, 1.5, 1}};
  specimen.radius = {2, 1};
  const Tessellation cells = tessellate(specimen);
  const double plane = 2 + (3 * 3 + 2 * 2 - 1 * 1) / 6.0;
  ASSERT_EQ(cells.faces.size(), 1u);
  EXPECT_NEAR(cells.area[0], 6, 1e-12);
  EXPECT_NEAR(cells.distance[0], 3, 1e-12);
  EXPECT_NEAR(cells.volume[0], 6 * plane, 1e-11);
  EXPECT_NEAR(cells.volume[1], 6 * (8 - plane), 1e-11);
}

TEST(Tessellation, PairThatMeetsOnBothSidesHasBothFaces) {
  const Specimen specimen = crystal("simple_cubic", {2, 2, 3}, true);
  const double R = specimen.radius[0];
  const Tessellation cells = tessellate(specimen);
  EXPECT_EQ(cells.faces.size(), 12u * 4 / 2);  // two neighbours met twice, two met once
  for (std::size_t f = 0; f < cells.faces.size(); ++f) {
    const Vector chord = rest_chord(specimen, cells.faces[f]);
    EXPECT_NEAR(cells.area[f], (std::abs(chord.z) > R ? 4 : 8) * R * R, 1e-11 * R * R);
    EXPECT_NEAR(cells.distance[f], 2 * R, 1e-11 * R);
  }
}

TEST(Tessellation, LinearFieldsAreExactInFlatBodies) {
  for (const Specimen& specimen : {shaken_crystal(8, false), shaken_crystal(8, true),
                                   crystal("bcc", {3, 3, 3}, false), packing("box")}) {
    const Tessellation cells = tessellate(specimen);
    for (const Vector& opening : openings(specimen, cells)) EXPECT_LT(norm(opening), 1e-9);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(relative_conductivity(specimen, cells, axis), 1, 1e-10);
  }
}

TEST(Tessellation, LinearFieldsAlongTheAxisAreExactInRoundBodies) {
  for (const char* shape : {"cylinder", "annulus", "wedge"}) {
    const Specimen& specimen = packing(shape);
    const Tessellation cells = tessellate(specimen);
    for (const Vector& opening : openings(specimen, cells))
      EXPECT_LT(std::abs(opening.z), 1e-9) << shape;
    EXPECT_NEAR(relative_conductivity(specimen, cells, 2), 1, 1e-10) << shape;
  }
}

TEST(Tessellation, CellsOfRoundBodiesAreClosedAwayFromCurvedWalls) {
  for (const char* shape : {"cylinder", "annulus", "wedge"}) {
    const Specimen& specimen = packing(shape);
    const Tessellation cells = tessellate(specimen);
    std::vector<bool> at_wall(specimen.size());
    for (const auto& [name, faces] : cells.walls)
      for (const WallFace& face : faces) at_wall[face.element] = true;
    const std::vector<Vector> opening = openings(specimen, cells);
    int inside = 0;
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      if (at_wall[i]) continue;
      ++inside;
      EXPECT_LT(norm(opening[i]), 1e-9) << shape;
    }
    EXPECT_GT(inside, 100) << shape;
  }
}

TEST(Tessellation, VolumesAndWallsAreTheBodys) {
  for (const char* shape : {"box", "cylinder", "annulus", "wedge"}) {
    const Specimen& specimen = packing(shape);
    const Tessellation cells = tessellate(specimen);
    const double volume = specimen.domain.volume;
    EXPECT_NEAR(sum(cells.volume), volume, 1e-13 * volume) << shape;
    for (const Wall& wall : walls_of(specimen.domain)) {
      const std::vector<WallFace>& faces = cells.walls.at(wall.name);
      EXPECT_NEAR(total_area(faces), wall.area, 1e-12 * wall.area) << shape << ' ' << wall.name;
      for (const WallFace& face : faces)
        EXPECT_NEAR(face.distance, wall.conduction_length(specimen.position[face.element]),
                    1e-12 * specimen.domain.upper.z);
    }
    EXPECT_EQ(cells.walls.size(), walls_of(specimen.domain).size());
  }
}

TEST(Walls, OfAWedge) {
  Domain wedge = packing("wedge").domain;
  const double r = 0.4e-3, R = 1e-3, L = 2e-3, angle = 2.0;
  std::map<std::string, double> area;
  for (const Wall& wall : walls_of(wedge)) area[wall.name] = wall.area;
  EXPECT_EQ(area.size(), 6u);
  EXPECT_NEAR(area.at("z_low"), angle / 2 * (R * R - r * r), 1e-20);
  EXPECT_NEAR(area.at("inner"), angle * r * L, 1e-20);
  EXPECT_NEAR(area.at("outer"), angle * R * L, 1e-20);
  EXPECT_NEAR(area.at("first"), (R - r) * L, 1e-20);
  EXPECT_NEAR(area.at("last"), (R - r) * L, 1e-20);
  wedge.periodic[2] = true;
  EXPECT_EQ(wall_names(wedge), (std::vector<std::string>{"inner", "outer", "first", "last"}));
  EXPECT_EQ(wall_names(packing("cylinder").domain),
            (std::vector<std::string>{"z_low", "z_high", "side"}));
}

// Steady temperatures, inner wall at 1 and outer wall at 0, and the heat that flows per
// conductivity.
double steady_heat_flow(const Specimen& specimen, const Tessellation& cells) {
  const std::size_t n = specimen.size();
  std::vector<double> to_walls(n), source(n), temperature(n), residual, search, image(n);
  for (const char* wall : {"inner", "outer"})
    for (const WallFace& face : cells.walls.at(wall)) {
      to_walls[face.element] += face.area / face.distance;
      if (std::string(wall) == "inner") source[face.element] += face.area / face.distance;
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
  for (const WallFace& face : cells.walls.at("inner"))
    heat += face.area / face.distance * (1.0 - temperature[face.element]);
  return heat;
}

TEST(Tessellation, RadialHeatFlowIsThatOfTheAnnulus) {
  const double R = 1e-3, r = 0.4e-3, L = 2e-3;
  for (const char* shape : {"annulus", "wedge"}) {
    const Specimen& specimen = packing(shape);
    const double exact = specimen.domain.arc() * L / std::log(R / r);
    EXPECT_NEAR(steady_heat_flow(specimen, tessellate(specimen)) / exact, 1, 0.005) << shape;
  }
}

TEST(Tessellation, MirrorImageHasTheSameFaces) {
  const Specimen specimen = shaken_crystal(6, false);
  Specimen mirrored = specimen;
  const double middle = specimen.domain.lower.x + specimen.domain.upper.x;
  for (Vector& p : mirrored.position) p.x = middle - p.x;
  const Tessellation cells = tessellate(specimen), images = tessellate(mirrored);
  ASSERT_EQ(images.faces, cells.faces);
  const double R2 = std::pow(mean_radius(specimen), 2);
  for (std::size_t f = 0; f < cells.faces.size(); ++f)
    EXPECT_NEAR(images.area[f], cells.area[f], 1e-9 * R2);
}

TEST(Tessellation, LengthsHaveNoScale) {
  Specimen specimen = shaken_crystal(6, false);
  const Tessellation cells = tessellate(specimen);
  const double scale = 1e-7;
  for (Vector& p : specimen.position) p = scale * p;
  for (double& r : specimen.radius) r *= scale;
  specimen.domain.lower = scale * specimen.domain.lower;
  specimen.domain.upper = scale * specimen.domain.upper;
  specimen.domain.volume *= std::pow(scale, 3);
  const Tessellation small = tessellate(specimen);
  ASSERT_EQ(small.faces, cells.faces);
  const double R = mean_radius(specimen);
  for (std::size_t f = 0; f < cells.faces.size(); ++f)
    EXPECT_NEAR(small.area[f], scale * scale * cells.area[f], 1e-9 * R * R);
  EXPECT_EQ(small.walls.at("z_low").size(), cells.walls.at("z_low").size());
}

TEST(Tessellation, SameOnAnyNumberOfThreads) {
  const Specimen specimen = shaken_crystal(15, true);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Tessellation alone = tessellate(specimen);
  omp_set_num_threads(3);
  const Tessellation together = tessellate(specimen);
  omp_set_num_threads(before);
  EXPECT_EQ(together.faces, alone.faces);
  EXPECT_EQ(together.area, alone.area);
  EXPECT_EQ(together.distance, alone.distance);
  EXPECT_EQ(together.volume, alone.volume);
}

TEST(TouchingElements, ShareEveryWall) {
  for (const char* shape : {"box", "cylinder", "annulus", "wedge"}) {
    const Specimen& specimen = packing(shape);
    const auto walls = touching_elements(specimen);
    const std::vector<Wall> all = walls_of(specimen.domain);
    EXPECT_EQ(walls.size(), all.size());
    for (const Wall& wall : all) {
      const std::vector<WallFace>& faces = walls.at(wall.name);
      ASSERT_GE(faces.size(), 10u) << shape << ' ' << wall.name;
      EXPECT_NEAR(total_area(faces), wall.area, 1e-12 * wall.area) << shape << ' ' << wall.name;
      const double first = specimen.radius[faces[0].element];
      for (const WallFace& face : faces) {
        const double radius = specimen.radius[face.element];
        EXPECT_LE(wall.distance(specimen.position[face.element]), 1.05 * radius);
        EXPECT_NEAR(face.area / faces[0].area, radius * radius / (first * first), 1e-12);
      }
    }
  }
}

void expect_refusal(const Specimen& specimen, const std::vector<std::string>& texts) {
  try {
    tessellate(specimen);
    ADD_FAILURE() << "no error; expected one with: " << texts[0];
  } catch (const InputError& error) {
    for (const std::string& text : texts)
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(Tessellation, NamesTheElementThatCanHaveNoCell) {
  const Specimen right = crystal("simple_cubic", {3, 3, 3}, false, 1.0);
  Specimen specimen = right;
  specimen.position[7].z = -3.5e-3;
  expect_refusal(specimen, {"element 7 at", "outside of the body", "wall z_low"});
  specimen = right;
  specimen.position.push_back(specimen.position[13] + Vector{0.2, 0.1, 0});
  specimen.radius.push_back(0.3);
  expect_refusal(specimen, {"element 27 at", "radius 0.3 m", "larger spheres around"});
  specimen = right;
  specimen.position.push_back(specimen.position[13]);
  specimen.radius.push_back(specimen.radius[13]);
  expect_refusal(specimen, {"element 13 at", "another in its place"});
  specimen = right;
  specimen.domain.volume *= 0.9;
  expect_refusal(specimen, {"volume of the body", "a crystal of its dimensions"});
  specimen.domain.shape = "imported";
  expect_refusal(specimen, {"what shape its body has", "[specimen] shape"});
}

}  // namespace solidem::tessellation_test
