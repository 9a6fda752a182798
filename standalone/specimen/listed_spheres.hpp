// SPDX-License-Identifier: GPL-2.0-or-later
//
// Lists of neighbours (Verlet's) of spheres in blocks of eight, for the hot loops of
// specimen/soft_sphere_kernels.hpp.
#ifndef SOLIDEM_SPECIMEN_LISTED_SPHERES_HPP
#define SOLIDEM_SPECIMEN_LISTED_SPHERES_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "neighbours/linked_cells.hpp"

namespace solidem {

/// Spheres of which neighbours are sought: those with |x_j − x_i| < R_i + R_j + skin, the nearest
/// images.
struct SpheresToList {
  CellBox box;
  const double* ball;  ///< of each sphere a row: x y z R; inside the box where it is periodic
  std::size_t size;
  double largest_radius, skin;
};

/// Replaces the lists by those of the spheres: rows of eight, the k-th neighbour of each sphere of
/// a block, filled up with the number that follows the last sphere's. The rows of a block stand
/// from first_row[block] to first_row[block + 1]. There are size / 8 + 1 blocks. The neighbours of
/// a sphere stand in the order of LinkedCells::for_each_pair, which sums of forces follow.
void list_spheres(const SpheresToList& spheres, std::vector<std::uint32_t>& first_row,
                  std::vector<std::int32_t>& neighbour);

}  // namespace solidem

#endif
