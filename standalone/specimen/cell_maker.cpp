// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/cell_maker.hpp"

#include <algorithm>
#include <cmath>

#include "specimen/shape.hpp"

namespace solidem {

namespace {

constexpr double elements_in_a_block = 5.0;
constexpr int first_wall_id = -11;  // voro++ numbers the planes of its box −1 to −6

// What outlines leave below this is no part of a cell's neighbourhood.
constexpr double least_area = 1e-14;

Facets facets_of_wall(const Domain& body, double radius) {
  if (body.is_sphere()) return sphere_facets(radius);
  return cylinder_facets(radius, body.arc(), body.first_transverse(), body.second_transverse());
}

}  // namespace

ScaledBody::ScaledBody(const Specimen& specimen)
    : unit(mean_radius(specimen)), domain(scaled(specimen.domain, unit)) {
  for (const Vector& p : specimen.position)
    position.push_back((1.0 / unit) * (p - specimen.domain.lower));
  for (const double r : specimen.radius) radius.push_back(r / unit);
  walls = solidem::walls_of_shape(domain);
  walls_of_shape = walls.size();
  if (domain.radius > 0) outer = facets_of_wall(domain, domain.radius);
  if (domain.inner_radius > 0) inner = facets_of_wall(domain, domain.inner_radius);
  if (specimen.outline == nullptr) return;
  outline.emplace(specimen, unit, walls_of_shape);
  for (const std::string& name : ScaledOutline::wall_names(*specimen.outline)) {
    walls.emplace_back();
    walls.back().name = name;
  }
}

std::size_t ScaledBody::wall_called(const std::string& name) const {
  std::size_t wall = 0;
  while (wall < walls.size() && walls[wall].name != name) ++wall;
  return wall;
}

double ScaledBody::shrink_of(std::size_t wall) const {
  const Facets& facets = walls[wall].concave ? inner : outer;
  return facets.distance / walls[wall].radius;
}

CellMaker::CellMaker(const ScaledBody& body) : body_(body), place_(body.position.size()) {
  const Domain& domain = body.domain;
  has_images_ = domain.is_periodic();
  Vector low = domain.lower, high = domain.upper;
  // Corners of the facets stand out of the bounding box; cells reach through a mesh.
  for (int axis = 0; axis < 3; ++axis)
    if ((domain.radius > 0 && axis != domain.axis) || domain.shape == "mesh") {
      component(low, axis) -= 1.0;
      component(high, axis) += 1.0;
    }
  const double per_length =
      std::cbrt(static_cast<double>(place_.size()) / (elements_in_a_block * domain.volume));
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

double CellMaker::make(std::int32_t element, CellChunk& chunk) {
  const auto [block, k] = place_[element];
  is_holed_ = false;
  has_parts_ = false;
  if (!container_->compute_cell(cell_, block, k)) return 0;
  element_ = element;
  sides_.clear();
  wall_area_.assign(body_.walls.size(), 0.0);
  wall_conducts_.assign(body_.walls.size(), 0.0);
  // The body is convex but for an inner wall, and that is the outside of a convex hole.
  if (!body_.outer.normal.empty() && !keep_inside(cell_, body_.outer, outer_)) return 0;
  double volume = cell_.volume();
  if (!body_.inner.normal.empty() && reaches_hole()) {
    in_hole_ = cell_;
    is_holed_ = keep_inside(in_hole_, body_.inner, inner_);
    if (is_holed_) volume -= in_hole_.volume();
  }
  if (body_.outline) {
    make_parts();
    planes_.clear();
    has_parts_ = body_.outline->cut(body_.position[element_], parts_, planes_);
  }
  if (has_parts_) {
    volume = add_parts();
  } else {
    add_faces(cell_, 1.0);
    if (is_holed_) add_faces(in_hole_, -1.0);
  }
  store(chunk);
  return volume;
}

const std::vector<CellPart>& CellMaker::parts() {
  if (!has_parts_) make_parts();
  return parts_;
}

std::size_t CellMaker::wall_of(const CellFace& face) const {
  const auto number = static_cast<std::size_t>(face.number);
  if (face.of == CellFace::Of::wall) return number;
  return face.of == CellFace::Of::outline ? planes_[number].wall : body_.walls.size();
}

void CellMaker::make_parts() {
  parts_.clear();
  parts_.push_back(part_of(cell_, 1.0));
  if (is_holed_) parts_.push_back(part_of(in_hole_, -1.0));
}

CellPart CellMaker::part_of(Cell& cell, double sign) {
  std::vector<int> corners;
  cell.vertices(numbers_);
  cell.face_vertices(corners);
  cell.neighbors(others_);
  const auto vertex = [&](int k) {
    return Vector{numbers_[3 * k], numbers_[3 * k + 1], numbers_[3 * k + 2]};
  };
  CellPart part;
  part.sign = sign;
  std::size_t at = 0;
  for (const int other : others_) {
    std::vector<Vector> face;
    for (int left = corners[at++]; left > 0; --left) face.push_back(vertex(corners[at++]));
    std::reverse(face.begin(), face.end());  // voro++ goes clockwise
    part.solid.faces.push_back(std::move(face));
    if (other >= 0) {
      part.faces.push_back({CellFace::Of::neighbour, other, sign});
      continue;
    }
    // Facets of a hole count as wall.
    const std::size_t wall = wall_of_id(other);
    if (wall == body_.walls.size())
      part.faces.emplace_back();
    else
      part.faces.push_back(
          {CellFace::Of::wall, static_cast<std::int32_t>(wall), wall == inner_ ? 1.0 : sign});
  }
  return part;
}

void CellMaker::add_walls() {
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
  if (outer_ < body_.walls_of_shape) {
    // Outside of all facets, to keep cells small while they are made.
    const Wall& wall = body_.walls[outer_];
    const Vector &p = wall.point, &a = wall.direction;
    const double far = wall.radius + 0.5;
    if (domain.is_sphere())
      voro_walls_.push_back(std::make_unique<voro::wall_sphere>(p.x, p.y, p.z, far, id_of(outer_)));
    else
      voro_walls_.push_back(
          std::make_unique<voro::wall_cylinder>(p.x, p.y, p.z, a.x, a.y, a.z, far, id_of(outer_)));
  }
  for (const auto& wall : voro_walls_) container_->add_wall(wall.get());
}

int CellMaker::id_of(std::size_t wall) {
  return first_wall_id - static_cast<int>(wall);
}

std::size_t CellMaker::wall_of_id(int id) const {
  return id > first_wall_id ? box_wall_[-1 - id] : static_cast<std::size_t>(first_wall_id - id);
}

// Cuts off what lies beyond the facets; false when nothing is left.
bool CellMaker::keep_inside(Cell& cell, const Facets& facets, std::size_t wall) {
  const Vector from_axis = body_.position[element_] - body_.walls[wall].point;
  const int id = id_of(wall);
  const double reach = 1.0001 * std::sqrt(cell.max_radius_squared());
  for (const Vector& n : facets.normal) {
    const double distance = facets.distance - dot(n, from_axis);
    if (distance < reach && !cell.nplane(n.x, n.y, n.z, 2.0 * distance, id)) return false;
  }
  return true;
}

bool CellMaker::reaches_hole() {
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
Vector CellMaker::chord_through(std::int32_t other, const Vector& normal) const {
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

void CellMaker::add_side(std::int32_t other, double area, const Vector& normal) {
  if (other == element_) return;  // its own image
  const Vector chord =
      has_images_ ? chord_through(other, normal) : body_.position[other] - body_.position[element_];
  sides_.push_back({other, area, area / norm(chord)});
}

// Adds (sign 1) or takes away (sign −1) the faces of a cell. Facets of a hole count as wall.
void CellMaker::add_faces(Cell& cell, double sign) {
  cell.neighbors(others_);
  cell.face_areas(areas_);
  if (has_images_) cell.normals(numbers_);
  for (std::size_t k = 0; k < others_.size(); ++k) {
    const std::int32_t other = others_[k];
    if (other < 0) {
      const std::size_t wall = wall_of_id(other);
      if (wall < body_.walls.size())
        wall_area_[wall] += wall == inner_ ? areas_[k] : sign * areas_[k];
      continue;
    }
    add_side(
        other, sign * areas_[k],
        has_images_ ? Vector{numbers_[3 * k], numbers_[3 * k + 1], numbers_[3 * k + 2]} : Vector{});
  }
}

// The same of a cell in parts; returns its volume.
double CellMaker::add_parts() {
  double sum = 0;
  for (const CellPart& part : parts_) {
    sum += part.sign * volume(part.solid);
    for (std::size_t k = 0; k < part.faces.size(); ++k) {
      const CellFace& face = part.faces[k];
      if (face.of == CellFace::Of::nothing) continue;
      const Vector vector = area_vector(part.solid.faces[k]);
      const double size = norm(vector), area = face.weight * size;
      if (!(size > least_area)) continue;
      if (face.of == CellFace::Of::neighbour) {
        add_side(face.number, area, (1 / size) * vector);
      } else if (face.of == CellFace::Of::wall) {
        wall_area_[static_cast<std::size_t>(face.number)] += area;
      } else {
        const OutlinePlane& plane = planes_[static_cast<std::size_t>(face.number)];
        wall_area_[plane.wall] += plane.shrink * area;
        wall_conducts_[plane.wall] += plane.shrink * area / plane.path;
      }
    }
  }
  return sum;
}

// Several faces with the same neighbour become one.
void CellMaker::store(CellChunk& chunk) {
  std::stable_sort(sides_.begin(), sides_.end(),
                   [](const CellSide& a, const CellSide& b) { return a.other < b.other; });
  for (const CellSide& side : sides_) {
    if (chunk.sides.size() > chunk.first.back() && chunk.sides.back().other == side.other) {
      chunk.sides.back().area += side.area;
      chunk.sides.back().area_over_distance += side.area_over_distance;
    } else {
      chunk.sides.push_back(side);
    }
  }
  chunk.first.push_back(chunk.sides.size());
  for (std::size_t wall = 0; wall < wall_area_.size(); ++wall) {
    if (!(wall_area_[wall] > smallest_face)) continue;
    const bool is_of_shape = wall < body_.walls_of_shape;
    const double path = is_of_shape ? body_.walls[wall].conduction_length(body_.position[element_])
                                    : wall_area_[wall] / wall_conducts_[wall];
    chunk.walls.push_back({wall, {element_, wall_area_[wall], path}});
  }
}

}  // namespace solidem
