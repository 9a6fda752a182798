// SPDX-License-Identifier: GPL-2.0-or-later
//
// The order elements are stored in. Along a Hilbert curve neighbours in space are neighbours in
// memory; inside windows of 128, small enough to keep that, elements with equally many bonds stand
// together, so that loops over eight elements at once have little to pad.
#ifndef SOLIDEM_SPECIMEN_ORDERING_HPP
#define SOLIDEM_SPECIMEN_ORDERING_HPP

#include <cstdint>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// Place of a point on the Hilbert curve through a cube of 2^21 cells a side; coordinates are
/// cells.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z);

/// Element numbers along the Hilbert curve through the points' bounding cube; of equal places the
/// lower number first.
std::vector<std::int32_t> hilbert_order(const std::vector<Vector>& position);

/// Sorts the specimen's elements along the Hilbert curve, then by falling number of its present
/// bonds in windows of 128. Bonds and sets follow.
void sort_elements(Specimen& specimen);

}  // namespace solidem

#endif
