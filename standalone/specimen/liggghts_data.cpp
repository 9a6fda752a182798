// SPDX-License-Identifier: GPL-2.0-or-later
//
// Data files of LIGGGHTS and LAMMPS.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "model/error.hpp"
#include "specimen/atom_style.hpp"
#include "specimen/body_lines.hpp"
#include "specimen/long_bonds.hpp"
#include "specimen/text_formats.hpp"
#include "specimen/text_lines.hpp"

namespace solidem {

namespace {

using Words = std::vector<std::string_view>;

// The words of a text that follow a word.
Words words_after(const Words& words, std::string_view word) {
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? Words{} : Words(found + 1, words.end());
}

// The first line is a title, whatever it holds.
std::string with_title_as_comment(const std::string& text, const std::string& path) {
  if (text.find('\n') == std::string::npos)
    throw InputError(path + ": no data file of LIGGGHTS or LAMMPS");
  return "# " + text;
}

class DataFile {
 public:
  DataFile(const std::string& text, const std::string& path)
      : path_(path), text_(with_title_as_comment(text, path)), lines_(text_, path) {
    read_comments();
    bool has_line = lines_.next();
    while (has_line && !lines_.begins_with_letter()) {
      read_header_line();
      has_line = lines_.next();
    }
    while (has_line) has_line = read_section();
    if (!has_atoms_) throw InputError(path + ": no section Atoms in it");
    if (bonds_ > 0 && !has_bonds_)
      throw InputError(
          fmt::format("{}: the header says {} bonds, but there is no section Bonds", path, bonds_));
  }

  Specimen specimen() {
    Specimen specimen;
    std::vector<std::size_t> order(id_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return id_[a] < id_[b]; });
    for (std::size_t k = 0; k < order.size(); ++k) {
      specimen.position.push_back(position_[order[k]]);
      specimen.radius.push_back(radius_[order[k]]);
      element_[id_[order[k]]] = static_cast<std::int32_t>(k);
    }
    put_in_box(specimen);
    set_periods(specimen.domain);
    read_body_lines(text_, path_, specimen.domain);
    for (const auto& [a, b] : bonded_) {
      const std::int32_t i = element_of(a), j = element_of(b);
      specimen.bonds.push_back({std::min(i, j), std::max(i, j)});
      check_length(specimen, specimen.bonds.back(), a, b);
    }
    std::sort(specimen.bonds.begin(), specimen.bonds.end());
    specimen.contact_margin = contact_margin(precision_, specimen);
    return specimen;
  }

 private:
  // The title and other comments may say what a data file has no place for.
  void read_comments() {
    TextLines comments(text_, path_);
    for (bool is_title = true; comments.next_comment(); is_title = false) {
      const Words& words = comments.words();
      read_boundary(words);
      if (!is_title) continue;
      style_ = style_in(words_after(words, "atom_style"));
      const Words units = words_after(words, "units");
      if (units.size() > 1 && units[0] == "=" && units[1] != "si" && units[1] != "lj")
        comments.fail(
            fmt::format("the units are {}: expected si (or lj, taken as it is): turn "
                        "lengths into m and write units = si",
                        units[1]));
    }
  }

  // "boundary p p f", as the command of the input script has it.
  void read_boundary(const Words& words) {
    const Words sides = words_after(words, "boundary");
    if (sides.size() < 3) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (sides[axis].size() > 2 || sides[axis].find_first_not_of("pfsm") != std::string_view::npos)
        return;
    for (std::size_t axis = 0; axis < 3; ++axis) is_periodic_[axis] = sides[axis][0] == 'p';
  }

  std::int64_t count(std::int64_t least) {
    const std::int64_t value = lines_.integer(0);
    if (value < least || value > std::numeric_limits<std::int32_t>::max())
      lines_.fail(fmt::format("{} {}: expected {} to 2147483647", value, lines_.words()[1], least));
    return value;
  }

