// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "specimen/long_bonds.hpp"
#include "specimen/report.hpp"

namespace solidem {

namespace {

constexpr std::size_t most_shown = 4;

struct Piece {
  std::int32_t lowest;
  std::int32_t elements;
};

// Of several elements, the largest first.
std::vector<Piece> pieces_of(const std::vector<std::int32_t>& lowest) {
  std::vector<std::int32_t> members(lowest.size(), 0);
  for (const std::int32_t element : lowest) ++members[static_cast<std::size_t>(element)];
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (members[i] > 1) pieces.push_back({static_cast<std::int32_t>(i), members[i]});
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.elements > b.elements; });
  return pieces;
}

std::string in_words(const Specimen& specimen, const std::vector<Piece>& pieces) {
  std::string text;
  for (std::size_t k = 0; k < std::min(pieces.size(), most_shown); ++k) {
    const Vector& p = specimen.position[static_cast<std::size_t>(pieces[k].lowest)];
    text += fmt::format("{}{} elements with element {} at ({:.4g}, {:.4g}, {:.4g}) m",
                        k == 0 ? "" : ", ", pieces[k].elements, pieces[k].lowest, p.x, p.y, p.z);
  }
  if (pieces.size() > most_shown) text += fmt::format(", and {} more", pieces.size() - most_shown);
  return text;
}

}  // namespace

std::vector<std::int32_t> lowest_of_piece(std::size_t elements, const std::vector<Pair>& pairs) {
  // Union-find; the root of a piece is its lowest element.
  std::vector<std::int32_t> parent(elements);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Pair& pair : pairs) {
    const std::int32_t a = root(pair.i), b = root(pair.j);
    parent[std::max(a, b)] = std::min(a, b);
  }
  for (std::size_t i = 0; i < elements; ++i) parent[i] = root(static_cast<std::int32_t>(i));
  return parent;
}

std::vector<std::string> notes_on(const Specimen& specimen, const std::vector<Pair>& pairs,
                                  bool they_touch) {
  std::vector<std::string> notes;
  if (specimen.report.count(estimated_volume) != 0)
    notes.push_back(
        fmt::format("the specimen's file does not tell its body: its volume, {:.4g} m3, is taken "
                    "from its cells, cut at the spheres, and it has no walls; [specimen] shape or "
                    "volume tells them",
                    specimen.domain.volume));
  if (const auto note = note_on_long_bonds(specimen)) notes.push_back(*note);
  if (they_touch) return notes;
  const std::vector<std::int32_t> lowest = lowest_of_piece(specimen.size(), pairs);
  const std::vector<Piece> pieces = pieces_of(lowest);
  std::size_t joined = 0;
  for (const Piece& piece : pieces) joined += static_cast<std::size_t>(piece.elements);
  if (joined < specimen.size())
    notes.push_back(
        fmt::format("{} elements have no bond: nothing moves or heats them, no measure counts them",
                    specimen.size() - joined));
  if (specimen.bodies.empty()) {
    if (pieces.size() > 1)
      notes.push_back(fmt::format("the specimen is in {} pieces that do not see each other: {}",
                                  pieces.size(), in_words(specimen, pieces)));
    return notes;
  }
  const std::vector<std::int32_t> body = body_of_elements(specimen);
  for (std::size_t b = 0; b < specimen.bodies.size(); ++b) {
    std::vector<Piece> own;
    std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(own), [&](const Piece& piece) {
      return static_cast<std::size_t>(body[static_cast<std::size_t>(piece.lowest)]) == b;
    });
    if (own.size() > 1)
      notes.push_back(fmt::format("the body \"{}\" is in {} pieces that do not see each other: {}",
                                  specimen.bodies[b].name, own.size(), in_words(specimen, own)));
  }
  return notes;
}

}  // namespace solidem
