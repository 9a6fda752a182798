// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/scaled_outline.hpp"

#include <algorithm>
#include <cmath>

#include "laws/constants.hpp"
#include "specimen/mesh_walls.hpp"

namespace solidem {

namespace {

// Cuts are larger by this, so that of cuts that share a face, with each other or with a mesh, one
// reaches through it.
constexpr double cut_growth = 1e-10;
constexpr double in_plane = 1e-11;  // of a point that sees a facet edge-on

Vector axis_vector(int axis, double value) {
  Vector v{};
  component(v, axis) = value;
  return v;
}

// By what a cut is repeated in a periodic body: not along what is endless.
std::vector<Vector> images_of_cut(const Domain& domain, double unit,
                                  const std::array<bool, 3>& ends) {
  std::vector<Vector> images{Vector{}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (!domain.periodic[a] || !ends[a]) continue;
    const double period = component(domain.upper - domain.lower, axis) / unit;
    const std::size_t count = images.size();
    for (const double shift : {-period, period})
      for (std::size_t k = 0; k < count; ++k)
        images.push_back(images[k] + axis_vector(axis, shift));
  }
  return images;
}

// Which of the body's axes a cut has ends along.
std::array<bool, 3> has_ends_along(const Cut& cut) {
  std::array<bool, 3> ends{true, true, true};
  if (cut.mesh != nullptr || cut.part.kind != Shape::Kind::cylinder) return ends;
  if (std::isfinite(cut.part.length)) return ends;
  const Vector axis = rotate(cut.turned, axis_vector(cut.part.axis, 1));
  for (int k = 0; k < 3; ++k)
    ends[static_cast<std::size_t>(k)] = std::abs(component(axis, k)) < 1e-9;
  return ends;
}

Cut in_mean_radii(const Cut& cut, double unit, const Vector& origin) {
  Cut result = cut;
  Shape::Part& part = result.part;
  part.offset = (1 / unit) * (part.offset - origin);
  part.radius = part.radius / unit + cut_growth;
  part.length = part.length / unit + 2 * cut_growth;
  part.size = (1 / unit) * part.size + Vector{2 * cut_growth, 2 * cut_growth, 2 * cut_growth};
  return result;
}

// A mesh that is larger by the growth of cuts on all sides of the box around it.
TriangleMesh a_little_larger(TriangleMesh mesh) {
  const auto [lower, upper] = bounds(mesh);
  const Vector middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  for (Vector& vertex : mesh.vertices)
    for (int k = 0; k < 3; ++k)
      component(vertex, k) +=
          cut_growth * (component(vertex, k) - component(middle, k)) / component(half, k);
  return mesh;
}

// Of a plane that is a distance from a centre, negative when it is seen from behind, on a surface
// that is `closest` to it. Where the surface is aslant of the way to it, or turned away, that
// counts more.
double path_to_plane(double distance, double closest) {
  return distance > 0 ? std::max(distance, 0.25 * closest) : std::max(-distance, closest);
}

}  // namespace

// What of a cell is asked again and again.
struct ScaledOutline::Cell {
  explicit Cell(const Polyhedron& solid) : planes(planes_of(solid)), seen_from{} {
    const auto [lower, upper] = bounds(solid);
    middle = 0.5 * (lower + upper);
    for (const std::vector<Vector>& face : solid.faces)
      for (const Vector& p : face) reach = std::max(reach, norm(p - middle));
    const bool holds_centre = std::all_of(
        planes.begin(), planes.end(), [](const FacePlane& plane) { return plane.offset > 1e-6; });
    if (!holds_centre) seen_from = mean_corner(solid);
  }

  static Vector mean_corner(const Polyhedron& solid) {
    Vector sum{};
    double count = 0;
    for (const std::vector<Vector>& face : solid.faces)
      for (const Vector& p : face) {
        sum += p;
        count += 1;
      }
    return (1 / count) * sum;
  }

  // From the middle to a plane, negative on the side that the normal looks away from.
  double beyond(const FacePlane& plane) const { return dot(plane.normal, middle) - plane.offset; }

