// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/tessellation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <voro++/voro++.hh>

#include "model/blocks.hpp"
#include "model/error.hpp"
#include "specimen/shape.hpp"

namespace solidem {

namespace {

// Lengths in here are in mean radii: voro++ takes points within 1e-11 of a plane to lie on it.
constexpr double smallest_area = 1e-10;   // faces below are round-off
constexpr double largest_sagitta = 2e-3;  // of the facets of curved walls
constexpr double volume_tolerance = 1e-7;
constexpr double touching = 1.05;  // in radii
constexpr double elements_per_block = 5.0;
constexpr std::size_t chunk_size = 512;
constexpr int first_wall_id = -11;  // voro++ numbers the planes of its box −1 to −6

// What a cell shows of a neighbour, or of a wall.
struct Side {
  std::int32_t other;
  double area, area_over_distance;
};
struct WallSide {
  std::size_t wall;
  WallFace face;
};

// Some elements' cells, one after the other.
struct Chunk {
  std::vector<std::size_t> first{0};  // of an element's sides; one more at the end
  std::vector<Side> sides;            // of each element by rising neighbour
  std::vector<WallSide> walls;
};

// A curved wall as flat facets, the same for all cells. They cut the circle, so that the section's
// area is the circle's.
struct Facets {
  double distance = 0;         // from the axis
  std::vector<Vector> normal;  // away from the axis
};

Facets facets_of(const Domain& body, double radius) {
  const double arc = body.arc();
  // A facet that turns by β has the sagitta R β²/8.
  const double turn = std::min(std::sqrt(8.0 * largest_sagitta / radius), 0.2);
  const int count = static_cast<int>(std::ceil(arc / turn));
  const double half = 0.5 * arc / count;
  Facets facets;
  facets.distance = radius * std::sqrt(half / std::tan(half));
  for (int k = 0; k < count; ++k) {
    const double angle = (2 * k + 1) * half;
    facets.normal.push_back(std::cos(angle) * body.first_transverse() +
                            std::sin(angle) * body.second_transverse());
  }
  return facets;
}

// Volume of the solid whose faces touch a unit sphere, one across each direction.
double volume_around_unit_sphere(const std::vector<Vector>& normals) {
  voro::voronoicell solid;
  solid.init(-2, 2, -2, 2, -2, 2);
  for (const Vector& n : normals) solid.plane(n.x, n.y, n.z, 2.0);
  return solid.volume();
}

// The same for a sphere; facets stand where their solid has the sphere's volume.
Facets facets_of_sphere(const Domain& body) {
  // The n-th part of the sphere has the sagitta 2 R / n.
  Facets facets;
  facets.normal = even_directions(
      std::max(500, static_cast<int>(std::ceil(2.0 * body.radius / largest_sagitta))));
  facets.distance = std::cbrt(body.volume / volume_around_unit_sphere(facets.normal));
  return facets;
}

// The specimen in mean radii, its lower corner at the origin.
struct ScaledBody {
  double unit;
  Domain domain;
  std::vector<Vector> position;
  std::vector<double> radius;
  std::vector<Wall> walls;
  Facets outer, inner;  // of curved walls

  explicit ScaledBody(const Specimen& specimen)
      : unit(mean_radius(specimen)), domain(scaled(specimen.domain, unit)) {
    for (const Vector& p : specimen.position)
      position.push_back((1.0 / unit) * (p - specimen.domain.lower));
    for (const double r : specimen.radius) radius.push_back(r / unit);
    walls = walls_of(domain);
    if (domain.radius > 0)
      outer = domain.is_sphere() ? facets_of_sphere(domain) : facets_of(domain, domain.radius);
    if (domain.inner_radius > 0) inner = facets_of(domain, domain.inner_radius);
  }

