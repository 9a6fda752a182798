// SPDX-License-Identifier: GPL-2.0-or-later
//
// A cell as a sum of convex solids with signs: the cell itself, less what cuts take of it and what
// lies beyond a mesh. Lengths are in mean radii, places from the element's centre.
#ifndef SOLIDEM_SPECIMEN_CELL_PARTS_HPP
#define SOLIDEM_SPECIMEN_CELL_PARTS_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/polyhedron.hpp"

namespace solidem {

/// What a face of a part of a cell is.
struct CellFace {
  enum class Of : std::int8_t { neighbour, wall, outline, nothing };
  Of of = Of::nothing;
  std::int32_t number = 0;  ///< of the neighbour, of the wall, or of the plane in the outline
  double weight = 0;        ///< by which its area counts
};

/// A convex solid that counts with a sign, and what each of its faces is.
struct CellPart {
  Polyhedron solid;
  std::vector<CellFace> faces;
  double sign = 1;
};

/// A plane in which a cell may show at a cut or a mesh.
struct OutlinePlane {
  std::size_t wall;     ///< that it is a part of
  double path;          ///< from the element's centre to it
  double shrink = 1.0;  ///< area of a round surface over that of its facets
};

/// Keeps of a part what lies where normal · x ≤ offset; the cut is a face of its own. False when
/// nothing is left.
bool clip(CellPart& part, const Vector& normal, double offset, const CellFace& cut);

/// A part that counts `factor` times as much as another, its faces likewise.
CellPart multiple_of(const CellPart& part, double factor);

/// A plane with the solid that it bounds where normal · x ≤ offset.
struct FacePlane {
  Vector normal;
  double offset;
};

/// The planes of a convex solid's faces.
std::vector<FacePlane> planes_of(const Polyhedron& solid);

/// Normal of a face, as long as its area.
Vector area_vector(const std::vector<Vector>& face);

}  // namespace solidem

#endif
