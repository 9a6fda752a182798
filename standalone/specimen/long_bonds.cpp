// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/long_bonds.hpp"

#include <fmt/format.h>

namespace solidem {

double relative_length(const Specimen& specimen, Pair pair) {
  return norm(rest_chord(specimen, pair)) / (specimen.radius[static_cast<std::size_t>(pair.i)] +
                                             specimen.radius[static_cast<std::size_t>(pair.j)]);
}

std::optional<std::string> note_on_long_bonds(const Specimen& specimen) {
  if (specimen.bond_tolerance > -1) return std::nullopt;
  std::size_t count = 0;
  double longest = 0;
  Pair ends{};
  for (const Pair& pair : specimen.bonds) {
    const double ratio = relative_length(specimen, pair);
    if (ratio > long_bond) ++count;
    if (ratio <= longest) continue;
    longest = ratio;
    ends = pair;
  }
  if (count == 0) return std::nullopt;
  return fmt::format(
      "{} of {} bonds are more than {} times as long as the sum of their radii, the longest, of "
      "elements {} and {}, {:.3g} times: are these neighbours? [bonds] tolerance makes bonds anew",
      count, specimen.bonds.size(), long_bond, ends.i, ends.j, longest);
}

}  // namespace solidem
