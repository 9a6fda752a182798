// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonds that came with a file join neighbours: to `long_bond` times the sum of their radii without
// a word, to `longest_bond` times with a note, beyond it not at all, since another element fits
// between the two.
#ifndef SOLIDEM_SPECIMEN_LONG_BONDS_HPP
#define SOLIDEM_SPECIMEN_LONG_BONDS_HPP

#include <optional>
#include <string>

#include "model/specimen.hpp"

namespace solidem {

inline constexpr double long_bond = 1.5, longest_bond = 3;

/// The length of a bond at rest over the sum of its radii.
double relative_length(const Specimen& specimen, Pair pair);

/// A sentence on long bonds, if there are any and the specimen does not tell the tolerance that
/// made them: one may be a mistake, such as a side that should be periodic.
std::optional<std::string> note_on_long_bonds(const Specimen& specimen);

}  // namespace solidem

#endif
