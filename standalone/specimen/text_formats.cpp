// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/text_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include "model/error.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

namespace {

// Walks through a text line by line; every message carries file and line.
class Lines {
 public:
  Lines(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  // The next line that holds something, without comment (# to the end), as words; false at the end.
  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = rest_.find('\n');
      std::string_view line = rest_.substr(0, end);
      rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
      ++number_;
      split(line.substr(0, line.find('#')));
      if (!words_.empty()) return true;
    }
    return false;
  }

  const std::vector<std::string_view>& words() const { return words_; }

  void insist_on_words(std::size_t count, const char* meaning) const {
    if (words_.size() != count)
      fail(fmt::format("{} values, expected {} ({})", words_.size(), count, meaning));
  }

  double number(std::size_t word) const {
    double value = 0;
    const std::string_view text = words_[word];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(fmt::format("\"{}\" is no number", text));
    return value;
  }

  std::int64_t integer(std::size_t word) const {
    std::int64_t value = 0;
    const std::string_view text = words_[word];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(fmt::format("\"{}\" is no whole number", text));
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_, number_, what));
  }

  double radius(std::size_t word, double scale = 1.0) const {
    const double value = scale * number(word);
    if (!(value > 0) || value > std::numeric_limits<double>::max())
      fail(fmt::format("radius {} m: expected a number above zero", value));
    return value;
  }

 private:
  void split(std::string_view line) {
    static constexpr std::string_view separators = " \t\r,";
    words_.clear();
    for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
      words_.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(separators, end);
    }
  }

  std::string_view rest_;
  const std::string& path_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

// The box around all spheres.
void put_in_box(Specimen& specimen) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vector lower{far, far, far}, upper{-far, -far, -far};
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    const double r = specimen.radius[i];
    lower = {std::min(lower.x, p.x - r), std::min(lower.y, p.y - r), std::min(lower.z, p.z - r)};
    upper = {std::max(upper.x, p.x + r), std::max(upper.y, p.y + r), std::max(upper.z, p.z + r)};
  }
  const Vector extent = upper - lower;
  specimen.domain.shape = "imported";
  specimen.domain.lower = lower;
  specimen.domain.upper = upper;
  specimen.domain.volume = extent.x * extent.y * extent.z;
}

}  // namespace

std::string liggghts_text(const Specimen& specimen) {
  const Domain& domain = specimen.domain;
  const std::vector<std::int32_t> degree = count_bonds(specimen);
  std::string text = fmt::format(
      "LIGGGHTS data of a solidem specimen, atom_style hybrid granular molecular: id type x y z "
      "diameter density molecule\n\n{} atoms\n",
      specimen.size());
  if (!specimen.bonds.empty()) text += fmt::format("{} bonds\n", specimen.bonds.size());
  text += "1 atom types\n";
  if (!specimen.bonds.empty())
    text += fmt::format("1 bond types\n{} extra bond per atom\n",
                        *std::max_element(degree.begin(), degree.end()));
  text += fmt::format(
      "{:.17g} {:.17g} xlo xhi\n{:.17g} {:.17g} ylo yhi\n{:.17g} {:.17g} zlo zhi\n\nAtoms\n\n",
      domain.lower.x, domain.upper.x, domain.lower.y, domain.upper.y, domain.lower.z,
      domain.upper.z);
  const double density = domain.volume / sphere_volume(specimen);
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    fmt::format_to(out, "{} 1 {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} 1\n", i + 1, p.x, p.y, p.z,
                   2.0 * specimen.radius[i], density);
  }
  if (!specimen.bonds.empty()) text += "\nBonds\n\n";
  for (std::size_t b = 0; b < specimen.bonds.size(); ++b)
    fmt::format_to(out, "{} 1 {} {}\n", b + 1, specimen.bonds[b].i + 1, specimen.bonds[b].j + 1);
  return text;
}

std::string yade_text(const Specimen& specimen) {
  std::string text = "#format x_y_z_r\n";
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    fmt::format_to(std::back_inserter(text), "{:.17g}\t{:.17g}\t{:.17g}\t{:.17g}\n", p.x, p.y, p.z,
                   specimen.radius[i]);
  }
  return text;
}

std::string csv_text(const Specimen& specimen) {
  std::string text = "x,y,z,radius\n";
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    fmt::format_to(std::back_inserter(text), "{:.17g},{:.17g},{:.17g},{:.17g}\n", p.x, p.y, p.z,
                   specimen.radius[i]);
  }
  return text;
}

