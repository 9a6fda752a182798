// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/polyhedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "laws/constants.hpp"

namespace solidem {

namespace {

/// Twice the area of a polygon along its normal.
Vector doubled_area(const std::vector<Vector>& corners) {
  Vector sum{};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
  return sum;
}

/// Puts points of a plane in their order about its normal.
void sort_about(const Vector& normal, std::vector<Vector>& points) {
  Vector middle{};
  for (const Vector& p : points) middle += (1.0 / static_cast<double>(points.size())) * p;
  const Vector other = std::fabs(normal.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
  const Vector u = cross(other, normal), v = cross(normal, u);
  const auto angle = [&](const Vector& p) {
    return std::atan2(dot(p - middle, v), dot(p - middle, u));
  };
  std::sort(points.begin(), points.end(),
            [&](const Vector& a, const Vector& b) { return angle(a) < angle(b); });
  // Two faces meet in each of them.
  const auto same = [](const Vector& a, const Vector& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
}

/// A plane, and how near to it what counts as on it.
struct Knife {
  Vector normal;
  double offset, margin;

  double over(const Vector& point) const {
    const double distance = dot(normal, point) - offset;
    return std::fabs(distance) <= margin ? 0 : distance;
  }
};

/// The part of a face where normal · x ≤ offset; where it is cut, the cuts join the rim.
std::vector<Vector> clipped_face(const std::vector<Vector>& face, const Knife& knife,
                                 std::vector<Vector>& rim, bool& is_cut) {
  std::vector<Vector> kept;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vector &a = face[k], &b = face[(k + 1) % face.size()];
    const double over_a = knife.over(a), over_b = knife.over(b);
    is_cut = is_cut || over_a > 0;
    if (over_a <= 0) kept.push_back(a);
    if (over_a == 0) rim.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
      // From the inner end, so that both faces of an edge are cut at the same point.
      const Vector cut = over_a < 0 ? a + (over_a / (over_a - over_b)) * (b - a)
                                    : b + (over_b / (over_b - over_a)) * (a - b);
      kept.push_back(cut);
      rim.push_back(cut);
    }
  }
  return kept;
}

/// An edge as seen from the foot of a perpendicular on its plane, in the frame of the edge.
struct EdgeFromFoot {
  double distance;  ///< of its line from the foot
  double from, to;  ///< along the line, from the point nearest to the foot
  double sign;      ///< of the triangle that it makes with the foot
};

/// Calls visit(edge) for each edge of a polygon in a plane.
template <class Visit>
void for_each_edge(const std::vector<Vector>& corners, const Vector& normal, const Vector& foot,
                   const Visit& visit) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector a = corners[k] - foot, b = corners[(k + 1) % corners.size()] - foot;
    const Vector along = b - a;
    const double length = norm(along);
    if (!(length > 0)) continue;
    const double across = dot(normal, cross(a, b)) / length;
    if (across == 0) continue;
    visit(EdgeFromFoot{std::fabs(across), dot(a, along) / length, dot(b, along) / length,
                       across > 0 ? 1.0 : -1.0});
  }
}

/// Volume, inside of a ball, of the cone from its centre over the triangle of an edge and the foot
/// at a height; `radius` is the ball's.
double cone_over_triangle(const EdgeFromFoot& edge, double height, double radius) {
  const double h = height, p = edge.distance;
  const double reach = std::sqrt(h * h + p * p), cube = radius * radius * radius / 3;
  const double disc_square = std::max(0.0, radius * radius - h * h);
  // Up to where the edge lies inside of the ball, along its line.
  const double inner = std::sqrt(std::max(0.0, disc_square - p * p));
  const auto integral = [&](double t) {
    const double within = std::clamp(t, -inner, inner);
    const double angle = std::atan2(t, p);
    const double outer_angle = angle - std::atan2(within, p);
    const auto shadow = [&](double s) {
      return std::asin(std::clamp(h / reach * s / std::hypot(s, p), -1.0, 1.0));
    };
    const double sine_part = shadow(t) - shadow(within);
    const double flat = h / 6 * (p * within + disc_square * outer_angle);
    return flat + cube * (std::min(1.0, h / radius) * outer_angle - sine_part);
  };
  return edge.sign * (integral(edge.to) - integral(edge.from));
}

/// A point of the plane across a cylinder's axis.
struct Point {
  double x, y;
};
double cross(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}
double dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y;
}

/// Area and first moments.
struct Moments {
  double area = 0, x = 0, y = 0;
};

void add_triangle(const Point& a, const Point& b, Moments& sum) {
  const double area = 0.5 * cross(a, b);
  sum.area += area;
  sum.x += area * (a.x + b.x) / 3;
  sum.y += area * (a.y + b.y) / 3;
}

