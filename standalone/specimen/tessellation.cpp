// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/tessellation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "model/blocks.hpp"
#include "model/error.hpp"
#include "specimen/cell_maker.hpp"
#include "specimen/made_bodies.hpp"
#include "specimen/shape.hpp"

namespace solidem {

namespace {

constexpr double volume_tolerance = 1e-7;
constexpr double tolerance_at_round_cuts = 1e-5;  // facets end where such a cut does
constexpr double touching = 1.05;                 // in radii
constexpr std::size_t chunk_size = 512;

std::string place_of(const Specimen& specimen, std::size_t element) {
  const Vector& p = specimen.position[element];
  return fmt::format("element {} at ({:.6g}, {:.6g}, {:.6g}) m", element, p.x, p.y, p.z);
}

// Whether the volume of a body is that of its shape.
bool fills_its_shape(const Domain& domain) {
  const double expected = volume_of(domain);
  return std::abs(domain.volume - expected) <= 1e-9 * expected;
}

// Whether there is all that bounds a body.
bool has_outline(const Specimen& specimen) {
  const Domain& domain = specimen.domain;
  if (specimen.outline != nullptr) return domain.shape != "bodies";
  return domain.has_walls() && fills_its_shape(domain);
}

void check_inside(const Specimen& specimen, const ScaledBody& body, std::size_t element) {
  const Vector& point = body.position[element];
  for (std::size_t wall = 0; wall < body.walls_of_shape; ++wall)
    if (const double distance = body.walls[wall].distance(point); !(distance > 1e-9))
      throw InputError(
          fmt::format("cells: {} lies outside of the body, {:.3g} m beyond its wall {}: expected "
                      "centres inside",
                      place_of(specimen, element), -body.unit * distance, body.walls[wall].name));
  if (specimen.outline != nullptr && !specimen.outline->holds(specimen.position[element]))
    throw InputError(
        fmt::format("cells: {} lies outside of the mesh or within a cut of the body: expected "
                    "centres inside",
                    place_of(specimen, element)));
}

void check_body(const Specimen& specimen, const ScaledBody& body) {
  const Domain& domain = specimen.domain;
  if (domain.shape == "imported")
    throw InputError(
        "cells: the specimen's file does not say what shape its body has, without which there are "
        "no cells; give [specimen] shape and its measures");
  if (domain.shape == "bodies")
    throw InputError(
        "cells: there are none of several bodies in one file, of which it does not tell how they "
        "were made; expected the scene that makes them, or a platonic law");
  if (!domain.has_walls() && !body.outline)
    throw InputError(fmt::format(
        "cells: there are none of a {} whose file does not tell {}; expected the scene that makes "
        "it, a file that ends with .h5 of this version, or a platonic law",
        domain.shape, domain.cuts > 0 ? "where its cuts are" : "its facets"));
  if (!body.outline && !fills_its_shape(domain))
    throw InputError(fmt::format(
        "cells: the volume of the body is {:.9g} m3, but a {} of its dimensions has {:.9g} m3: "
        "expected a volume and a shape that agree",
        domain.volume, domain.shape, volume_of(domain)));
  for (std::size_t i = 0; i < body.position.size(); ++i) check_inside(specimen, body, i);
}

void check_bodies(const Specimen& specimen) {
  if (!bodies_are_known(specimen))
    throw InputError(
        "cells: the specimen's file does not say how its bodies were made and placed; expected the "
        "scene that makes them, a file of this version, or a platonic law");
}

// Both sides of a face differ by round-off: their mean counts.
void join_sides(const std::vector<CellChunk>& chunks, double unit, Tessellation& result) {
  const auto sides_of = [&](std::size_t element) {
    const CellChunk& chunk = chunks[element / chunk_size];
    const std::size_t k = element % chunk_size;
    return std::pair(chunk.sides.data() + chunk.first[k], chunk.sides.data() + chunk.first[k + 1]);
  };
  for (std::size_t i = 0; i < result.volume.size(); ++i) {
    const auto [begin, end] = sides_of(i);
    const auto element = static_cast<std::int32_t>(i);
    for (const CellSide* here = begin; here != end; ++here) {
      if (here->other < element) continue;
      const auto [low, high] = sides_of(static_cast<std::size_t>(here->other));
      const CellSide* const there = std::lower_bound(
          low, high, element, [](const CellSide& side, std::int32_t e) { return side.other < e; });
      if (there == high || there->other != element) continue;
      const double area = 0.5 * (here->area + there->area);
      if (!(area > smallest_face)) continue;
      const double conducted = 0.5 * (here->area_over_distance + there->area_over_distance);
      result.faces.push_back({element, here->other});
      result.area.push_back(unit * unit * area);
      result.distance.push_back(unit * area / conducted);
    }
  }
}

bool has_round_cut(const Specimen& specimen) {
  if (specimen.outline == nullptr) return false;
  const std::vector<Cut>& cuts = specimen.outline->cuts;
  return !cuts.empty() &&
         (specimen.domain.radius > 0 || std::any_of(cuts.begin(), cuts.end(), [](const Cut& cut) {
            return cut.mesh == nullptr && cut.part.kind != Shape::Kind::box;
          }));
}

// Cells fill the body but for round-off, and for what the facets of round surfaces miss where these
// end at others: that is shared out.
void scale_volumes(const Specimen& specimen, std::vector<double>& volumes, double unit) {
  const double filled = std::accumulate(volumes.begin(), volumes.end(), 0.0) * unit * unit * unit;
  const double whole = specimen.domain.volume;
  const double tolerance = has_round_cut(specimen) ? tolerance_at_round_cuts : volume_tolerance;
  if (!(std::abs(filled / whole - 1.0) < tolerance))
    throw RunError(fmt::format(
        "cells: those of all elements fill {:.9g} of the body, not all of it", filled / whole));
  for (double& volume : volumes) volume *= unit * unit * unit * whole / filled;
}

double sum_of_areas(const std::vector<WallFace>& faces) {
  return std::accumulate(faces.begin(), faces.end(), 0.0,
                         [](double sum, const WallFace& face) { return sum + face.area; });
}

// The areas of walls that are whole are known. Those that are not are as exact as the cells, with
// the areas of round surfaces in place of their facets'.
void scale_walls(const ScaledBody& body, Tessellation& result) {
  const double unit = body.unit;
  for (std::size_t wall = 0; wall < body.walls.size(); ++wall) {
    std::vector<WallFace>& faces = result.walls[body.walls[wall].name];
    double scale = unit * unit;
    if (!body.outline)
      scale = unit * unit * body.walls[wall].area / sum_of_areas(faces);
    else if (wall < body.walls_of_shape && body.walls[wall].radius > 0)
      scale *= body.shrink_of(wall);
    for (WallFace& face : faces) {
      face.area *= scale;
      face.distance *= unit;
    }
  }
}

// A solid of an element of a body, in metres and at its place.
Polyhedron at_place(Polyhedron solid, double unit, const Specimen& whole, const MadeBody& made,
                    std::int32_t element) {
  for (std::vector<Vector>& face : solid.faces)
    for (Vector& p : face) p = made.at(whole, element, unit * p);
  return solid;
}

bool boxes_meet(const Polyhedron& solid, const Vector& lower, const Vector& upper) {
  const auto [from, to] = bounds(solid);
  return from.x <= upper.x && to.x >= lower.x && from.y <= upper.y && to.y >= lower.y &&
         from.z <= upper.z && to.z >= lower.z;
}

// Calls work(maker, element, chunk) for each element, with a maker for each thread.
template <class Work>
void for_each_cell(const ScaledBody& body, std::size_t elements, const Work& work) {
  const std::size_t chunks = (elements + chunk_size - 1) / chunk_size;
  for_each_part_with(
      chunks, chunks > 4, [&] { return CellMaker(body); },
      [&](CellMaker& maker, std::size_t chunk) {
        const std::size_t begin = chunk * chunk_size;
        for (std::size_t i = begin; i < std::min(begin + chunk_size, elements); ++i)
          work(maker, i, chunk);
      });
}

// Gathers what take(made, body, maker, element, into) makes of each cell, in the order of elements.
template <class Take>
std::vector<CellSolid> gather_solids(const Specimen& specimen, const Take& take) {
  check_bodies(specimen);
  std::vector<CellSolid> all;
  for_each_made_body(specimen, [&](const MadeBody& made) {
    const ScaledBody body(made.specimen);
    check_body(made.specimen, body);
    const std::size_t n = made.specimen.size();
    std::vector<std::vector<CellSolid>> chunks((n + chunk_size - 1) / chunk_size);
    for_each_cell(body, n, [&](CellMaker& maker, std::size_t i, std::size_t chunk) {
      CellChunk unused;
      const auto element = static_cast<std::int32_t>(i);
      if (!(maker.make(element, unused) > 0)) return;
      take(made, body, maker, element, chunks[chunk]);
    });
    for (std::vector<CellSolid>& chunk : chunks)
      all.insert(all.end(), std::make_move_iterator(chunk.begin()),
                 std::make_move_iterator(chunk.end()));
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const CellSolid& a, const CellSolid& b) { return a.element < b.element; });
  return all;
}

bool one_has_cells(const Specimen& specimen) {
  if (!has_outline(specimen)) return false;
  const std::vector<Wall> walls = walls_of_shape(specimen.domain);
  return std::all_of(specimen.position.begin(), specimen.position.end(), [&](const Vector& p) {
    return std::all_of(walls.begin(), walls.end(),
                       [&](const Wall& wall) { return wall.distance(p) > 0; }) &&
           (specimen.outline == nullptr || specimen.outline->holds(p));
  });
}

// The cells of a single body.
Tessellation cells_of_one(const Specimen& specimen) {
  const ScaledBody body(specimen);
  check_body(specimen, body);
  const std::size_t n = specimen.size();
  Tessellation result;
  result.volume.resize(n);
  std::vector<CellChunk> chunks((n + chunk_size - 1) / chunk_size);
  for_each_cell(body, n, [&](CellMaker& maker, std::size_t i, std::size_t chunk) {
    result.volume[i] = maker.make(static_cast<std::int32_t>(i), chunks[chunk]);
  });
  for (std::size_t i = 0; i < n; ++i)
    if (!(result.volume[i] > 0))
      throw InputError(fmt::format(
          "cells: {} with radius {:.4g} m has no cell: larger spheres around it, or another in its "
          "place, leave none; expected spheres that overlap by less than their radii",
          place_of(specimen, i), specimen.radius[i]));
  join_sides(chunks, body.unit, result);
  for (const CellChunk& chunk : chunks)
    for (const CellWall& side : chunk.walls)
      result.walls[body.walls[side.wall].name].push_back(side.face);
  scale_volumes(specimen, result.volume, body.unit);
  scale_walls(body, result);
  return result;
}

// Adds the cells of one of several bodies to those of all, whose faces are not in order.
void add_cells(const MadeBody& made, const Tessellation& own, Tessellation& all) {
  for (std::size_t i = 0; i < own.volume.size(); ++i)
    all.volume[static_cast<std::size_t>(made.element(static_cast<std::int32_t>(i)))] =
        own.volume[i];
  for (std::size_t f = 0; f < own.faces.size(); ++f) {
    all.faces.push_back({made.element(own.faces[f].i), made.element(own.faces[f].j)});
    all.area.push_back(own.area[f]);
    all.distance.push_back(own.distance[f]);
  }
  for (const auto& [name, faces] : own.walls) {
    std::vector<WallFace>& wall = all.walls[made.wall(name)];
    for (const WallFace& face : faces)
      wall.push_back({made.element(face.element), face.area, face.distance});
  }
}

void sort_faces(Tessellation& cells) {
  std::vector<std::size_t> order(cells.faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return cells.faces[a] < cells.faces[b]; });
  Tessellation sorted;
  for (const std::size_t f : order) {
    sorted.faces.push_back(cells.faces[f]);
    sorted.area.push_back(cells.area[f]);
    sorted.distance.push_back(cells.distance[f]);
  }
  cells.faces = std::move(sorted.faces);
  cells.area = std::move(sorted.area);
  cells.distance = std::move(sorted.distance);
}

}  // namespace

