// SPDX-License-Identifier: GPL-2.0-or-later
//
// Linked cells: a box cut into cells no smaller than the reach, so that neighbours of an element
// stand in its own cell or the 26 around it. Every pair of cells is looked at once: a cell asks the
// nine cells of the layer above it and four of its own layer (Terreros 2013, annex B, with the
// printed slips put right: the cell index divides by the cell size, and the upper layer has nine
// cells). Elements are kept by cell through a counting sort, so a cell's elements are contiguous in
// memory.
#ifndef SOLIDEM_NEIGHBOURS_LINKED_CELLS_HPP
#define SOLIDEM_NEIGHBOURS_LINKED_CELLS_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// The space cells divide. Elements may stand outside: without periodicity they count to the
/// nearest cell, with it to their image inside.
struct CellBox {
  Vector lower{}, upper{};
  std::array<bool, 3> periodic{false, false, false};
};

class LinkedCells {
 public:
  /// Cells for pairs up to `reach` apart (m) among about `elements` elements; cells are larger than
  /// the reach where elements are few, so memory stays in proportion to the elements.
  LinkedCells(const CellBox& box, double reach, std::size_t elements);

  /// Puts the elements into cells. Element order inside a cell is ascending.
  void sort(const std::vector<Vector>& position);

  std::size_t cell_count() const { return counts_[0] * counts_[1] * counts_[2]; }

  /// Calls visit(i, j, chord) once for each pair with at least its lower-numbered cell in
  /// [first_cell, last_cell): all pairs within reach and some farther ones. i and j come in no
  /// particular order; chord goes from i to j, the nearest image in periodic directions. Different
  /// cell ranges may be visited by different threads.
  template <class Visit>
  void for_each_pair(std::size_t first_cell, std::size_t last_cell, Visit&& visit) const;

  /// An element as it stands in the box, or an image of it.
  struct Resident {
    Vector position;
    std::int32_t element;
  };

  /// Elements of a cell, in ascending order.
  std::size_t first_of(std::size_t cell) const { return first_[cell]; }
  const Resident& resident(std::size_t k) const { return residents_[k]; }

  /// Residents that follow each other, moved by so many periods along x, y, z.
  struct Range {
    std::size_t first, last;
    std::array<int, 3> periods;
  };
  /// Replaces the ranges by those of all elements, and images of elements, that may stand within
  /// reach of one in this cell: those of the cell itself and of the cells around it.
  void find_ranges_around(std::size_t cell, std::vector<Range>& ranges) const;

  /// A cell, or an image of it that is moved by so many periods along x, y, z.
  struct CellImage {
    std::size_t cell;
    std::array<int, 3> periods;
  };
  /// The cell itself and those around it, each once, in the order in which for_each_pair comes to
  /// the pairs of its residents with theirs. Replaces what is there; returns how many.
  std::size_t find_cells_around(std::size_t cell, std::array<CellImage, 27>& cells) const;
  /// Whether a cell is its own neighbour across a period.
  bool is_own_neighbour() const;

  /// From one point of the box to the nearest image of another.
  Vector chord(const Vector& from, const Vector& to) const;

  /// Lengths of the box, m.
  const Vector& extent() const { return extent_; }

 private:
  // The cells that `cell` asks (way 1) or that ask it (−1), each once; how many there are.
  int one_way_neighbours(std::size_t cell, int way, std::array<CellImage, 13>& neighbours) const;

  CellBox box_;
  double reach_ = 0;
  Vector extent_{};
  std::array<std::size_t, 3> counts_{1, 1, 1};
  std::vector<std::size_t> first_;  // of the residents of each cell; one more at the end
  std::vector<Resident> residents_;
  std::vector<std::size_t> cell_of_;
};

/// The pairs with d_ij ≤ (1 + tolerance)(R_i + R_j)(1 + margin), d_ij the distance of the nearest
/// images; sorted, i < j, the same on any number of threads. In a periodic direction the box must
/// be longer than twice the longest such distance: the caller checks.
std::vector<Pair> neighbour_pairs(const CellBox& box, const std::vector<Vector>& position,
                                  const std::vector<double>& radius, double tolerance,
                                  double margin = 1e-12);

// ---------------------------------------------------------------------------------------------------

inline Vector LinkedCells::chord(const Vector& from, const Vector& to) const {
  Vector d = to - from;
  for (int axis = 0; axis < 3; ++axis) {
    if (!box_.periodic[axis]) continue;
    double& c = component(d, axis);
    const double extent = component(extent_, axis);
    if (c > 0.5 * extent)
      c -= extent;
    else if (c < -0.5 * extent)
      c += extent;
  }
  return d;
}

template <class Visit>
void LinkedCells::for_each_pair(std::size_t first_cell, std::size_t last_cell,
                                Visit&& visit) const {
  std::array<CellImage, 13> neighbours{};
  for (std::size_t cell = first_cell; cell < last_cell; ++cell) {
    if (first_[cell] == first_[cell + 1]) continue;
    const int neighbour_count = one_way_neighbours(cell, 1, neighbours);
    for (std::size_t a = first_[cell]; a < first_[cell + 1]; ++a) {
      const Resident& from = residents_[a];
      for (std::size_t b = a + 1; b < first_[cell + 1]; ++b)
        visit(from.element, residents_[b].element, chord(from.position, residents_[b].position));
      for (int k = 0; k < neighbour_count; ++k)
        for (std::size_t b = first_[neighbours[k].cell]; b < first_[neighbours[k].cell + 1]; ++b)
          visit(from.element, residents_[b].element, chord(from.position, residents_[b].position));
    }
  }
}

}  // namespace solidem

#endif
