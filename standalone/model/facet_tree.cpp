// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/facet_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace solidem {

namespace {

constexpr std::int32_t facets_of_a_leaf = 4;

Vector vertex_of(const TriangleMesh& mesh, std::int32_t facet, std::size_t corner) {
  const Facet& corners = mesh.facets[static_cast<std::size_t>(facet)];
  return mesh.vertices[static_cast<std::size_t>(corners[corner % 3])];
}

/// Angle of a facet at a corner, rad.
double angle_at(const TriangleMesh& mesh, std::int32_t facet, std::size_t corner) {
  const Vector at = vertex_of(mesh, facet, corner);
  const Vector a = vertex_of(mesh, facet, corner + 1) - at;
  const Vector b = vertex_of(mesh, facet, corner + 2) - at;
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace

FacetTree::FacetTree(TriangleMesh mesh)
    : mesh_(std::move(mesh)), closed_(solidem::is_closed(mesh_)), across_(facets_across(mesh_)) {
  for (const Facet& facet : mesh_.facets) {
    const Vector area = area_vector(mesh_, facet);
    normal_.push_back((1 / norm(area)) * area);
  }
  weigh_normals();
  note_facets_around();
  order_.resize(mesh_.facets.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vector> centres;
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(order_.size()); ++f)
    centres.push_back((1.0 / 3) *
                      (vertex_of(mesh_, f, 0) + vertex_of(mesh_, f, 1) + vertex_of(mesh_, f, 2)));
  build(0, static_cast<std::int32_t>(order_.size()), centres);
}

void FacetTree::weigh_normals() {
  vertex_normal_.assign(mesh_.vertices.size(), {});
  for (std::size_t f = 0; f < mesh_.facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      vertex_normal_[static_cast<std::size_t>(mesh_.facets[f][k])] +=
          angle_at(mesh_, static_cast<std::int32_t>(f), k) * normal_[f];
}

void FacetTree::note_facets_around() {
  around_first_.assign(mesh_.vertices.size() + 1, 0);
  for (const Facet& facet : mesh_.facets)
    for (const std::int32_t v : facet) ++around_first_[static_cast<std::size_t>(v) + 1];
  std::partial_sum(around_first_.begin(), around_first_.end(), around_first_.begin());
  around_.resize(3 * mesh_.facets.size());
  std::vector<std::int32_t> next(around_first_.begin(), around_first_.end() - 1);
  for (std::size_t f = 0; f < mesh_.facets.size(); ++f)
    for (const std::int32_t v : mesh_.facets[f])
      around_[static_cast<std::size_t>(next[static_cast<std::size_t>(v)]++)] =
          static_cast<std::int32_t>(f);
}

void FacetTree::build(std::int32_t first, std::int32_t last, const std::vector<Vector>& centres) {
  const std::size_t here = nodes_.size();
  Node node{vertex_of(mesh_, order_[static_cast<std::size_t>(first)], 0), {}, 0, 0, 0};
  node.upper = node.lower;
  for (std::int32_t k = first; k < last; ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector p = vertex_of(mesh_, order_[static_cast<std::size_t>(k)], c);
      for (int axis = 0; axis < 3; ++axis) {
        component(node.lower, axis) = std::min(component(node.lower, axis), component(p, axis));
        component(node.upper, axis) = std::max(component(node.upper, axis), component(p, axis));
      }
    }
  const bool is_leaf = last - first <= facets_of_a_leaf;
  if (is_leaf) {
    node.first = first;
    node.last = last;
  }
  nodes_.push_back(node);
  if (!is_leaf) {
    const Vector size = node.upper - node.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::int32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::int32_t a, std::int32_t b) {
                       const double at = component(centres[static_cast<std::size_t>(a)], axis);
                       const double other = component(centres[static_cast<std::size_t>(b)], axis);
                       return at != other ? at < other : a < b;
                     });
    build(first, middle, centres);
    build(middle, last, centres);
  }
  nodes_[here].next = static_cast<std::int32_t>(nodes_.size());
}

double FacetTree::squared_distance(const Node& node, const Vector& point) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = component(point, axis);
    const double out =
        std::max({component(node.lower, axis) - p, p - component(node.upper, axis), 0.0});
    sum += out * out;
  }
  return sum;
}

