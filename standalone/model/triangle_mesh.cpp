// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace solidem {

namespace {

constexpr double without_height = 1e-10;  // of the longest side: less is round-off

const Vector& corner(const TriangleMesh& mesh, const Facet& facet, std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(facet[k % 3])];
}

std::string place(const Vector& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

/// A side of a facet: its ends, the smaller index first.
using Side = std::pair<std::int32_t, std::int32_t>;
struct Use {
  std::int32_t facet;
  std::size_t side;
};

Side side_of(const Facet& facet, std::size_t k) {
  return std::minmax({facet[k], facet[(k + 1) % 3]});
}

std::map<Side, std::vector<Use>> uses_of_sides(const TriangleMesh& mesh) {
  std::map<Side, std::vector<Use>> uses;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      uses[side_of(mesh.facets[f], k)].push_back({static_cast<std::int32_t>(f), k});
  return uses;
}

bool is_finite(const Vector& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// What is wrong with a facet by itself.
std::string fault_of_facet(const TriangleMesh& mesh, const Facet& facet) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (facet[k] < 0 || static_cast<std::size_t>(facet[k]) >= mesh.vertices.size())
      return fmt::format("has the corner {}, but there are {} vertices", facet[k] + 1,
                         mesh.vertices.size());
    if (!is_finite(corner(mesh, facet, k))) return "has a corner that is nowhere (not finite)";
  }
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, norm(corner(mesh, facet, k + 1) - corner(mesh, facet, k)));
  if (2 * norm(area_vector(mesh, facet)) <= without_height * longest * longest)
    return "has no area (at " + place(corner(mesh, facet, 0)) + ")";
  return "";
}

std::string fault_of_side(const TriangleMesh& mesh, const Side& side,
                          const std::vector<Use>& uses) {
  const auto between = [&] {
    return fmt::format("the side between {} and {}",
                       place(mesh.vertices[static_cast<std::size_t>(side.first)]),
                       place(mesh.vertices[static_cast<std::size_t>(side.second)]));
  };
  if (uses.size() > 2)
    return fmt::format("facets {}, {} and {} share {}: no more than two can", uses[0].facet + 1,
                       uses[1].facet + 1, uses[2].facet + 1, between());
  if (uses.size() < 2) return "";
  const auto start = [&](const Use& use) {
    return mesh.facets[static_cast<std::size_t>(use.facet)][use.side];
  };
  if (start(uses[0]) == start(uses[1]))
    return fmt::format("facets {} and {} are turned against each other at {}: one is inverted",
                       uses[0].facet + 1, uses[1].facet + 1, between());
  return "";
}

/// Calls visit(volume of the tetrahedron over a facet, sum of its corners), both from a point near.
template <class Visit>
void for_each_tetrahedron(const TriangleMesh& mesh, const Vector& from, const Visit& visit) {
  for (const Facet& facet : mesh.facets) {
    const Vector a = corner(mesh, facet, 0) - from, b = corner(mesh, facet, 1) - from,
                 c = corner(mesh, facet, 2) - from;
    visit(dot(a, cross(b, c)) / 6, a + b + c);
  }
}

Vector middle(const TriangleMesh& mesh) {
  const auto [lower, upper] = bounds(mesh);
  return 0.5 * (lower + upper);
}

}  // namespace

Vector area_vector(const TriangleMesh& mesh, const Facet& facet) {
  const Vector& a = corner(mesh, facet, 0);
  return 0.5 * cross(corner(mesh, facet, 1) - a, corner(mesh, facet, 2) - a);
}

std::pair<Vector, Vector> bounds(const TriangleMesh& mesh) {
  Vector lower = mesh.vertices.front(), upper = lower;
  for (const Vector& vertex : mesh.vertices)
    for (int k = 0; k < 3; ++k) {
      component(lower, k) = std::min(component(lower, k), component(vertex, k));
      component(upper, k) = std::max(component(upper, k), component(vertex, k));
    }
  return {lower, upper};
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for_each_tetrahedron(mesh, middle(mesh), [&](double part, const Vector&) { sum += part; });
  return sum;
}

Vector centre_of_volume(const TriangleMesh& mesh) {
  const Vector from = middle(mesh);
  double sum = 0;
  Vector moment{};
  for_each_tetrahedron(mesh, from, [&](double part, const Vector& corners) {
    sum += part;
    moment += 0.25 * part * corners;
  });
  return from + (1 / sum) * moment;
}

std::vector<Facet> facets_across(const TriangleMesh& mesh) {
  std::vector<Facet> across(mesh.facets.size(), Facet{-1, -1, -1});
  for (const auto& [side, uses] : uses_of_sides(mesh)) {
    if (uses.size() != 2) continue;
    for (const std::size_t k : {0, 1})
      across[static_cast<std::size_t>(uses[k].facet)][uses[k].side] = uses[1 - k].facet;
  }
  return across;
}

bool is_closed(const TriangleMesh& mesh) {
  return gap_of(mesh).empty();
}

std::string fault_of(const TriangleMesh& mesh) {
  if (mesh.facets.empty()) return "has no facets";
  std::map<Facet, std::size_t> seen;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    std::string fault = fault_of_facet(mesh, mesh.facets[f]);
    if (!fault.empty()) return fmt::format("facet {} {}", f + 1, fault);
    Facet corners = mesh.facets[f];
    std::sort(corners.begin(), corners.end());
    const auto [first, is_new] = seen.emplace(corners, f);
    if (!is_new)
      return fmt::format("facet {} stands twice: it has the corners of facet {}", f + 1,
                         first->second + 1);
  }
  for (const auto& [side, uses] : uses_of_sides(mesh)) {
    std::string fault = fault_of_side(mesh, side, uses);
    if (!fault.empty()) return fault;
  }
  if (is_closed(mesh) && volume(mesh) < 0)
    return "all facets are inverted: they look inwards (corners stand counter-clockwise as seen "
           "from "
           "outside)";
  return "";
}

std::string gap_of(const TriangleMesh& mesh) {
  std::size_t open = 0;
  std::string first;
  std::int32_t of_facet = 0;
  for (const auto& [side, uses] : uses_of_sides(mesh)) {
    if (uses.size() != 1) continue;
    if (open++ > 0 && uses[0].facet >= of_facet) continue;
    of_facet = uses[0].facet;
    first = fmt::format("facet {} has no neighbour at the side between {} and {}", of_facet + 1,
                        place(mesh.vertices[static_cast<std::size_t>(side.first)]),
                        place(mesh.vertices[static_cast<std::size_t>(side.second)]));
  }
  if (open == 0) return "";
  return fmt::format("is not closed: {} ({} open sides in all)", first, open);
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::map<std::tuple<double, double, double>, std::int32_t> known;
  for (const Facet& facet : mesh.facets) {
    Facet corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector& p = corner(mesh, facet, k);
      const auto next = static_cast<std::int32_t>(result.vertices.size());
      // Adding zero makes −0 and 0 one place.
      const auto [at, is_new] = known.emplace(std::tuple(p.x + 0.0, p.y + 0.0, p.z + 0.0), next);
      if (is_new) result.vertices.push_back(p);
      corners[k] = at->second;
    }
    result.facets.push_back(corners);
  }
  return result;
}

}  // namespace solidem
