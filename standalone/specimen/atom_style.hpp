// SPDX-License-Identifier: GPL-2.0-or-later
//
// The lines of the section Atoms in a data file of LAMMPS or LIGGGHTS: the atom style decides their
// columns.
#ifndef SOLIDEM_SPECIMEN_ATOM_STYLE_HPP
#define SOLIDEM_SPECIMEN_ATOM_STYLE_HPP

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace solidem {

/// Names of columns ("id", "x", "diameter", ...) and where those stand that a specimen needs.
struct AtomColumns {
  std::vector<std::string> names;
  std::size_t x = 0, diameter = 0;
  std::size_t first_image_flag = 0;  ///< 0: the lines have none

  std::string text() const;
};

/// The style that stands in some words, such as a comment: "hybrid bond sphere", each word of which
/// is known; what follows is something else. Empty when the first word is no style.
std::vector<std::string> style_in(const std::vector<std::string_view>& words);

/// The columns of a line of so many words under a style; an empty one is found by the number of
/// words: seven are granular, eight `hybrid granular molecular`; three image flags may follow.
/// Throws InputError (without a place) with what would be right: a style without diameters, other
/// numbers of words, a hybrid that does not say of what.
AtomColumns atom_columns(const std::vector<std::string>& style, std::size_t words);

}  // namespace solidem

#endif
