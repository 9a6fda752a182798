// SPDX-License-Identifier: GPL-2.0-or-later
//
// A symmetric matrix of 6 × 6 blocks times a vector: the hot loop of conjugate gradients.
#ifndef SOLIDEM_EFFECTS_KERNELS_BLOCK_ROWS_HPP
#define SOLIDEM_EFFECTS_KERNELS_BLOCK_ROWS_HPP

#include <cstddef>
#include <cstdint>

namespace solidem {

/// Rows of entries; of two entries across the diagonal one has a block, and the other is its
/// transpose.
struct BlockRows {
  const std::int32_t* start;   ///< of the entries of each row; one more at the end
  const std::int32_t* column;  ///< of each entry
  const std::int32_t* place;   ///< of its block, or the complement of that of which it is transpose
  const double* block;         ///< 36 numbers each, column after column
};

/// y = K x for the rows [first, last); six numbers of x and y for each.
using MultiplyRows = void (*)(const BlockRows&, std::size_t first, std::size_t last,
                              const double* x, double* y);

/// That of the instruction set that kernels() chose.
MultiplyRows multiply_rows();

}  // namespace solidem

#endif