  std::size_t wall_called(const std::string& name) const {
    std::size_t wall = 0;
    while (wall < walls.size() && walls[wall].name != name) ++wall;
    return wall;
  }
};

// Makes one cell after the other; each thread has its own, for voro++ keeps notes while it works.
class CellMaker {
 public:
  explicit CellMaker(const ScaledBody& body) : body_(body), place_(body.position.size()) {
    const Domain& domain = body.domain;
    Vector low = domain.lower, high = domain.upper;
    // Corners of the facets stand out of the bounding box.
    for (int axis = 0; axis < 3; ++axis)
      if (domain.radius > 0 && axis != domain.axis) {
        component(low, axis) -= 1.0;
        component(high, axis) += 1.0;
      }
    const double per_length =
        std::cbrt(static_cast<double>(place_.size()) / (elements_per_block * domain.volume));
    std::array<int, 3> blocks{};
    for (int axis = 0; axis < 3; ++axis)
      blocks[axis] = static_cast<int>(component(high - low, axis) * per_length) + 1;
    container_ = std::make_unique<voro::container_poly>(
        low.x, high.x, low.y, high.y, low.z, high.z, blocks[0], blocks[1], blocks[2],
        domain.periodic[0], domain.periodic[1], domain.periodic[2], 8);
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const Vector& p = body.position[i];
      container_->put(static_cast<int>(i), p.x, p.y, p.z, body.radius[i]);
    }
    for (int block = 0; block < container_->nxyz; ++block)
      for (int k = 0; k < container_->co[block]; ++k) place_[container_->id[block][k]] = {block, k};
    add_walls();
  }

  // Adds the element to the chunk; returns the volume of its cell, 0 when it has none.
  double make(std::int32_t element, Chunk& chunk) {
    const auto [block, k] = place_[element];
    is_holed_ = false;
    if (!container_->compute_cell(cell_, block, k)) return 0;
    element_ = element;
    sides_.clear();
    wall_area_.assign(body_.walls.size(), 0.0);
    // The body is convex but for an inner wall, and that is the outside of a convex hole.
    if (!body_.outer.normal.empty() && !keep_inside(cell_, body_.outer, outer_)) return 0;
    double volume = cell_.volume();
    add_faces(cell_, 1.0);
    if (!body_.inner.normal.empty() && reaches_hole()) {
      in_hole_ = cell_;
      if (keep_inside(in_hole_, body_.inner, inner_)) {
        is_holed_ = true;
        volume -= in_hole_.volume();
        add_faces(in_hole_, -1.0);
      }
    }
    store(chunk);
    return volume;
  }

  // Calls visit(faces, walls, in hole) for the solids of the cell made last: faces in mean radii,
  // and the wall that each lies on or the number of walls.
  template <class Visit>
  void visit_solids(const Visit& visit) {
    visit_solid(cell_, false, visit);
    if (is_holed_) visit_solid(in_hole_, true, visit);
  }

 private:
  using Cell = voro::voronoicell_neighbor;

  template <class Visit>
  void visit_solid(Cell& cell, bool is_in_hole, const Visit& visit) {
    const Vector& p = body_.position[element_];
    std::vector<int> corners;
    cell.vertices(p.x, p.y, p.z, numbers_);
    cell.face_vertices(corners);
    cell.neighbors(others_);
    const auto vertex = [&](int k) {
      return Vector{numbers_[3 * k], numbers_[3 * k + 1], numbers_[3 * k + 2]};
    };
    Polyhedron solid;
    std::vector<std::size_t> walls;
    std::size_t at = 0;
    for (const int other : others_) {
      std::vector<Vector> face;
      for (int left = corners[at++]; left > 0; --left) face.push_back(vertex(corners[at++]));
      std::reverse(face.begin(), face.end());  // voro++ goes clockwise
      solid.faces.push_back(std::move(face));
      walls.push_back(other < 0 ? wall_of(other) : body_.walls.size());
    }
    visit(solid, walls, is_in_hole);
  }

