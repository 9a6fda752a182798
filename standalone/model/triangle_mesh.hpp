// SPDX-License-Identifier: GPL-2.0-or-later
//
// Surfaces of flat triangles: bodies and tools that no formula describes.
#ifndef SOLIDEM_MODEL_TRIANGLE_MESH_HPP
#define SOLIDEM_MODEL_TRIANGLE_MESH_HPP

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// Corners of a triangle: indices of vertices, counter-clockwise as seen from outside.
using Facet = std::array<std::int32_t, 3>;

/// A surface of triangles that share vertices. Where it is closed, it bounds a body.
struct TriangleMesh {
  std::vector<Vector> vertices;  ///< m
  std::vector<Facet> facets;
};

/// Normal of a facet, as long as its area, m².
Vector area_vector(const TriangleMesh& mesh, const Facet& facet);

/// Lower and upper corner of the box around it, m. It must have vertices.
std::pair<Vector, Vector> bounds(const TriangleMesh& mesh);

/// What a closed mesh encloses, m³: negative where its facets look inwards.
double volume(const TriangleMesh& mesh);

/// Centre of the volume that a closed mesh encloses, m.
Vector centre_of_volume(const TriangleMesh& mesh);

/// For each facet and each of its sides k, from corner k to corner k + 1, the facet on the other
/// side; −1 where there is none. Each side must belong to two facets at most.
std::vector<Facet> facets_across(const TriangleMesh& mesh);

/// Whether each side of each facet belongs to two of them.
bool is_closed(const TriangleMesh& mesh);

/// What makes a mesh no surface, in words, by the number of a facet (counted from 1): a corner that
/// is no vertex or not finite, a facet without area, one that stands twice, a side that belongs to
/// three, two neighbours of which one is turned over; a closed mesh whose facets look inwards.
/// Empty where it is fit.
std::string fault_of(const TriangleMesh& mesh);

/// What keeps a mesh that is a surface from being closed, in words; empty where it is closed.
std::string gap_of(const TriangleMesh& mesh);

/// Vertices at one place made one; those that no facet uses are left out.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace solidem

#endif
