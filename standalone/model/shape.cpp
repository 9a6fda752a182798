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

/// The radius at which a plane cuts balls as the round surface does, in the mean over their places:
/// their shares then sum to the volume of the solid. (r²/5 is the mean square distance of a ball's
/// volume from a plane through its centre.)
double cutting_radius(const Shape::Part& part, double ball_radius) {
  const double square = 0.2 * ball_radius * ball_radius;
  if (part.kind == Shape::Kind::sphere) return std::max(0.0, part.radius - square / part.radius);
  return std::sqrt(std::max(0.0, part.radius * part.radius - square));
}

double distance_of(const Shape::Part& part, const Vector& point, double ball_radius) {
  const Vector p = point - part.offset;
  switch (part.kind) {
    case Shape::Kind::sphere:
      break;
    case Shape::Kind::cylinder: {
      const double along = component(p, part.axis);
      const double across = std::sqrt(std::max(0.0, dot(p, p) - along * along));
      return corner_distance<2>(
          {across - cutting_radius(part, ball_radius), std::fabs(along) - 0.5 * part.length});
    }
    case Shape::Kind::box:
      return corner_distance<3>({std::fabs(p.x) - 0.5 * part.size.x,
                                 std::fabs(p.y) - 0.5 * part.size.y,
                                 std::fabs(p.z) - 0.5 * part.size.z});
  }
  return norm(p) - cutting_radius(part, ball_radius);
}

}  // namespace

double Shape::signed_distance(const Vector& point, double ball_radius) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) {
    const double own = distance_of(part, point, ball_radius);
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

double fraction_inside(double distance_in_radii) {
  if (distance_in_radii <= -1) return 1;
  if (distance_in_radii >= 1) return 0;
  const double depth = 1 - distance_in_radii;
  return 0.25 * depth * depth * (2 + distance_in_radii);
}

}  // namespace solidem
