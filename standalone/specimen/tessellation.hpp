// SPDX-License-Identifier: GPL-2.0-or-later
//
// The body cut into one cell for each element: the radical (Laguerre) Voronoi diagram of the
// spheres, bounded by the body's walls. A cell holds the points whose squared tangent length
// |x − x_i|² − R_i² to its own sphere is the least, so faces stand across the lines of centres, and
// touching spheres meet in their face. Cells are made by voro++.
#ifndef SOLIDEM_SPECIMEN_TESSELLATION_HPP
#define SOLIDEM_SPECIMEN_TESSELLATION_HPP

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "model/polyhedron.hpp"
#include "model/specimen.hpp"
#include "specimen/walls.hpp"

namespace solidem {

/// The part of a wall that belongs to an element.
struct WallFace {
  std::int32_t element;
  double area;      ///< m²
  double distance;  ///< from the element's centre to the wall, m: Wall::conduction_length
};

struct Tessellation {
  std::vector<Pair> faces;       ///< pairs with a face in common; sorted, i < j, each pair once
  std::vector<double> area;      ///< of each face, m²; summed over periodic images of a pair
  std::vector<double> distance;  ///< of the centres through that face, m
  std::vector<double> volume;    ///< of each element's cell, m³; the sum is the body's volume

  /// By name, in the order of elements; areas of a whole wall sum to its exact area. Those of the
  /// shape; `surface` of a mesh; `cut_1`, … of cuts. Of several bodies each has its `body.x_low`.
  std::map<std::string, std::vector<WallFace>> walls;
};

/// Makes the cells. They fit together without gap: cells and walls are closed, Σ area × normal = 0,
/// so that linear fields conduct exactly. Curved walls and cuts are flat facets that all cells
/// share, under .002 R_m off and placed so that volume and section of what they bound are exact. A
/// cell is cut by the faces of cuts and meshes that reach it, which takes no account of whether its
/// parts hang together. Each of several bodies has the cells that it has alone. The same on any
/// number of threads. Throws InputError when the outline of the body is not known, when a centre
/// lies outside, when larger spheres around an element leave no cell for it, or when the domain's
/// volume is not that of its shape; RunError when the cells do not fill the body.
Tessellation tessellate(const Specimen& specimen);

/// A convex solid of an element's cell: all of it, or a part of it that lies outside of the body
/// and counts with a minus. What several of these have in common stands once more, with a plus.
struct CellSolid {
  std::int32_t element;
  Polyhedron solid;
  bool is_taken_away = false;
};

/// The solids of the cells whose bounding boxes meet that between two corners, in the order of
/// elements. For a specimen that has cells.
std::vector<CellSolid> cell_solids(const Specimen& specimen, const Vector& lower,
                                   const Vector& upper);

/// The same as slabs of a thickness about the faces on a wall.
std::vector<CellSolid> wall_slabs(const Specimen& specimen, const std::string& wall,
                                  double thickness);

/// Whether a specimen has cells as far as can be told without making them: its outline is known and
/// holds all centres.
bool has_cells(const Specimen& specimen);

/// For laws without cells: the elements that touch each wall, within 5 % of their radius, share its
/// exact area in proportion to R². A wall that nothing touches has an empty list.
std::map<std::string, std::vector<WallFace>> touching_elements(const Specimen& specimen);

}  // namespace solidem

#endif
