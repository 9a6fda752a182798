// SPDX-License-Identifier: GPL-2.0-or-later
//
// A closed mesh as the walls of a packing.
#ifndef SOLIDEM_SPECIMEN_MESH_WALLS_HPP
#define SOLIDEM_SPECIMEN_MESH_WALLS_HPP

#include "model/facet_tree.hpp"

namespace solidem {

/// By how much a mesh pushes a sphere that reaches through it back inside, as walls that repel by
/// the overlap: each place of the surface that is closer than all around it, and within the radius,
/// is a wall of its own, unless a closer one is nearly parallel. A centre that is outside is pushed
/// back through the closest point.
Vector push_of_walls(const FacetTree& surface, const Vector& centre, double radius);

/// Area of a mesh, m².
double area(const TriangleMesh& mesh);

/// A mesh in units of `unit`, from a new origin.
TriangleMesh scaled(const TriangleMesh& mesh, double unit, const Vector& origin);

/// Radius of about the largest sphere that fits into a closed mesh, m: the best of many points.
double largest_inner_radius(const FacetTree& surface);

}  // namespace solidem

#endif