  void add_walls() {
    static const char* const box[] = {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"};
    for (int side = 0; side < 6; ++side) box_wall_[side] = body_.wall_called(box[side]);
    const Domain& domain = body_.domain;
    outer_ = body_.wall_called(domain.is_sphere()        ? "surface"
                               : domain.inner_radius > 0 ? "outer"
                                                         : "side");
    inner_ = body_.wall_called("inner");
    for (const char* name : {"first", "last"}) {
      const std::size_t wall = body_.wall_called(name);
      if (wall == body_.walls.size()) continue;
      const Vector& n = body_.walls[wall].direction;
      voro_walls_.push_back(std::make_unique<voro::wall_plane>(
          n.x, n.y, n.z, dot(n, body_.walls[wall].point), id_of(wall)));
    }
    if (outer_ < body_.walls.size()) {
      // Outside of all facets, to keep cells small while they are made.
      const Wall& wall = body_.walls[outer_];
      const Vector &p = wall.point, &a = wall.direction;
      const double far = wall.radius + 0.5;
      if (domain.is_sphere())
        voro_walls_.push_back(
            std::make_unique<voro::wall_sphere>(p.x, p.y, p.z, far, id_of(outer_)));
      else
        voro_walls_.push_back(std::make_unique<voro::wall_cylinder>(p.x, p.y, p.z, a.x, a.y, a.z,
                                                                    far, id_of(outer_)));
    }
    for (const auto& wall : voro_walls_) container_->add_wall(wall.get());
  }

  static int id_of(std::size_t wall) { return first_wall_id - static_cast<int>(wall); }

  std::size_t wall_of(int id) const {
    return id > first_wall_id ? box_wall_[-1 - id] : static_cast<std::size_t>(first_wall_id - id);
  }

  // Cuts off what lies beyond the facets; false when nothing is left.
  bool keep_inside(Cell& cell, const Facets& facets, std::size_t wall) {
    const Vector from_axis = body_.position[element_] - body_.walls[wall].point;
    const int id = id_of(wall);
    const double reach = 1.0001 * std::sqrt(cell.max_radius_squared());
    for (const Vector& n : facets.normal) {
      const double distance = facets.distance - dot(n, from_axis);
      if (distance < reach && !cell.nplane(n.x, n.y, n.z, 2.0 * distance, id)) return false;
    }
    return true;
  }

  bool reaches_hole() {
    const Wall& wall = body_.walls[inner_];
    const Vector chord = body_.position[element_] - wall.point;
    const Vector across = chord - dot(wall.direction, chord) * wall.direction;
    const double distance = norm(across);
    cell_.vertices(numbers_);
    for (std::size_t k = 0; k < numbers_.size(); k += 3) {
      const Vector vertex{numbers_[k], numbers_[k + 1], numbers_[k + 2]};
      if (distance + dot(vertex, across) / distance < wall.radius) return true;
    }
    return false;
  }

  // The chord from the element to the image of the other that is behind a face.
  Vector chord_through(std::int32_t other, const Vector& normal) const {
    const Domain& domain = body_.domain;
    Vector nearest = body_.position[other] - body_.position[element_];
    for (int axis = 0; axis < 3; ++axis) {
      const double period = component(domain.upper, axis);
      double& d = component(nearest, axis);
      if (domain.periodic[axis]) d -= period * std::nearbyint(d / period);
    }
    const auto fit = [&](const Vector& chord) { return dot(chord, normal) / norm(chord); };
    if (fit(nearest) > 1.0 - 1e-6) return nearest;
    Vector best = nearest;
    std::array<int, 3> reach{};
    for (int axis = 0; axis < 3; ++axis) reach[axis] = domain.periodic[axis] ? 1 : 0;
    for (int a = -reach[0]; a <= reach[0]; ++a)
      for (int b = -reach[1]; b <= reach[1]; ++b)
        for (int c = -reach[2]; c <= reach[2]; ++c) {
          const Vector image =
              nearest + Vector{a * domain.upper.x, b * domain.upper.y, c * domain.upper.z};
          if (fit(image) > fit(best)) best = image;
        }
    return best;
  }

  // Adds (sign 1) or takes away (sign −1) the faces of a cell. Facets of a hole count as wall.
  void add_faces(Cell& cell, double sign) {
    const auto& periodic = body_.domain.periodic;
    const bool has_images = periodic[0] || periodic[1] || periodic[2];
    cell.neighbors(others_);
    cell.face_areas(areas_);
    if (has_images) cell.normals(numbers_);
    for (std::size_t k = 0; k < others_.size(); ++k) {
      const std::int32_t other = others_[k];
      if (other < 0) {
        const std::size_t wall = wall_of(other);
        if (wall < body_.walls.size())
          wall_area_[wall] += wall == inner_ ? areas_[k] : sign * areas_[k];
        continue;
      }
      if (other == element_) continue;  // its own image
      const Vector chord =
          has_images
              ? chord_through(other, {numbers_[3 * k], numbers_[3 * k + 1], numbers_[3 * k + 2]})
              : body_.position[other] - body_.position[element_];
      const double area = sign * areas_[k];
      sides_.push_back({other, area, area / norm(chord)});
    }
  }

  // Several faces with the same neighbour become one.
  void store(Chunk& chunk) {
    std::stable_sort(sides_.begin(), sides_.end(),
                     [](const Side& a, const Side& b) { return a.other < b.other; });
    for (const Side& side : sides_) {
      if (chunk.sides.size() > chunk.first.back() && chunk.sides.back().other == side.other) {
        chunk.sides.back().area += side.area;
        chunk.sides.back().area_over_distance += side.area_over_distance;
      } else {
        chunk.sides.push_back(side);
      }
    }
    chunk.first.push_back(chunk.sides.size());
    for (std::size_t wall = 0; wall < wall_area_.size(); ++wall)
      if (wall_area_[wall] > smallest_area)
        chunk.walls.push_back({wall,
                               {element_, wall_area_[wall],
                                body_.walls[wall].conduction_length(body_.position[element_])}});
  }

  const ScaledBody& body_;
  std::unique_ptr<voro::container_poly> container_;
  std::vector<std::unique_ptr<voro::wall>> voro_walls_;
  std::vector<std::pair<int, int>> place_;  // of each element in the container
  std::array<std::size_t, 6> box_wall_{};
  std::size_t outer_ = 0, inner_ = 0;

  Cell cell_, in_hole_;
  std::int32_t element_ = 0;
  bool is_holed_ = false;
  std::vector<int> others_;
  std::vector<double> areas_, numbers_, wall_area_;
  std::vector<Side> sides_;
};

std::string place_of(const Specimen& specimen, std::size_t element) {
  const Vector& p = specimen.position[element];
  return fmt::format("element {} at ({:.6g}, {:.6g}, {:.6g}) m", element, p.x, p.y, p.z);
}

// Whether the volume of a body is that of its shape.
bool fills_its_shape(const Domain& domain) {
  const double expected = volume_of(domain);
  return std::abs(domain.volume - expected) <= 1e-9 * expected;
}

void check_body(const Specimen& specimen, const ScaledBody& body) {
  const Domain& domain = specimen.domain;
  if (domain.shape == "imported")
    throw InputError(
        "cells: the specimen's file does not say what shape its body has, without which there are "
        "no cells; give [specimen] shape and its measures");
  if (!domain.has_walls())
    throw InputError(fmt::format(
        "cells: there are none of {}, whose walls are not known; expected a whole body of one of "
        "the shapes, or a platonic law",
        domain.cuts > 0            ? "a body that something was cut out of"
        : domain.shape == "bodies" ? "several bodies"
                                   : "a " + domain.shape));
  const double expected = volume_of(domain);
  if (!fills_its_shape(domain))
    throw InputError(fmt::format(
        "cells: the volume of the body is {:.9g} m3, but a {} of its dimensions has {:.9g} m3: "
        "expected a volume and a shape that agree",
        domain.volume, domain.shape, expected));
  for (std::size_t i = 0; i < body.position.size(); ++i)
    for (const Wall& wall : body.walls)
      if (!(wall.distance(body.position[i]) > 1e-9))
        throw InputError(fmt::format(
            "cells: {} lies outside of the body, {:.3g} m beyond its wall {}: expected "
            "centres inside",
            place_of(specimen, i), -body.unit * wall.distance(body.position[i]), wall.name));
}

// Both sides of a face differ by round-off: their mean counts.
void join_sides(const std::vector<Chunk>& chunks, double unit, Tessellation& result) {
  const auto sides_of = [&](std::size_t element) {
    const Chunk& chunk = chunks[element / chunk_size];
    const std::size_t k = element % chunk_size;
    return std::pair(chunk.sides.data() + chunk.first[k], chunk.sides.data() + chunk.first[k + 1]);
  };
  for (std::size_t i = 0; i < result.volume.size(); ++i) {
    const auto [begin, end] = sides_of(i);
    const auto element = static_cast<std::int32_t>(i);
    for (const Side* here = begin; here != end; ++here) {
      if (here->other < element) continue;
      const auto [low, high] = sides_of(static_cast<std::size_t>(here->other));
      const Side* const there = std::lower_bound(
          low, high, element, [](const Side& side, std::int32_t e) { return side.other < e; });
      if (there == high || there->other != element) continue;
      const double area = 0.5 * (here->area + there->area);
      if (!(area > smallest_area)) continue;
      const double conducted = 0.5 * (here->area_over_distance + there->area_over_distance);
      result.faces.push_back({element, here->other});
      result.area.push_back(unit * unit * area);
      result.distance.push_back(unit * area / conducted);
    }
  }
}

// Cells fill the body but for round-off, which is shared out.
void scale_to_body(const ScaledBody& body, const Domain& domain, Tessellation& result) {
  const double sum = std::accumulate(result.volume.begin(), result.volume.end(), 0.0);
  if (!(std::abs(sum / body.domain.volume - 1.0) < volume_tolerance))
    throw RunError(
        fmt::format("cells: those of all elements fill {:.9g} of the body, not all of it",
                    sum / body.domain.volume));
  for (double& volume : result.volume) volume *= domain.volume / sum;
  for (const Wall& wall : walls_of(domain)) {
    std::vector<WallFace>& faces = result.walls[wall.name];
    double area = 0;
    for (const WallFace& face : faces) area += face.area;
    for (WallFace& face : faces) {
      face.area *= wall.area / area;
      face.distance *= body.unit;
    }
  }
}

Polyhedron in_metres(Polyhedron solid, double unit, const Vector& origin) {
  for (std::vector<Vector>& face : solid.faces)
    for (Vector& p : face) p = origin + unit * p;
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

// Gathers what take(faces, walls, element, in hole, into) makes of each solid of the cells.
template <class Take>
std::vector<CellSolid> gather_solids(const Specimen& specimen, const ScaledBody& body,
                                     const Take& take) {
  const std::size_t n = specimen.size();
  std::vector<std::vector<CellSolid>> chunks((n + chunk_size - 1) / chunk_size);
  for_each_cell(body, n, [&](CellMaker& maker, std::size_t i, std::size_t chunk) {
    Chunk unused;
    const auto element = static_cast<std::int32_t>(i);
    if (!(maker.make(element, unused) > 0)) return;
    maker.visit_solids(
        [&](const Polyhedron& solid, const std::vector<std::size_t>& walls, bool is_in_hole) {
          take(in_metres(solid, body.unit, specimen.domain.lower), walls, element, is_in_hole,
               chunks[chunk]);
        });
  });
  std::vector<CellSolid> all;
  for (std::vector<CellSolid>& chunk : chunks)
    all.insert(all.end(), std::make_move_iterator(chunk.begin()),
               std::make_move_iterator(chunk.end()));
  return all;
}

}  // namespace

bool has_cells(const Specimen& specimen) {
  if (!specimen.domain.has_walls() || !fills_its_shape(specimen.domain)) return false;
  const std::vector<Wall> walls = walls_of(specimen.domain);
  return std::all_of(specimen.position.begin(), specimen.position.end(), [&](const Vector& p) {
    return std::all_of(walls.begin(), walls.end(),
                       [&](const Wall& wall) { return wall.distance(p) > 0; });
  });
}

std::vector<CellSolid> cell_solids(const Specimen& specimen, const Vector& lower,
                                   const Vector& upper) {
  const ScaledBody body(specimen);
  check_body(specimen, body);
  return gather_solids(specimen, body,
                       [&](const Polyhedron& solid, const std::vector<std::size_t>& /*walls*/,
                           std::int32_t element, bool is_in_hole, std::vector<CellSolid>& into) {
                         const bool is_taken = is_in_hole
                                                   ? !into.empty() && into.back().element == element
                                                   : boxes_meet(solid, lower, upper);
                         if (is_taken) into.push_back({element, solid, is_in_hole});
                       });
}

std::vector<CellSolid> wall_slabs(const Specimen& specimen, const std::string& wall,
                                  double thickness) {
  const ScaledBody body(specimen);
  check_body(specimen, body);
  const std::size_t asked = body.wall_called(wall);
  const bool is_hole = wall == "inner";
  return gather_solids(
      specimen, body,
      [&](const Polyhedron& solid, const std::vector<std::size_t>& walls, std::int32_t element,
          bool is_in_hole, std::vector<CellSolid>& into) {
        for (std::size_t k = 0; k < walls.size(); ++k)
          if (walls[k] == asked)
            into.push_back({element, slab_of(solid.faces[k], thickness), is_in_hole && !is_hole});
      });
}

Tessellation tessellate(const Specimen& specimen) {
  const ScaledBody body(specimen);
  check_body(specimen, body);
  const std::size_t n = specimen.size();
  Tessellation result;
  result.volume.resize(n);
  std::vector<Chunk> chunks((n + chunk_size - 1) / chunk_size);
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
  for (const Chunk& chunk : chunks)
    for (const WallSide& side : chunk.walls)
      result.walls[body.walls[side.wall].name].push_back(side.face);
  scale_to_body(body, specimen.domain, result);
  return result;
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
