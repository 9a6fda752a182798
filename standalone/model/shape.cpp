// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace solidem {

namespace {

/// Distance from a solid whose surface is at `gap` (negative inside) along each of its directions.
template <std::size_t size>
double corner_distance(const std::array<double, size>& gap) {
  double outside = 0, inside = -std::numeric_limits<double>::infinity();
  for (const double g : gap) {
    outside += g > 0 ? g * g : 0;
    inside = std::max(inside, g);
  }
  return outside > 0 ? std::sqrt(outside) : inside;
}

double distance_of(const Shape::Part& part, const Vector& point) {
  const Vector p = point - part.offset;
  switch (part.kind) {
    case Shape::Kind::sphere:
      break;
    case Shape::Kind::cylinder: {
      const double along = component(p, part.axis);
      const double across = std::sqrt(std::max(0.0, dot(p, p) - along * along));
      return corner_distance<2>({across - part.radius, std::fabs(along) - 0.5 * part.length});
    }
    case Shape::Kind::box:
      return corner_distance<3>({std::fabs(p.x) - 0.5 * part.size.x,
                                 std::fabs(p.y) - 0.5 * part.size.y,
                                 std::fabs(p.z) - 0.5 * part.size.z});
  }
  return norm(p) - part.radius;
}

}  // namespace

double Shape::signed_distance(const Vector& point) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) {
    const double own = distance_of(part, point);
    distance = part.is_cut_out ? std::max(distance, -own) : std::min(distance, own);
  }
  return distance;
}

std::pair<Vector, Vector> Shape::bounds() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
  for (const Part& part : parts) {
    if (part.is_cut_out) continue;
    for (int k = 0; k < 3; ++k) {
      const double half = part.kind == Kind::box ? 0.5 * component(part.size, k)
                          : part.kind == Kind::cylinder && k == part.axis ? 0.5 * part.length
                                                                          : part.radius;
      component(lower, k) = std::min(component(lower, k), component(part.offset, k) - half);
      component(upper, k) = std::max(component(upper, k), component(part.offset, k) + half);
    }
  }
  return {lower, upper};
}

double share_inside(double distance_in_radii) {
  if (distance_in_radii <= -1) return 1;
  if (distance_in_radii >= 1) return 0;
  const double depth = 1 - distance_in_radii;
  return 0.25 * depth * depth * (2 + distance_in_radii);
}

}  // namespace solidem