void add_sector(const Point& a, const Point& b, double radius, Moments& sum) {
  const double length_a = std::sqrt(dot(a, a)), length_b = std::sqrt(dot(b, b));
  const double cube = radius * radius * radius / 3;
  sum.area += 0.5 * radius * radius * std::atan2(cross(a, b), dot(a, b));
  sum.x += cube * (b.y / length_b - a.y / length_a);
  sum.y -= cube * (b.x / length_b - a.x / length_a);
}

/// Adds what a circle about the origin holds of the triangle between the origin and an edge.
void add_edge(const Point& a, const Point& b, double radius, Moments& sum) {
  const Point along{b.x - a.x, b.y - a.y};
  const double square = dot(along, along);
  if (!(square > 0)) return;
  const double middle = -dot(a, along) / square;
  const double across = cross(a, along);
  const double half_square = (radius * radius - across * across / square) / square;
  const auto at = [&](double t) { return Point{a.x + t * along.x, a.y + t * along.y}; };
  if (!(half_square > 0)) return add_sector(a, b, radius, sum);
  const double half = std::sqrt(half_square);
  const double enter = std::clamp(middle - half, 0.0, 1.0);
  const double leave = std::clamp(middle + half, 0.0, 1.0);
  if (enter > 0) add_sector(a, at(enter), radius, sum);
  if (leave > enter) add_triangle(at(enter), at(leave), sum);
  if (leave < 1) add_sector(at(leave), b, radius, sum);
}

/// ∫ (1 − exp(−2(p² + t²)/w²)) p/(p² + t²) dt, whose kernel is smooth.
double gaussian_along(double p, double from, double to, double w) {
  // Ten points of Gauss and Legendre: more digits than are asked for over the few w that count.
  static constexpr std::array<double, 5> place{0.1488743389816312, 0.4333953941292472,
                                               0.6794095682990244, 0.8650633666889845,
                                               0.9739065285171717};
  static constexpr std::array<double, 5> weight{0.2955242247147529, 0.2692667193099963,
                                                0.2190863625159820, 0.1494513491505806,
                                                0.0666713443086881};
  const auto kernel = [&](double t) {
    const double q = 2 * (p * p + t * t) / (w * w);
    return 2 * p / (w * w) * (q > 1e-12 ? -std::expm1(-q) / q : 1.0);
  };
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (std::size_t k = 0; k < place.size(); ++k)
    sum += weight[k] * (kernel(middle - half * place[k]) + kernel(middle + half * place[k]));
  return half * sum;
}

}  // namespace

Polyhedron box_between(const Vector& lower, const Vector& upper) {
  const auto corner = [&](int k) {
    return Vector{(k & 1) != 0 ? upper.x : lower.x, (k & 2) != 0 ? upper.y : lower.y,
                  (k & 4) != 0 ? upper.z : lower.z};
  };
  Polyhedron box;
  for (const std::array<int, 4>& face : {std::array<int, 4>{0, 4, 6, 2},
                                         {1, 3, 7, 5},
                                         {0, 1, 5, 4},
                                         {2, 6, 7, 3},
                                         {0, 2, 3, 1},
                                         {4, 5, 7, 6}}) {
    box.faces.emplace_back();
    for (const int k : face) box.faces.back().push_back(corner(k));
  }
  return box;
}

Polyhedron slab_of(const std::vector<Vector>& corners, double thickness) {
  const Vector area = doubled_area(corners);
  const double size = norm(area);
  if (!(size > 0)) return {};
  const Vector up = (0.5 * thickness / size) * area;
  Polyhedron slab;
  std::vector<Vector> top, bottom;
  for (const Vector& p : corners) {
    top.push_back(p + up);
    bottom.insert(bottom.begin(), p - up);
  }
  slab.faces = {top, bottom};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector &a = corners[k], &b = corners[(k + 1) % corners.size()];
    slab.faces.push_back({a - up, b - up, b + up, a + up});
  }
  return slab;
}

std::vector<Vector> even_directions(int count) {
  const double turn = pi * (3 - std::sqrt(5.0));  // the golden angle
  std::vector<Vector> directions;
  for (int k = 0; k < count; ++k) {
    const double z = (2 * k + 1.0) / count - 1, across = std::sqrt(1 - z * z);
    directions.push_back({across * std::cos(turn * k), across * std::sin(turn * k), z});
  }
  return directions;
}

Polyhedron ball_of_facets(const Vector& centre, double volume_of_ball) {
  static const Polyhedron unit = [] {
    Polyhedron ball = box_between({-2, -2, -2}, {2, 2, 2});
    for (const Vector& n : even_directions(120)) ball = clipped(ball, n, 1);
    return ball;
  }();
  const double scale = std::cbrt(volume_of_ball / volume(unit));
  Polyhedron ball = unit;
  for (std::vector<Vector>& face : ball.faces)
    for (Vector& p : face) p = centre + scale * p;
  return ball;
}