bool has_cells(const Specimen& specimen) {
  bool all = bodies_are_known(specimen);
  if (!all) return false;
  for_each_made_body(specimen,
                     [&](const MadeBody& made) { all = all && one_has_cells(made.specimen); });
  return all;
}

std::vector<CellSolid> cell_solids(const Specimen& specimen, const Vector& lower,
                                   const Vector& upper) {
  return gather_solids(specimen, [&](const MadeBody& made, const ScaledBody& body, CellMaker& maker,
                                     std::int32_t element, std::vector<CellSolid>& into) {
    std::vector<CellSolid> solids;
    bool is_met = false;
    for (const CellPart& part : maker.parts()) {
      solids.push_back({made.element(element),
                        at_place(part.solid, body.unit, specimen, made, element), part.sign < 0});
      is_met = is_met || boxes_meet(solids.back().solid, lower, upper);
    }
    if (is_met)
      into.insert(into.end(), std::make_move_iterator(solids.begin()),
                  std::make_move_iterator(solids.end()));
  });
}

std::vector<CellSolid> wall_slabs(const Specimen& specimen, const std::string& wall,
                                  double thickness) {
  return gather_solids(specimen, [&](const MadeBody& made, const ScaledBody& body, CellMaker& maker,
                                     std::int32_t element, std::vector<CellSolid>& into) {
    for (const CellPart& part : maker.parts())
      for (std::size_t k = 0; k < part.faces.size(); ++k) {
        const std::size_t number = maker.wall_of(part.faces[k]);
        if (number == body.walls.size() || made.wall(body.walls[number].name) != wall) continue;
        const Polyhedron face =
            at_place({{part.solid.faces[k]}}, body.unit, specimen, made, element);
        into.push_back(
            {made.element(element), slab_of(face.faces[0], thickness), part.faces[k].weight < 0});
      }
  });
}

Tessellation tessellate(const Specimen& specimen) {
  if (specimen.bodies.empty()) return cells_of_one(specimen);
  check_bodies(specimen);
  Tessellation all;
  all.volume.resize(specimen.size());
  for_each_made_body(
      specimen, [&](const MadeBody& made) { add_cells(made, cells_of_one(made.specimen), all); });
  sort_faces(all);
  return all;
}

std::map<std::string, std::vector<WallFace>> touching_elements(const Specimen& specimen) {
  std::map<std::string, std::vector<WallFace>> result;
  for (const Wall& wall : walls_of(specimen.domain)) {
    std::vector<WallFace>& faces = result[wall.name];
    double sum = 0;
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const double radius = specimen.radius[i], distance = wall.distance(specimen.position[i]);
      if (!(distance <= touching * radius)) continue;
      faces.push_back({static_cast<std::int32_t>(i), radius * radius,
                       wall.conduction_length(specimen.position[i])});
      sum += radius * radius;
    }
    for (WallFace& face : faces) face.area *= wall.area / sum;
  }
  return result;
}

}  // namespace solidem
