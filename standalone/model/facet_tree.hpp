// SPDX-License-Identifier: GPL-2.0-or-later
//
// A tree of boxes around the facets of a mesh, which finds those near a point, and whether a point
// is inside.
//
// The side of a point is that of its closest point's normal, weighted at edges and vertices by the
// facets' angles: J. A. Bærentzen, H. Aanæs, "Signed distance computation using the angle weighted
// pseudonormal", IEEE Transactions on Visualization and Computer Graphics 11 (2005).
#ifndef SOLIDEM_MODEL_FACET_TREE_HPP
#define SOLIDEM_MODEL_FACET_TREE_HPP

#include <cstdint>
#include <limits>
#include <vector>

#include "model/triangle_mesh.hpp"

namespace solidem {

/// The point of a facet that is closest to another point, and the part of the facet it belongs to.
struct ClosestPoint {
  enum class Part { face, side, corner };
  Vector position{};                                          ///< m
  double distance = std::numeric_limits<double>::infinity();  ///< m, not negative
  std::int32_t facet = -1;
  Part part = Part::face;
  int which = 0;  ///< side (from corner k to k + 1) or corner
};

class FacetTree {
 public:
  /// `mesh` must be a surface: `fault_of` finds nothing.
  explicit FacetTree(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  bool is_closed() const { return closed_; }
  /// Facets at the sides of each: facets_across.
  const std::vector<Facet>& across() const { return across_; }
  /// Unit normals of the facets.
  const std::vector<Vector>& normals() const { return normal_; }

  /// On one facet.
  ClosestPoint closest_on(std::int32_t facet, const Vector& point) const;
  /// On the whole mesh, if it is nearer than `within`; else facet −1. The lowest facet of those
  /// equally near.
  ClosestPoint closest(const Vector& point,
                       double within = std::numeric_limits<double>::infinity()) const;
  /// Outward normal there: the facet's, or the weighted one of an edge or a vertex; not of unit
  /// length.
  Vector normal_at(const ClosestPoint& closest) const;
  /// Distance from a closed mesh, m: negative inside.
  double signed_distance(const Vector& point) const;
  /// Whether a point is inside of a closed mesh.
  bool contains(const Vector& point) const { return signed_distance(point) < 0; }

  /// Calls visit(facet) for all facets whose boxes reach into a ball, and for few others.
  template <class Visit>
  void for_each_near(const Vector& centre, double radius, const Visit& visit) const {
    std::int32_t node = 0;
    const auto count = static_cast<std::int32_t>(nodes_.size());
    while (node < count) {
      const Node& at = nodes_[static_cast<std::size_t>(node)];
      const bool is_near = squared_distance(at, centre) <= radius * radius;
      if (is_near)
        for (std::int32_t k = at.first; k < at.last; ++k)
          visit(order_[static_cast<std::size_t>(k)]);
      node = is_near ? node + 1 : at.next;
    }
  }
  /// Facets around a vertex.
  template <class Visit>
  void for_each_around(std::int32_t vertex, const Visit& visit) const {
    const auto v = static_cast<std::size_t>(vertex);
    for (std::int32_t k = around_first_[v]; k < around_first_[v + 1]; ++k)
      visit(around_[static_cast<std::size_t>(k)]);
  }

 private:
  /// Nodes stand in the order of a walk down the first branches; `next` is where it goes on when a
  /// node is left out. Leaves hold facets first ≤ k < last of the order.
  struct Node {
    Vector lower, upper;
    std::int32_t next, first, last;
  };
  static double squared_distance(const Node& node, const Vector& point);
  void build(std::int32_t first, std::int32_t last, const std::vector<Vector>& centres);
  void weigh_normals();
  void note_facets_around();

  TriangleMesh mesh_;
  bool closed_;
  std::vector<Facet> across_;
  std::vector<Vector> normal_;         ///< of facets, unit
  std::vector<Vector> vertex_normal_;  ///< weighted by angles
  std::vector<std::int32_t> around_first_, around_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace solidem

#endif
