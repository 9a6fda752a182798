// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/walls.hpp"

#include <algorithm>
#include <cmath>

#include "laws/constants.hpp"

namespace solidem {

namespace {

void add_flat_ends(const Domain& domain, std::vector<Wall>& walls) {
  const Vector extent = domain.upper - domain.lower;
  const bool round = domain.radius > 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (domain.periodic[axis] || (round && axis != domain.axis)) continue;
    const double R = domain.radius, r = domain.inner_radius;
    const double area = round
                            ? 0.5 * domain.arc() * (R - r) * (R + r)
                            : component(extent, (axis + 1) % 3) * component(extent, (axis + 2) % 3);
    for (const bool high : {false, true}) {
      Vector normal{};
      component(normal, axis) = high ? 1.0 : -1.0;
      walls.push_back({std::string(1, "xyz"[axis]) + (high ? "_high" : "_low"), area,
                       high ? domain.upper : domain.lower, normal});
    }
  }
}

void add_round_walls(const Domain& domain, std::vector<Wall>& walls) {
  if (domain.is_sphere()) {
    const double R = domain.radius;
    walls.push_back({"surface", 4 * pi * R * R, domain.axis_point(), {}, R});
    return;
  }
  const double length = component(domain.upper - domain.lower, domain.axis);
  const double R = domain.radius, r = domain.inner_radius, arc = domain.arc();
  const Vector centre = domain.axis_point();
  Vector along{};
  component(along, domain.axis) = 1.0;
  if (r > 0) walls.push_back({"inner", arc * r * length, centre, along, r, true});
  walls.push_back({r > 0 ? "outer" : "side", arc * R * length, centre, along, R, false});
  if (!(domain.angle > 0)) return;
  const Vector last =
      -std::sin(arc) * domain.first_transverse() + std::cos(arc) * domain.second_transverse();
  walls.push_back({"first", (R - r) * length, centre, -domain.second_transverse()});
  walls.push_back({"last", (R - r) * length, centre, last});
}

}  // namespace

double Wall::distance(const Vector& from) const {
  const Vector chord = from - point;
  if (!(radius > 0)) return -dot(direction, chord);
  const double across = norm(chord - dot(direction, chord) * direction);
  return concave ? across - radius : radius - across;
}

double Wall::conduction_length(const Vector& from) const {
  const double normal_distance = distance(from);
  if (!(radius > 0)) return normal_distance;
  const double from_axis = concave ? radius + normal_distance : radius - normal_distance;
  const double share = std::max(from_axis / radius, 0.5);
  const bool is_sphere = !(dot(direction, direction) > 0);
  return is_sphere ? radius * std::abs(1 / share - 1) : radius * std::abs(std::log(share));
}

std::vector<Wall> walls_of(const Domain& domain) {
  std::vector<Wall> walls;
  if (!domain.has_walls()) return walls;
  add_flat_ends(domain, walls);
  if (domain.radius > 0) add_round_walls(domain, walls);
  return walls;
}

std::vector<Wall> walls_of_shape(Domain domain) {
  domain.cuts = 0;
  return walls_of(domain);
}

std::vector<std::string> wall_names(const Domain& domain) {
  std::vector<std::string> names;
  for (const Wall& wall : walls_of(domain)) names.push_back(wall.name);
  return names;
}

double wall_area(const Domain& domain) {
  double area = 0;
  for (const Wall& wall : walls_of(domain)) area += wall.area;
  return area;
}

}  // namespace solidem
