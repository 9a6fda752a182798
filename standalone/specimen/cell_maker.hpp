// SPDX-License-Identifier: GPL-2.0-or-later
//
// Makes the cell of one element after the other, by voro++. Lengths are in mean radii: voro++ takes
// points within 1e-11 of a plane to lie on it.
#ifndef SOLIDEM_SPECIMEN_CELL_MAKER_HPP
#define SOLIDEM_SPECIMEN_CELL_MAKER_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voro++/voro++.hh>

#include "model/specimen.hpp"
#include "specimen/cell_parts.hpp"
#include "specimen/curved_facets.hpp"
#include "specimen/scaled_outline.hpp"
#include "specimen/tessellation.hpp"
#include "specimen/walls.hpp"

namespace solidem {

inline constexpr double smallest_face = 1e-10;  ///< in squared mean radii; below is round-off

/// The specimen in mean radii, its lower corner at the origin.
struct ScaledBody {
  double unit;
  Domain domain;
  std::vector<Vector> position;
  std::vector<double> radius;
  std::vector<Wall> walls;  ///< of the whole shape; then those of its outline, by their names alone
  std::size_t walls_of_shape = 0;
  Facets outer, inner;  ///< of curved walls
  std::optional<ScaledOutline> outline;

  explicit ScaledBody(const Specimen& specimen);

  /// The number of a wall; their count when there is none of that name.
  std::size_t wall_called(const std::string& name) const;
  /// Area of a round wall of the shape over that of its facets.
  double shrink_of(std::size_t wall) const;
};

/// What a cell shows of a neighbour.
struct CellSide {
  std::int32_t other;
  double area, area_over_distance;
};

/// What it shows on a wall.
struct CellWall {
  std::size_t wall;
  WallFace face;
};

/// Some elements' cells, one after the other.
struct CellChunk {
  std::vector<std::size_t> first{0};  ///< of an element's sides; one more at the end
  std::vector<CellSide> sides;        ///< of each element by rising neighbour
  std::vector<CellWall> walls;
};

/// Each thread has its own, for voro++ keeps notes while it works.
class CellMaker {
 public:
  explicit CellMaker(const ScaledBody& body);

  /// Adds the element to the chunk; returns the volume of its cell, 0 when it has none.
  double make(std::int32_t element, CellChunk& chunk);

  /// Parts of the cell made last, and the number of the wall that a face of one lies on; the number
  /// of walls where it is on none.
  const std::vector<CellPart>& parts();
  std::size_t wall_of(const CellFace& face) const;

 private:
  using Cell = voro::voronoicell_neighbor;

  void add_walls();
  static int id_of(std::size_t wall);
  std::size_t wall_of_id(int id) const;
  bool keep_inside(Cell& cell, const Facets& facets, std::size_t wall);
  bool reaches_hole();
  void make_parts();
  CellPart part_of(Cell& cell, double sign);
  Vector chord_through(std::int32_t other, const Vector& normal) const;
  void add_faces(Cell& cell, double sign);
  void add_side(std::int32_t other, double area, const Vector& normal);
  double add_parts();
  void store(CellChunk& chunk);

  const ScaledBody& body_;
  bool has_images_;
  std::unique_ptr<voro::container_poly> container_;
  std::vector<std::unique_ptr<voro::wall>> voro_walls_;
  std::vector<std::pair<int, int>> place_;  // of each element in the container
  std::array<std::size_t, 6> box_wall_{};
  std::size_t outer_ = 0, inner_ = 0;

  Cell cell_, in_hole_;
  std::int32_t element_ = 0;
  bool is_holed_ = false, has_parts_ = false;
  std::vector<CellPart> parts_;
  std::vector<OutlinePlane> planes_;
  std::vector<int> others_;
  std::vector<double> areas_, numbers_, wall_area_, wall_conducts_;
  std::vector<CellSide> sides_;
};

}  // namespace solidem

#endif
