// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_SURFACE_ELEMENTS_HPP
#define SOLIDEM_EFFECTS_SURFACE_ELEMENTS_HPP

#include <cstdint>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// The elements that a sphere as small as the smallest element can touch without overlapping
/// another of the piece that bonds hold together, as the specimen stands, ascending: those at free
/// surfaces, however near another piece may be, in wide pores, and those that stand alone. Wide
/// gaps are found by trying directions, narrow ones by their corners.
std::vector<std::int32_t> surface_elements(const Specimen& specimen,
                                           const std::vector<Pair>& bonds);

}  // namespace solidem

#endif
