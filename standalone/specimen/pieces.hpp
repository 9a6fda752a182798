// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_PIECES_HPP
#define SOLIDEM_SPECIMEN_PIECES_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// For each element the lowest one of the piece that pairs hold together with it.
std::vector<std::int32_t> lowest_of_piece(std::size_t elements, const std::vector<Pair>& pairs);

/// What whoever uses a specimen ought to know, a sentence each: that its volume is an estimate,
/// that bonds of a file are long, that elements have no bond, that there are several pieces.
/// `pairs`: what joins elements. `they_touch`: what nothing joins touches, so that neither is worth
/// a word.
std::vector<std::string> notes_on(const Specimen& specimen, const std::vector<Pair>& pairs,
                                  bool they_touch = false);

}  // namespace solidem

#endif
