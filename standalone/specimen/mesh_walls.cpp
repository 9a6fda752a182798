// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/mesh_walls.hpp"

#include <algorithm>
#include <cmath>

namespace solidem {

namespace {

constexpr double parallel = 0.87;  // cos 30°: walls nearer to each other than this are one
constexpr int probes = 12;         // along each side of the mesh's box

// Whether no place of the surface around a closest point is closer still.
bool is_local(const FacetTree& surface, const ClosestPoint& at, const Vector& point) {
  using Part = ClosestPoint::Part;
  if (at.part == Part::face) return true;
  const double closer = at.distance * (1 - 1e-9);
  const auto f = static_cast<std::size_t>(at.facet), k = static_cast<std::size_t>(at.which);
  if (at.part == Part::side)
    return !(surface.closest_on(surface.across()[f][k], point).distance < closer);
  bool is_closest = true;
  surface.for_each_around(surface.mesh().facets[f][k], [&](std::int32_t facet) {
    if (surface.closest_on(facet, point).distance < closer) is_closest = false;
  });
  return is_closest;
}

}  // namespace

Vector push_of_walls(const FacetTree& surface, const Vector& centre, double radius) {
  const ClosestPoint closest = surface.closest(centre);
  const Vector outward = surface.normal_at(closest);
  if (dot(centre - closest.position, outward) >= 0)
    return (-(radius + closest.distance) / norm(outward)) * outward;
  if (!(closest.distance < radius)) return {};
  std::vector<ClosestPoint> places;
  surface.for_each_near(centre, radius, [&](std::int32_t facet) {
    const ClosestPoint at = surface.closest_on(facet, centre);
    if (at.distance < radius && is_local(surface, at, centre)) places.push_back(at);
  });
  std::sort(places.begin(), places.end(), [](const ClosestPoint& a, const ClosestPoint& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.facet < b.facet;
  });
  Vector push{};
  std::vector<Vector> walls;
  for (const ClosestPoint& at : places) {
    const Vector inward = (1 / at.distance) * (centre - at.position);
    if (std::any_of(walls.begin(), walls.end(),
                    [&](const Vector& wall) { return dot(wall, inward) > parallel; }))
      continue;
    walls.push_back(inward);
    push += (radius - at.distance) * inward;
  }
  return push;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Facet& facet : mesh.facets) sum += norm(area_vector(mesh, facet));
  return sum;
}

TriangleMesh scaled(const TriangleMesh& mesh, double unit, const Vector& origin) {
  TriangleMesh result = mesh;
  for (Vector& vertex : result.vertices) vertex = (1 / unit) * (vertex - origin);
  return result;
}

double largest_inner_radius(const FacetTree& surface) {
  const auto [lower, upper] = bounds(surface.mesh());
  const Vector step = (1.0 / probes) * (upper - lower);
  double largest = 0;
  for (int i = 0; i < probes; ++i)
    for (int j = 0; j < probes; ++j)
      for (int k = 0; k < probes; ++k)
        largest = std::max(
            largest, -surface.signed_distance(lower + Vector{(i + 0.5) * step.x, (j + 0.5) * step.y,
                                                             (k + 0.5) * step.z}));
  return largest;
}

}  // namespace solidem