  // Whether a face of the cell parts a triangle from it.
  bool is_apart(const std::array<Vector, 3>& corners) const {
    return std::any_of(planes.begin(), planes.end(), [&](const FacePlane& plane) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](const Vector& p) { return dot(plane.normal, p) >= plane.offset; });
    });
  }

  std::vector<FacePlane> planes;
  Vector middle, seen_from;
  double reach = 0;  // of a ball about the middle
};

ScaledOutline::ScaledOutline(const Specimen& specimen, double unit, std::size_t first_wall) {
  const Outline& outline = *specimen.outline;
  std::size_t wall = first_wall;
  if (outline.surface != nullptr) add_mesh(*outline.surface, true, specimen, unit, wall++);
  for (const Cut& cut : outline.cuts) {
    if (cut.mesh != nullptr)
      add_mesh(*cut.mesh, false, specimen, unit, wall);
    else
      add_convex(cut, specimen, unit, wall);
    ++wall;
  }
}

std::vector<std::string> ScaledOutline::wall_names(const Outline& outline) {
  std::vector<std::string> names;
  if (outline.surface != nullptr) names.emplace_back("surface");
  for (std::size_t k = 1; k <= outline.cuts.size(); ++k)
    names.push_back("cut_" + std::to_string(k));
  return names;
}

void ScaledOutline::add_mesh(const FacetTree& tree, bool is_body, const Specimen& specimen,
                             double unit, std::size_t wall) {
  TriangleMesh mesh = scaled(tree.mesh(), unit, specimen.domain.lower);
  if (!is_body) mesh = a_little_larger(std::move(mesh));
  meshes_.push_back({std::make_shared<const FacetTree>(std::move(mesh)), is_body, wall,
                     images_of_cut(specimen.domain, unit, {true, true, true})});
}

void ScaledOutline::add_convex(const Cut& given, const Specimen& specimen, double unit,
                               std::size_t wall) {
  ConvexCut convex;
  convex.cut = in_mean_radii(given, unit, specimen.domain.lower);
  convex.wall = wall;
  convex.images = images_of_cut(specimen.domain, unit, has_ends_along(given));
  const Shape::Part& part = convex.cut.part;
  const auto add = [&](const Vector& local, double distance, bool is_round) {
    const Vector normal = rotate(convex.cut.turned, local);
    convex.sides.push_back({{normal, dot(normal, part.offset) + distance}, is_round});
  };
  const bool is_cylinder = part.kind == Shape::Kind::cylinder;
  for (int k = 0; k < 3; ++k) {
    const bool is_end = is_cylinder && k == part.axis && std::isfinite(part.length);
    if (part.kind != Shape::Kind::box && !is_end) continue;
    const double half = 0.5 * (is_end ? part.length : component(part.size, k));
    for (const double side : {-1.0, 1.0}) add(axis_vector(k, side), half, false);
  }
  if (part.kind != Shape::Kind::box) {
    const Facets facets =
        is_cylinder ? cylinder_facets(part.radius, 2 * pi, axis_vector((part.axis + 1) % 3, 1),
                                      axis_vector((part.axis + 2) % 3, 1))
                    : sphere_facets(part.radius);
    for (const Vector& normal : facets.normal) add(normal, facets.distance, true);
    convex.shrink = facets.distance / part.radius;
    convex.round.point = part.offset;
    convex.round.radius = part.radius;
    convex.round.concave = true;
    if (is_cylinder) convex.round.direction = rotate(convex.cut.turned, axis_vector(part.axis, 1));
  }
  convex_.push_back(std::move(convex));
}