  void read_header_line() {
    const Words& words = lines_.words();
    if (words.size() == 2 && words[1] == "atoms") atoms_ = count(1);
    if (words.size() == 2 && words[1] == "bonds") bonds_ = count(0);
    if (words.size() == 6 && words[3] == "xy")
      for (std::size_t k = 0; k < 3; ++k)
        if (lines_.number(k) != 0)
          lines_.fail("a box whose sides are not at right angles: expected xy, xz and yz to be 0");
    for (std::size_t axis = 0; axis < 3 && words.size() == 4; ++axis)
      if (words[2] == fmt::format("{}lo", "xyz"[axis]))
        box_[axis] = {lines_.number(0), lines_.number(1)};
  }

  // Reads a section, from the line with its name; the next line that is there begins another.
  bool read_section() {
    const std::string name(lines_.words()[0]);
    for (const char* unknown :
         {"Angles", "Dihedrals", "Impropers", "Ellipsoids", "Lines", "Triangles", "Bodies"})
      if (name == unknown)
        lines_.fail(fmt::format("a section {}: expected spheres and bonds alone", name));
    if (name == "Atoms") return read_atoms();
    if (name == "Bonds") return read_bonds();
    bool has_line = true;  // velocities, coefficients: no concern of a specimen
    while ((has_line = lines_.next()) && !lines_.begins_with_letter()) continue;
    return has_line;
  }

  bool read_atoms() {
    if (has_atoms_) lines_.fail("a second section Atoms");
    if (atoms_ < 0) lines_.fail("section Atoms before the line \"N atoms\"");
    has_atoms_ = true;
    const Words comment = lines_.comment();
    if (!comment.empty()) choose_style(comment);
    bool may_be_other = style_.empty();  // eight words might be those of bpm/sphere as well
    return read_rows("atoms", atoms_, [&] {
      read_atom();
      const Words& words = lines_.words();
      may_be_other = may_be_other && columns_.names.back() == "molecule" &&
                     words[2].find_first_not_of("0123456789") == std::string_view::npos &&
                     lines_.integer(2) >= 1;
      if (may_be_other && static_cast<std::int64_t>(id_.size()) == atoms_)
        lines_.fail(
            "the atoms may be of the style bpm/sphere or hybrid granular molecular: "
            "expected it after Atoms, such as \"Atoms # bpm/sphere\"");
    });
  }

  // The title may say more than a bare "hybrid".
  void choose_style(const Words& comment) {
    std::vector<std::string> named = style_in(comment);
    if (named.empty())
      lines_.fail(
          fmt::format("\"{}\" is no atom style that is known; expected sphere, granular, "
                      "bpm/sphere, or a hybrid such as \"hybrid bond sphere\"",
                      fmt::join(comment, " ")));
    const bool title_says_more = named.size() == 1 && style_.size() > 1 && named[0] == style_[0];
    if (!title_says_more) style_ = std::move(named);
  }

  // As many lines as the header says: no fewer, no more.
  template <class Read>
  bool read_rows(const char* what, std::int64_t rows, Read read) {
    for (std::int64_t k = 0; k < rows; ++k) {
      if (!lines_.next())
        throw InputError(fmt::format("{}: the file ends after {} of {} {}", path_, k, rows, what));
      if (lines_.begins_with_letter())
        lines_.fail(fmt::format("another section after {} of {} {}", k, rows, what));
      read();
    }
    const bool has_line = lines_.next();
    if (has_line && !lines_.begins_with_letter())
      lines_.fail(fmt::format("a line more than the {} {} of the header", rows, what));
    return has_line;
  }

  void read_atom() {
    const Words& words = lines_.words();
    if (id_.empty()) find_columns();
    const std::size_t expected = columns_.names.size() + (columns_.first_image_flag > 0 ? 3U : 0U);
    if (words.size() != expected)
      lines_.fail(fmt::format("{} values, expected {} as in the first line of Atoms ({})",
                              words.size(), expected, columns_.text()));
    for (std::size_t k = 0; k < columns_.names.size(); ++k)
      if (columns_.names[k] == "type" || columns_.names[k] == "molecule") check_whole(k);
    const std::size_t x = columns_.x;
    id_.push_back(lines_.integer(0));
    if (!known_.insert(id_.back()).second)
      lines_.fail(fmt::format("atom id {} is there twice", id_.back()));
    position_.push_back({lines_.number(x), lines_.number(x + 1), lines_.number(x + 2)});
    radius_.push_back(lines_.radius(columns_.diameter, 0.5));
    for (const std::size_t k : {x, x + 1, x + 2, columns_.diameter})
      precision_.note(words[k], lines_.number(k));
    // Only across a periodic side is an atom ever counted into another image of the box.
    for (std::size_t axis = 0; axis < 3 && columns_.first_image_flag > 0; ++axis)
      if (lines_.integer(columns_.first_image_flag + axis) != 0) is_periodic_[axis] = true;
  }

