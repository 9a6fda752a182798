// SPDX-License-Identifier: GPL-2.0-or-later
//
// Cells cut by the faces of cuts and meshes that reach them.
//
// With a convex cut K a part P of a cell is P less P ∩ K. What a mesh M bounds need not be convex:
// seen from a point q of the cell, the facets that reach the cell throw shadows in it, F_k, which
// are convex, and a point is in M as q is, but for each shadow that it lies in once more in or out:
// P ∩ M = P(q in M) − Σ ± P ∩ F_k, the sign that of the side of facet k that q sees.
#ifndef SOLIDEM_SPECIMEN_SCALED_OUTLINE_HPP
#define SOLIDEM_SPECIMEN_SCALED_OUTLINE_HPP

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "model/outline.hpp"
#include "specimen/cell_parts.hpp"
#include "specimen/curved_facets.hpp"
#include "specimen/walls.hpp"

namespace solidem {

/// The outline of a specimen in mean radii, its domain's lower corner at the origin.
class ScaledOutline {
 public:
  /// `first_wall`: the number of the first of its walls among those of the body.
  ScaledOutline(const Specimen& specimen, double unit, std::size_t first_wall);

  /// The names of its walls: `surface` of a mesh, and `cut_1`, `cut_2`, … of cuts. Those of what
  /// the outline of a specimen holds.
  static std::vector<std::string> wall_names(const Outline& outline);

  /// Cuts the parts of a cell, the first of which is the whole convex cell. `centre`: the
  /// element's; parts are told from there. Appends the planes of the outline that may reach it.
  /// False when nothing reaches it, and all stays as it is.
  bool cut(const Vector& centre, std::vector<CellPart>& parts,
           std::vector<OutlinePlane>& planes) const;

 private:
  struct Side {
    FacePlane plane;
    bool is_round;
  };
  struct ConvexCut {
    Cut cut;  ///< in mean radii
    std::vector<Side> sides;
    Wall round;         ///< of its round surface
    double shrink = 1;  ///< OutlinePlane::shrink of the round surface
    std::size_t wall = 0;
    std::vector<Vector> images;  ///< by which it is repeated; the first is none
  };
  struct MeshPart {
    std::shared_ptr<const FacetTree> tree;
    bool is_body;
    std::size_t wall = 0;
    std::vector<Vector> images;
  };
  struct Cell;

  void add_convex(const Cut& cut, const Specimen& specimen, double unit, std::size_t wall);
  void add_mesh(const FacetTree& tree, bool is_body, const Specimen& specimen, double unit,
                std::size_t wall);
  static bool take_out(const ConvexCut& cut, const Vector& centre, const Cell& cell,
                       std::vector<CellPart>& parts, std::vector<OutlinePlane>& planes);
  static bool cut_at(const MeshPart& mesh, const Vector& centre, const Cell& cell,
                     std::vector<CellPart>& parts, std::vector<OutlinePlane>& planes);

  std::vector<ConvexCut> convex_;
  std::vector<MeshPart> meshes_;
};

}  // namespace solidem

#endif