bool ScaledOutline::take_out(const ConvexCut& convex, const Vector& centre, const Cell& cell,
                             std::vector<CellPart>& parts, std::vector<OutlinePlane>& planes) {
  std::vector<const Side*> near;
  for (const Side& side : convex.sides) {
    const double offset = side.plane.offset - dot(side.plane.normal, centre);
    const double beyond = dot(side.plane.normal, cell.middle) - offset;
    if (beyond >= cell.reach) return false;
    if (beyond > -cell.reach) near.push_back(&side);
  }
  const double closest = convex.cut.distance(centre);
  const bool sees_round = convex.round.radius > 0 && convex.round.distance(centre) > 0;
  const auto first = static_cast<std::int32_t>(planes.size());
  for (const Side* side : near) {
    const double distance = dot(side->plane.normal, centre) - side->plane.offset;
    const bool is_seen_round = side->is_round && sees_round && distance > 0;
    planes.push_back(
        {convex.wall,
         is_seen_round ? convex.round.conduction_length(centre) : path_to_plane(distance, closest),
         side->is_round ? convex.shrink : 1.0});
  }
  const std::size_t count = parts.size();
  bool is_cut = false;
  for (std::size_t k = 0; k < count; ++k) {
    CellPart inside = multiple_of(parts[k], -1);
    bool is_left = true;
    for (std::size_t n = 0; n < near.size() && is_left; ++n) {
      const FacePlane& plane = near[n]->plane;
      is_left = clip(inside, plane.normal, plane.offset - dot(plane.normal, centre),
                     {CellFace::Of::outline, first + static_cast<std::int32_t>(n), parts[k].sign});
    }
    if (!is_left) continue;
    is_cut = true;
    parts.push_back(std::move(inside));
  }
  return is_cut;
}

namespace {

// The shadow that a facet throws in a part, seen from a point. `side` is 1 where its normal looks
// away from there, else −1. False when there is none.
bool shadow(CellPart& part, const std::array<Vector, 3>& corners, const Vector& normal, double side,
            const Vector& from, const CellFace& lit) {
  const Vector beyond = -side * normal;
  if (!clip(part, beyond, dot(beyond, corners[0]), lit)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector across = cross(corners[k] - from, corners[(k + 1) % 3] - from);
    const Vector outward = (-side / norm(across)) * across;
    if (!clip(part, outward, dot(outward, from), {})) return false;
  }
  return true;
}

}  // namespace

bool ScaledOutline::cut_at(const MeshPart& mesh, const Vector& centre, const Cell& cell,
                           std::vector<CellPart>& parts, std::vector<OutlinePlane>& planes) {
  const FacetTree& tree = *mesh.tree;
  std::vector<std::int32_t> near;
  tree.for_each_near(centre + cell.middle, cell.reach,
                     [&](std::int32_t facet) { near.push_back(facet); });
  std::sort(near.begin(), near.end());
  const Vector& from = cell.seen_from;
  const std::size_t count = parts.size();
  bool is_reached = false;
  for (const std::int32_t facet : near) {
    const Vector& normal = tree.normals()[static_cast<std::size_t>(facet)];
    std::array<Vector, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = tree.mesh().vertices[static_cast<std::size_t>(
                       tree.mesh().facets[static_cast<std::size_t>(facet)][k])] -
                   centre;
    const double away = dot(normal, corners[0] - from);
    const FacePlane plane{normal, dot(normal, corners[0])};
    if (std::abs(cell.beyond(plane)) >= cell.reach || cell.is_apart(corners)) continue;
    is_reached = true;
    if (std::abs(away) < in_plane) continue;
    const double side = away > 0 ? 1 : -1;
    const auto number = static_cast<std::int32_t>(planes.size());
    planes.push_back({mesh.wall, path_to_plane(mesh.is_body ? plane.offset : -plane.offset,
                                               tree.closest_on(facet, centre).distance)});
    for (std::size_t k = 0; k < count; ++k) {
      CellPart part = multiple_of(parts[k], mesh.is_body ? -side : side);
      if (shadow(part, corners, normal, side, from, {CellFace::Of::outline, number, parts[k].sign}))
        parts.push_back(std::move(part));
    }
  }
  if (!is_reached) return false;
  if ((tree.signed_distance(centre + from) < 0) != mesh.is_body)
    parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count));
  return true;
}

bool ScaledOutline::cut(const Vector& centre, std::vector<CellPart>& parts,
                        std::vector<OutlinePlane>& planes) const {
  const Cell cell(parts.front().solid);
  bool is_cut = false;
  for (const MeshPart& mesh : meshes_)
    for (const Vector& image : mesh.images)
      is_cut = cut_at(mesh, centre - image, cell, parts, planes) || is_cut;
  for (const ConvexCut& convex : convex_)
    for (const Vector& image : convex.images)
      is_cut = take_out(convex, centre - image, cell, parts, planes) || is_cut;
  return is_cut;
}

}  // namespace solidem
