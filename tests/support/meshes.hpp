// SPDX-License-Identifier: GPL-2.0-or-later
//
// Meshes that tests know all of.
#ifndef SOLIDEM_TESTS_SUPPORT_MESHES_HPP
#define SOLIDEM_TESTS_SUPPORT_MESHES_HPP

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "model/triangle_mesh.hpp"

namespace solidem::test {

/// A box between two corners, its twelve facets looking outwards.
inline TriangleMesh box_mesh(const Vector& lower, const Vector& upper) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back({(k & 1) != 0 ? upper.x : lower.x, (k & 2) != 0 ? upper.y : lower.y,
                             (k & 4) != 0 ? upper.z : lower.z});
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A flat square in the plane z = height, n × n cells of two facets each, which look up.
inline TriangleMesh sheet_mesh(double side, int n, double height = 0) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.vertices.push_back({side * i / n - side / 2, side * j / n - side / 2, height});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.facets.push_back({a, b, d});
      mesh.facets.push_back({a, d, c});
    }
  return mesh;
}

/// A ball of facets: an octahedron whose facets are split in four so often.
inline TriangleMesh ball_mesh(double radius, int splits) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.facets = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [at, is_new] =
          middles.emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh.vertices.size()));
      if (is_new) {
        const Vector sum =
            mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)];
        mesh.vertices.push_back((1 / norm(sum)) * sum);
      }
      return at->second;
    };
    std::vector<Facet> facets;
    for (const auto& [a, b, c] : mesh.facets) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Facet& facet :
           {Facet{a, ab, ca}, Facet{ab, b, bc}, Facet{ca, bc, c}, Facet{ab, bc, ca}})
        facets.push_back(facet);
    }
    mesh.facets = facets;
  }
  for (Vector& vertex : mesh.vertices) vertex = radius * vertex;
  return mesh;
}

}  // namespace solidem::test

#endif