Polyhedron clipped(const Polyhedron& solid, const Vector& normal, double offset) {
  // A face that lies in the plane but for round-off must not be cut to shreds.
  double farthest = std::fabs(offset);
  for (const std::vector<Vector>& face : solid.faces)
    for (const Vector& corner : face) farthest = std::max(farthest, std::fabs(dot(normal, corner)));
  std::vector<int> source;
  return clipped(solid, normal, offset, 1e-14 * farthest, source);
}

Polyhedron clipped(const Polyhedron& solid, const Vector& normal, double offset, double margin,
                   std::vector<int>& source) {
  Polyhedron rest;
  std::vector<Vector> rim;
  bool is_cut = false, has_inside = false;
  source.clear();
  const Knife knife{normal, offset, margin};
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    std::vector<Vector> kept = clipped_face(solid.faces[f], knife, rim, is_cut);
    if (kept.size() < 3) continue;
    has_inside = has_inside || std::any_of(kept.begin(), kept.end(),
                                           [&](const Vector& p) { return knife.over(p) < 0; });
    rest.faces.push_back(std::move(kept));
    source.push_back(static_cast<int>(f));
  }
  if (!is_cut) {
    source.resize(solid.faces.size());
    std::iota(source.begin(), source.end(), 0);
    return solid;
  }
  if (!has_inside) {
    source.clear();
    return {};
  }
  sort_about(normal, rim);
  if (rim.size() < 3) return rest;
  rest.faces.push_back(std::move(rim));
  source.push_back(-1);
  return rest;
}

std::pair<Vector, Vector> bounds(const Polyhedron& solid) {
  Vector lower = solid.faces[0][0], upper = lower;
  for (const std::vector<Vector>& face : solid.faces)
    for (const Vector& p : face)
      for (int k = 0; k < 3; ++k) {
        component(lower, k) = std::min(component(lower, k), component(p, k));
        component(upper, k) = std::max(component(upper, k), component(p, k));
      }
  return {lower, upper};
}

double volume(const Polyhedron& solid) {
  if (solid.empty()) return 0;
  const Vector origin = solid.faces[0][0];
  double sum = 0;
  for (const std::vector<Vector>& face : solid.faces)
    sum += dot(face[0] - origin, doubled_area(face)) / 6;
  return sum;
}

double volume_in_ball(const Polyhedron& solid, const Vector& centre, double radius) {
  double sum = 0;
  for (const std::vector<Vector>& face : solid.faces) {
    const Vector area = doubled_area(face);
    const double size = norm(area);
    if (!(size > 0)) continue;
    const Vector normal = (1 / size) * area;
    const double height = dot(normal, face[0] - centre);
    if (height == 0) continue;
    double cone = 0;
    for_each_edge(face, normal, centre + height * normal, [&](const EdgeFromFoot& edge) {
      cone += cone_over_triangle(edge, std::fabs(height), radius);
    });
    sum += height > 0 ? cone : -cone;
  }
  return std::max(0.0, sum);
}

double volume_in_cylinder(const Polyhedron& solid, const Vector& centre, int axis, double radius) {
  constexpr double upright = 1e-8;  // faces along the axis have nothing below
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  double sum = 0;
  for (const std::vector<Vector>& face : solid.faces) {
    const Vector area = doubled_area(face);
    const double size = norm(area);
    const double along = component(area, axis);
    if (!(std::fabs(along) > upright * size)) continue;
    Moments moments;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector a = face[k] - centre, b = face[(k + 1) % face.size()] - centre;
      add_edge({component(a, u), component(a, v)}, {component(b, u), component(b, v)}, radius,
               moments);
    }
    sum += (dot(area, face[0] - centre) * moments.area - component(area, u) * moments.x -
            component(area, v) * moments.y) /
           along;
  }
  return std::max(0.0, sum);
}

double gaussian_over(const std::vector<Vector>& corners, const Vector& centre, double w) {
  const Vector area = doubled_area(corners);
  const double size = norm(area);
  if (!(size > 0)) return 0;
  const Vector normal = (1 / size) * area;
  const Vector foot = centre + dot(normal, corners[0] - centre) * normal;
  const double reach = 2 * w, whole = -std::expm1(-8.0);
  double sum = 0;
  for_each_edge(corners, normal, foot, [&](const EdgeFromFoot& edge) {
    const double p = edge.distance;
    const double inner = std::sqrt(std::max(0.0, reach * reach - p * p));
    const double from = std::clamp(edge.from, -inner, inner);
    const double to = std::clamp(edge.to, -inner, inner);
    const double outer = std::atan2(edge.to, p) - std::atan2(to, p) -
                         (std::atan2(edge.from, p) - std::atan2(from, p));
    sum += edge.sign * (gaussian_along(p, from, to, w) + whole * outer);
  });
  return std::max(0.0, 0.25 * w * w * sum);
}

}  // namespace solidem
