// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/curved_facets.hpp"

#include <algorithm>
#include <cmath>
#include <voro++/voro++.hh>

#include "laws/constants.hpp"
#include "model/polyhedron.hpp"

namespace solidem {

namespace {

constexpr double largest_sagitta = 2e-3;

// Volume of the solid whose faces touch a unit sphere, one across each direction.
double volume_around_unit_sphere(const std::vector<Vector>& normals) {
  voro::voronoicell solid;
  solid.init(-2, 2, -2, 2, -2, 2);
  for (const Vector& n : normals) solid.plane(n.x, n.y, n.z, 2.0);
  return solid.volume();
}

}  // namespace

Facets cylinder_facets(double radius, double arc, const Vector& first, const Vector& second) {
  // A facet that turns by β has the sagitta R β²/8.
  const double turn = std::min(std::sqrt(8.0 * largest_sagitta / radius), 0.2);
  const int count = static_cast<int>(std::ceil(arc / turn));
  const double half = 0.5 * arc / count;
  Facets facets;
  facets.distance = radius * std::sqrt(half / std::tan(half));
  for (int k = 0; k < count; ++k) {
    const double angle = (2 * k + 1) * half;
    facets.normal.push_back(std::cos(angle) * first + std::sin(angle) * second);
  }
  return facets;
}

Facets sphere_facets(double radius) {
  // The n-th part of the sphere has the sagitta 2 R / n.
  Facets facets;
  facets.normal =
      even_directions(std::max(500, static_cast<int>(std::ceil(2.0 * radius / largest_sagitta))));
  facets.distance = radius * std::cbrt(4.0 / 3.0 * pi / volume_around_unit_sphere(facets.normal));
  return facets;
}

}  // namespace solidem
