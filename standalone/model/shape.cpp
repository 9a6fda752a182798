// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/shape.hpp"

#include <algorithm>
#include <cmath>

#include "laws/constants.hpp"

namespace solidem {

namespace {

constexpr double facet_error = 0.005;  // of the size of what they cut

Vector along(int axis, double value) {
  Vector v{};
  component(v, axis) = value;
  return v;
}

std::pair<Vector, Vector> bounds_of(const Shape::Part& part) {
  Vector half{part.radius, part.radius, part.radius};
  if (part.kind == Shape::Kind::box) half = 0.5 * part.size;
  if (part.kind == Shape::Kind::cylinder) component(half, part.axis) = 0.5 * part.length;
  return {part.offset - half, part.offset + half};
}

/// What lies between two planes across an axis.
Polyhedron layer(const Polyhedron& solid, int axis, double from, double to) {
  return clipped(clipped(solid, along(axis, 1), to), along(axis, -1), -from);
}

Polyhedron without_ends(const Polyhedron& solid, const Shape::Part& part, const Vector& centre) {
  const double middle = component(centre, part.axis);
  return layer(solid, part.axis, middle - 0.5 * part.length, middle + 0.5 * part.length);
}

Polyhedron within_box(const Polyhedron& solid, const Shape::Part& part, const Vector& centre) {
  Polyhedron rest = solid;
  for (int k = 0; k < 3 && !rest.empty(); ++k) {
    const double half = 0.5 * component(part.size, k);
    rest = layer(rest, k, component(centre, k) - half, component(centre, k) + half);
  }
  return rest;
}

/// Whether a part and the box around a solid have something in common; of a box, whether the two
/// boxes do.
bool may_meet(const Polyhedron& solid, const Shape::Part& part, const Vector& position) {
  if (solid.empty()) return false;
  const auto [lower, upper] = bounds(solid);
  const auto [from, to] = bounds_of(part);
  const Vector centre = position + part.offset;
  double squared = 0;  // distance of a round part's middle
  for (int k = 0; k < 3; ++k) {
    const double low = component(lower, k), high = component(upper, k);
    if (component(position + from, k) >= high || component(position + to, k) <= low) return false;
    if (part.kind == Shape::Kind::cylinder && k == part.axis) continue;
    const double x = component(centre, k), away = x - std::clamp(x, low, high);
    squared += away * away;
  }
  return part.kind == Shape::Kind::box || squared < part.radius * part.radius;
}

/// Whether a point, seen from the centre of a part, lies in it.
bool holds(const Shape::Part& part, const Vector& point) {
  switch (part.kind) {
    case Shape::Kind::box:
      return 2 * std::fabs(point.x) <= part.size.x && 2 * std::fabs(point.y) <= part.size.y &&
             2 * std::fabs(point.z) <= part.size.z;
    case Shape::Kind::cylinder: {
      const double height = component(point, part.axis);
      return 2 * std::fabs(height) <= part.length &&
             dot(point, point) - height * height <= part.radius * part.radius;
    }
    case Shape::Kind::sphere:
      break;
  }
  return dot(point, point) <= part.radius * part.radius;
}

/// Whether all of a solid lies in a part, which is convex: all its corners do.
bool holds_all_of(const Polyhedron& solid, const Shape::Part& part, const Vector& centre) {
  for (const std::vector<Vector>& face : solid.faces)
    for (const Vector& corner : face)
      if (!holds(part, corner - centre)) return false;
  return true;
}

double volume_in_part(const Polyhedron& solid, const Shape::Part& part, const Vector& position) {
  if (!may_meet(solid, part, position)) return 0;
  const Vector centre = position + part.offset;
  if (holds_all_of(solid, part, centre)) return volume(solid);
  switch (part.kind) {
    case Shape::Kind::box:
      return volume(within_box(solid, part, centre));
    case Shape::Kind::cylinder:
      if (std::isinf(part.length)) return volume_in_cylinder(solid, centre, part.axis, part.radius);
      return volume_in_cylinder(without_ends(solid, part, centre), centre, part.axis, part.radius);
    case Shape::Kind::sphere:
      break;
  }
  return volume_in_ball(solid, centre, part.radius);
}

double size_of(const Polyhedron& solid) {
  const auto [lower, upper] = bounds(solid);
  return norm(upper - lower);
}

/// Facets of a cylinder; they cut the circle so that the section's area is the circle's.
Polyhedron within_facets_of_cylinder(const Polyhedron& solid, const Shape::Part& part,
                                     const Vector& centre) {
  const double turn = std::sqrt(8 * facet_error * size_of(solid) / part.radius);
  const int count = std::clamp(static_cast<int>(std::ceil(2 * pi / turn)), 24, 4096);
  const double half = pi / count, distance = part.radius * std::sqrt(half / std::tan(half));
  Polyhedron rest = std::isinf(part.length) ? solid : without_ends(solid, part, centre);
  for (int k = 0; k < count && !rest.empty(); ++k) {
    const double angle = 2 * half * k;
    const Vector normal =
        along((part.axis + 1) % 3, std::cos(angle)) + along((part.axis + 2) % 3, std::sin(angle));
    rest = clipped(rest, normal, dot(normal, centre) + distance);
  }
  return rest;
}

/// Facets of a sphere, whose volume is the ball's.
Polyhedron within_facets_of_sphere(const Polyhedron& solid, const Shape::Part& part,
                                   const Vector& centre) {
  // A facet of the n-th part of the sphere stands out by 2 R / n.
  const double needed = 2 * part.radius / (facet_error * size_of(solid));
  const int count = static_cast<int>(std::clamp(needed, 500.0, 50000.0));
  const double distance = part.radius * (1 - 1.0 / count);
  Polyhedron rest = solid;
  for (const Vector& normal : even_directions(count)) {
    if (rest.empty()) break;
    rest = clipped(rest, normal, dot(normal, centre) + distance);
  }
  return rest;
}

Polyhedron within_part(const Polyhedron& solid, const Shape::Part& part, const Vector& position) {
  if (!may_meet(solid, part, position)) return {};
  const Vector centre = position + part.offset;
  switch (part.kind) {
    case Shape::Kind::box:
      return within_box(solid, part, centre);
    case Shape::Kind::cylinder:
      return within_facets_of_cylinder(solid, part, centre);
    case Shape::Kind::sphere:
      break;
  }
  return within_facets_of_sphere(solid, part, centre);
}

/// Volume inside of the first parts: what the last of them adds, or takes away, is what it holds
/// alone less what it has in common with those before, and that is the same question of the part of
/// the solid in it.
double volume_in_parts(const Polyhedron& solid, const Shape& shape, std::size_t parts,
                       const Vector& position) {
  if (solid.empty() || parts == 0) return 0;
  const Shape::Part& last = shape.parts[parts - 1];
  if (parts == 1) return volume_in_part(solid, last, position);
  const double before = volume_in_parts(solid, shape, parts - 1, position);
  const double own = last.is_cut_out ? 0 : volume_in_part(solid, last, position);
  if (before == 0) return own;
  const Polyhedron inside = within_part(solid, last, position);
  return before + own - volume_in_parts(inside, shape, parts - 1, position);
}

}  // namespace

std::pair<Vector, Vector> Shape::bounds() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
  for (const Part& part : parts) {
    if (part.is_cut_out) continue;
    const auto [from, to] = bounds_of(part);
    for (int k = 0; k < 3; ++k) {
      component(lower, k) = std::min(component(lower, k), component(from, k));
      component(upper, k) = std::max(component(upper, k), component(to, k));
    }
  }
  return {lower, upper};
}

double Shape::smallest_extent() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) {
    const auto [from, to] = bounds_of(part);
    for (int k = 0; k < 3; ++k) smallest = std::min(smallest, component(to - from, k));
  }
  return smallest;
}

double volume_inside(const Polyhedron& solid, const Shape& shape, const Vector& position) {
  return std::max(0.0, volume_in_parts(solid, shape, shape.parts.size(), position));
}

}  // namespace solidem