  void find_columns() {
    try {
      columns_ = atom_columns(style_, lines_.words().size());
    } catch (const InputError& error) {
      lines_.fail(error.what());
    }
  }

  void check_whole(std::size_t word) const {
    const std::string_view text = lines_.words()[word];
    if (text.find_first_not_of("-0123456789") == std::string_view::npos) return;
    lines_.fail(
        fmt::format("the {} is \"{}\", expected a whole number: are the columns {}? The "
                    "atom style after Atoms decides them, such as \"Atoms # bpm/sphere\"",
                    columns_.names[word], text, columns_.text()));
  }

  bool read_bonds() {
    if (has_bonds_) lines_.fail("a second section Bonds");
    has_bonds_ = true;
    return read_rows("bonds", bonds_, [&] {
      if (lines_.words().size() != 4)
        lines_.fail(
            fmt::format("{} values, expected 4 (id type atom atom)", lines_.words().size()));
      const std::int64_t a = lines_.integer(2), b = lines_.integer(3);
      if (a == b || (has_atoms_ && (known_.count(a) == 0 || known_.count(b) == 0)))
        lines_.fail(fmt::format("bond of atoms {} and {}: expected two atoms of the {} in Atoms", a,
                                b, atoms_));
      bonded_.push_back({a, b});
    });
  }

  std::int32_t element_of(std::int64_t id) const {
    const auto found = element_.find(id);
    if (found != element_.end()) return found->second;
    throw InputError(
        fmt::format("{}: a bond of atom {}, which is not in the section Atoms", path_, id));
  }

  void set_periods(Domain& domain) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (!is_periodic_[k]) continue;
      if (!box_[k])
        throw InputError(
            fmt::format("{}: periodic along {}, but the header does not say from where "
                        "to where: expected a line \"LOW HIGH {}lo {}hi\"",
                        path_, "xyz"[axis], "xyz"[axis], "xyz"[axis]));
      domain.periodic[k] = true;
      component(domain.lower, axis) = (*box_[k])[0];
      component(domain.upper, axis) = (*box_[k])[1];
    }
  }

  void check_length(const Specimen& specimen, Pair pair, std::int64_t a, std::int64_t b) const {
    const double ratio = relative_length(specimen, pair);
    if (ratio <= longest_bond) return;
    throw InputError(fmt::format(
        "{}: the bond of atoms {} and {} is {:.4g} m long, {:.3g} times the sum of their radii: "
        "expected neighbours. Where the box is periodic a line \"# boundary p p p\" in the header "
        "(or the title) says so",
        path_, a, b, norm(rest_chord(specimen, pair)), ratio));
  }

  const std::string& path_;
  std::string text_;
  TextLines lines_;
  std::int64_t atoms_ = -1, bonds_ = 0;
  bool has_atoms_ = false, has_bonds_ = false;
  std::array<bool, 3> is_periodic_{};
  std::array<std::optional<std::array<double, 2>>, 3> box_;
  std::vector<std::string> style_;
  AtomColumns columns_;
  DecimalPrecision precision_;

  // Of the atoms, in the order of the file.
  std::vector<std::int64_t> id_;
  std::vector<Vector> position_;
  std::vector<double> radius_;
  std::unordered_set<std::int64_t> known_;
  std::unordered_map<std::int64_t, std::int32_t> element_;
  std::vector<std::array<std::int64_t, 2>> bonded_;
};

}  // namespace

Specimen specimen_of_liggghts_text(const std::string& text, const std::string& path) {
  return DataFile(text, path).specimen();
}

}  // namespace solidem