ClosestPoint FacetTree::closest_on(std::int32_t facet, const Vector& point) const {
  // The regions of the plane around a triangle, one after the other: C. Ericson, Real-Time
  // Collision Detection (2005), 5.1.5.
  using Part = ClosestPoint::Part;
  const Vector a = vertex_of(mesh_, facet, 0), b = vertex_of(mesh_, facet, 1),
               c = vertex_of(mesh_, facet, 2);
  const auto at = [&](const Vector& position, Part part, int which) {
    return ClosestPoint{position, norm(point - position), facet, part, which};
  };
  const Vector ab = b - a, ac = c - a;
  const double a1 = dot(ab, point - a), a2 = dot(ac, point - a);
  if (a1 <= 0 && a2 <= 0) return at(a, Part::corner, 0);
  const double b1 = dot(ab, point - b), b2 = dot(ac, point - b);
  if (b1 >= 0 && b2 <= b1) return at(b, Part::corner, 1);
  const double in_c = a1 * b2 - b1 * a2;
  if (in_c <= 0 && a1 >= 0 && b1 <= 0) return at(a + (a1 / (a1 - b1)) * ab, Part::side, 0);
  const double c1 = dot(ab, point - c), c2 = dot(ac, point - c);
  if (c2 >= 0 && c1 <= c2) return at(c, Part::corner, 2);
  const double in_b = c1 * a2 - a1 * c2;
  if (in_b <= 0 && a2 >= 0 && c2 <= 0) return at(a + (a2 / (a2 - c2)) * ac, Part::side, 2);
  const double in_a = b1 * c2 - c1 * b2;
  if (in_a <= 0 && b2 - b1 >= 0 && c1 - c2 >= 0)
    return at(b + ((b2 - b1) / ((b2 - b1) + (c1 - c2))) * (c - b), Part::side, 1);
  const Vector& normal = normal_[static_cast<std::size_t>(facet)];
  const double height = dot(normal, point - a);
  return {point - height * normal, std::fabs(height), facet, Part::face, 0};
}

ClosestPoint FacetTree::closest(const Vector& point, double within) const {
  ClosestPoint best;
  best.distance = within;
  std::int32_t node = 0;
  const auto count = static_cast<std::int32_t>(nodes_.size());
  while (node < count) {
    const Node& at = nodes_[static_cast<std::size_t>(node)];
    if (squared_distance(at, point) > best.distance * best.distance) {
      node = at.next;
      continue;
    }
    for (std::int32_t k = at.first; k < at.last; ++k) {
      const ClosestPoint found = closest_on(order_[static_cast<std::size_t>(k)], point);
      const bool is_better =
          found.distance < best.distance ||
          (found.distance == best.distance && best.facet >= 0 && found.facet < best.facet);
      if (is_better) best = found;
    }
    ++node;
  }
  return best;
}

Vector FacetTree::normal_at(const ClosestPoint& closest) const {
  const auto f = static_cast<std::size_t>(closest.facet);
  const auto k = static_cast<std::size_t>(closest.which);
  if (closest.part == ClosestPoint::Part::face) return normal_[f];
  if (closest.part == ClosestPoint::Part::corner)
    return vertex_normal_[static_cast<std::size_t>(mesh_.facets[f][k])];
  const std::int32_t other = across_[f][k];
  return other < 0 ? normal_[f] : normal_[f] + normal_[static_cast<std::size_t>(other)];
}

double FacetTree::signed_distance(const Vector& point) const {
  const ClosestPoint found = closest(point);
  return dot(point - found.position, normal_at(found)) < 0 ? -found.distance : found.distance;
}

}  // namespace solidem
