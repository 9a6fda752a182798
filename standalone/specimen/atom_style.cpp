// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/atom_style.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "model/error.hpp"

namespace solidem {

namespace {

using Names = std::vector<std::string>;

// Columns of a style by itself, and what it adds to those of a hybrid (id type x y z).
struct AtomStyle {
  Names alone, in_hybrid;
};

const std::map<std::string, AtomStyle>& styles() {
  static const Names sphere{"diameter", "density"};
  static const std::map<std::string, AtomStyle> known = {
      {"sphere", {{"id", "type", "diameter", "density", "x", "y", "z"}, sphere}},
      {"granular", {{"id", "type", "diameter", "density", "x", "y", "z"}, sphere}},
      {"bpm/sphere",
       {{"id", "molecule", "type", "diameter", "density", "x", "y", "z"},
        {"molecule", "diameter", "density"}}},
      {"molecular-granular",
       {{"id", "type", "x", "y", "z", "diameter", "density", "molecule"},
        {"diameter", "density", "molecule"}}},
      {"atomic", {{"id", "type", "x", "y", "z"}, {}}},
      {"bond", {{"id", "molecule", "type", "x", "y", "z"}, {"molecule"}}},
      {"angle", {{"id", "molecule", "type", "x", "y", "z"}, {"molecule"}}},
      {"molecular", {{"id", "molecule", "type", "x", "y", "z"}, {"molecule"}}},
      {"full", {{"id", "molecule", "type", "charge", "x", "y", "z"}, {"molecule", "charge"}}},
      {"charge", {{"id", "type", "charge", "x", "y", "z"}, {"charge"}}}};
  return known;
}

std::string known_styles() {
  return "sphere, granular, bpm/sphere, or a hybrid with one of them such as \"hybrid bond "
         "sphere\"";
}

// Of a hybrid, a column that several of its styles have stands once, or (as older versions want
// it) for each of them.
Names hybrid_columns(const std::vector<std::string>& style, bool once) {
  Names names{"id", "type", "x", "y", "z"};
  for (std::size_t k = 1; k < style.size(); ++k)
    for (const std::string& name : styles().at(style[k]).in_hybrid)
      if (!once || std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  return names;
}

std::vector<Names> readings(const std::vector<std::string>& style) {
  if (style.empty())
    return {styles().at("granular").alone, styles().at("molecular-granular").alone};
  if (style[0] != "hybrid") return {styles().at(style[0]).alone};
  if (style.size() == 1)
    throw InputError(
        "the atom style is a hybrid of styles that are not named: expected them after Atoms, such "
        "as \"Atoms # hybrid bond sphere\"");
  std::vector<Names> found{hybrid_columns(style, true), hybrid_columns(style, false)};
  if (found[0] == found[1]) found.pop_back();
  return found;
}

std::size_t place_of(const Names& names, const char* name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

std::string AtomColumns::text() const {
  return fmt::format("{}", fmt::join(names, " "));
}

std::vector<std::string> style_in(const std::vector<std::string_view>& words) {
  std::vector<std::string> style;
  for (std::string word : std::vector<std::string>(words.begin(), words.end())) {
    while (!word.empty() && std::string_view(":;.)").find(word.back()) != std::string_view::npos)
      word.pop_back();
    const bool begins_hybrid = style.empty() && word == "hybrid";
    if (!begins_hybrid && styles().count(word) == 0) break;
    style.push_back(word);
    if (style[0] != "hybrid") break;
  }
  return style;
}

AtomColumns atom_columns(const std::vector<std::string>& style, std::size_t words) {
  std::string counts;
  for (Names& names : readings(style)) {
    const std::size_t count = names.size();
    const std::size_t x = place_of(names, "x"), diameter = place_of(names, "diameter");
    if (diameter == count)
      throw InputError(fmt::format("atoms of the style {} have no diameter: expected {}",
                                   fmt::join(style, " "), known_styles()));
    if (words == count) return {std::move(names), x, diameter, 0};
    if (words == count + 3) return {std::move(names), x, diameter, count};
    counts += fmt::format("{}{} ({})", counts.empty() ? "" : ", or ", count, fmt::join(names, " "));
  }
  if (!style.empty())
    throw InputError(
        fmt::format("{} values, expected {}, and three image flags or none: the atom "
                    "style is {}",
                    words, counts, fmt::join(style, " ")));
  throw InputError(
      fmt::format("{} values, expected {}, and three image flags or none; lines of "
                  "another kind need their atom style after Atoms: {}",
                  words, counts, known_styles()));
}

}  // namespace solidem