namespace {

// "x y z r" a line, commas or blanks between, until the end.
Specimen read_spheres(Lines& lines, const std::string& path) {
  Specimen specimen;
  while (lines.next()) {
    lines.insist_on_words(4, "x y z radius");
    specimen.position.push_back({lines.number(0), lines.number(1), lines.number(2)});
    specimen.radius.push_back(lines.radius(3));
  }
  if (specimen.size() == 0) throw InputError(path + ": no spheres in it");
  put_in_box(specimen);
  return specimen;
}

}  // namespace

Specimen specimen_of_yade_text(const std::string& text, const std::string& path) {
  Lines lines(text, path);
  return read_spheres(lines, path);
}

Specimen specimen_of_csv_text(const std::string& text, const std::string& path) {
  Lines lines(text, path);
  const std::vector<std::string_view> header{"x", "y", "z", "radius"};
  if (!lines.next()) throw InputError(path + ": the file is empty, expected a header x,y,z,radius");
  if (lines.words() != header) lines.fail("expected the header x,y,z,radius");
  return read_spheres(lines, path);
}

Specimen specimen_of_liggghts_text(const std::string& text, const std::string& path) {
  // The first line is a title, whatever it holds.
  const std::size_t title = text.find('\n');
  if (title == std::string::npos) throw InputError(path + ": no LIGGGHTS data file");
  const std::string body = "#" + text.substr(0, title) + text.substr(title);
  Lines lines(body, path);

  std::int64_t atoms = -1, bonds = 0;
  Specimen specimen;
  std::vector<bool> seen;
  bool has_atoms = false;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words.size() == 2 && words[1] == "atoms") {
      atoms = lines.integer(0);
      if (atoms < 1 || atoms > std::numeric_limits<std::int32_t>::max())
        lines.fail(fmt::format("{} atoms: expected 1 to 2147483647", atoms));
    } else if (words.size() == 2 && words[1] == "bonds") {
      bonds = lines.integer(0);
    } else if (words[0] == "Atoms") {
      if (atoms < 0) lines.fail("section Atoms before the line \"N atoms\"");
      has_atoms = true;
      for (std::int64_t k = 0; k < atoms; ++k) {
        if (!lines.next())
          throw InputError(fmt::format("{}: the file ends after {} of {} atoms", path, k, atoms));
        // The arrays grow with the lines, so that a wrong count cannot ask for all memory.
        lines.insist_on_words(8, "id type x y z diameter density molecule");
        const std::int64_t id = lines.integer(0);
        if (id < 1 || id > atoms)
          lines.fail(fmt::format("atom id {}: expected 1 to {}", id, atoms));
        const auto i = static_cast<std::size_t>(id - 1);
        if (seen.size() <= i) {
          seen.resize(i + 1, false);
          specimen.position.resize(i + 1);
          specimen.radius.resize(i + 1);
        }
        if (seen[i]) lines.fail(fmt::format("atom id {} is there twice", id));
        seen[i] = true;
        specimen.position[i] = {lines.number(2), lines.number(3), lines.number(4)};
        specimen.radius[i] = lines.radius(5, 0.5);
      }
    } else if (words[0] == "Bonds") {
      for (std::int64_t k = 0; k < bonds; ++k) {
        if (!lines.next())
          throw InputError(fmt::format("{}: the file ends after {} of {} bonds", path, k, bonds));
        lines.insist_on_words(4, "id type atom atom");
        const std::int64_t a = lines.integer(2) - 1, b = lines.integer(3) - 1;
        if (a < 0 || b < 0 || a >= atoms || b >= atoms || a == b)
          lines.fail(fmt::format("bond of atoms {} and {}: expected two atoms from 1 to {}", a + 1,
                                 b + 1, atoms));
        specimen.bonds.push_back(
            {static_cast<std::int32_t>(std::min(a, b)), static_cast<std::int32_t>(std::max(a, b))});
      }
    }
    // Other header lines and sections (velocities) do not concern a specimen.
  }
  if (!has_atoms) throw InputError(path + ": no section Atoms in it");
  std::sort(specimen.bonds.begin(), specimen.bonds.end());
  put_in_box(specimen);
  return specimen;
}

}  // namespace solidem
