// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/text_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "model/error.hpp"
#include "specimen/body_lines.hpp"
#include "specimen/bonds.hpp"
#include "specimen/text_lines.hpp"

namespace solidem {

std::string liggghts_text(const Specimen& specimen) {
  const Domain& domain = specimen.domain;
  const std::vector<std::int32_t> degree = count_bonds(specimen);
  const auto side = [&](std::size_t axis) { return domain.periodic[axis] ? 'p' : 'f'; };
  std::string text = fmt::format(
      "LIGGGHTS data of a solidem specimen, units = si, boundary {} {} {}, atom_style hybrid "
      "granular molecular: id type x y z diameter density molecule\n\n",
      side(0), side(1), side(2));
  text += body_lines(specimen);
  text += fmt::format("{} atoms\n", specimen.size());
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

namespace {

void add_spheres(const Specimen& specimen, char separator, std::string& text) {
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    fmt::format_to(std::back_inserter(text), "{:.17g}{}{:.17g}{}{:.17g}{}{:.17g}\n", p.x, separator,
                   p.y, separator, p.z, separator, specimen.radius[i]);
  }
}

}  // namespace

std::string yade_text(const Specimen& specimen) {
  const Domain& domain = specimen.domain;
  std::string text = "#format x_y_z_r\n";
  if (domain.periodic[0] && domain.periodic[1] && domain.periodic[2]) {
    const Vector period = domain.upper - domain.lower;
    text += fmt::format("##PERIODIC:: {:.17g} {:.17g} {:.17g}\n", period.x, period.y, period.z);
  }
  text += body_lines(specimen);
  add_spheres(specimen, '\t', text);
  return text;
}

std::string csv_text(const Specimen& specimen) {
  std::string text = "x,y,z,radius\n";
  add_spheres(specimen, ',', text);
  return text + body_lines(specimen);  // at the end: the first line is the header, for all readers
}

namespace {

// The columns that hold a sphere, in a line of `count` (0: or more).
struct SphereColumns {
  std::array<std::size_t, 4> place{0, 1, 2, 3};  // of x, y, z, radius
  std::size_t count = 4;
  std::string names = "x y z radius";
};

// "x y z r" a line, commas or blanks between, until the end.
template <class Look>
Specimen read_spheres(TextLines& lines, SphereColumns columns, const std::string& path,
                      Look look_at_line) {
  Specimen specimen;
  DecimalPrecision precision;
  while (lines.next()) {
    look_at_line(columns);
    const std::size_t words = lines.words().size();
    if (columns.count == 0 ? words < 4 : words != columns.count)
      lines.fail(fmt::format("{} values, expected {} ({})", words,
                             std::max<std::size_t>(columns.count, 4), columns.names));
    const auto [x, y, z, r] = columns.place;
    specimen.position.push_back({lines.number(x), lines.number(y), lines.number(z)});
    specimen.radius.push_back(lines.radius(r));
    for (const std::size_t word : columns.place)
      precision.note(lines.words()[word], lines.number(word));
  }
  if (specimen.size() == 0) throw InputError(path + ": no spheres in it");
  put_in_box(specimen);
  specimen.contact_margin = contact_margin(precision, specimen);
  return specimen;
}

// Columns of YADE's "x_y_z_r", "x_y_z_r_clumpId", "id_x_y_z_r_matId", "x_y_z_r_attrs".
SphereColumns columns_of(const std::string& format, const TextLines& lines) {
  std::vector<std::string> names(1);
  for (const char c : format)
    if (c == '_')
      names.emplace_back();
    else
      names.back() += c;
  SphereColumns columns;
  const char* const wanted[] = {"x", "y", "z", "r"};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto found = std::find(names.begin(), names.end(), wanted[k]);
    if (found == names.end())
      lines.fail(
          fmt::format("format {}: expected x_y_z_r, x_y_z_r_clumpId, x_y_z_r_matId or "
                      "x_y_z_r_attrs",
                      format));
    columns.place[k] = static_cast<std::size_t>(found - names.begin());
  }
  columns.count = names.back() == "attrs" ? 0 : names.size();
  columns.names = format;
  return columns;
}

// "#format" and "##PERIODIC::" of YADE, which look like comments.
void read_yade_comments(const std::string& text, const std::string& path, SphereColumns& columns,
                        std::optional<Vector>& period) {
  TextLines comments(text, path);
  while (comments.next_comment()) {
    const auto& words = comments.words();
    if (words[0] == "format" && words.size() == 2)
      columns = columns_of(std::string(words[1]), comments);
    if (words[0] != "#PERIODIC::") continue;
    if (words.size() != 4) comments.fail("##PERIODIC:: expected the three lengths of the cell");
    period = {comments.number(1), comments.number(2), comments.number(3)};
    if (!(period->x > 0 && period->y > 0 && period->z > 0))
      comments.fail("##PERIODIC:: expected three lengths above zero");
  }
}

}  // namespace

Specimen specimen_of_yade_text(const std::string& text, const std::string& path) {
  SphereColumns columns;
  std::optional<Vector> period;
  read_yade_comments(text, path, columns, period);
  const bool is_told = columns.names != SphereColumns{}.names;
  TextLines lines(text, path);
  bool is_first = true;
  Specimen specimen = read_spheres(lines, columns, path, [&](SphereColumns& known) {
    // Packings that YADE saves have the number of the clump as a fifth word and no format.
    if (is_first && !is_told && lines.words().size() == 5)
      known.count = 5, known.names = "x y z r clumpId";
    if (known.count == 5 && known.names == "x y z r clumpId" && lines.words().size() == 5)
      lines.integer(4);
    is_first = false;
  });
  if (period) {
    specimen.domain.periodic = {true, true, true};
    specimen.domain.lower = {};
    specimen.domain.upper = *period;
  }
  read_body_lines(text, path, specimen.domain);
  return specimen;
}

Specimen specimen_of_csv_text(const std::string& text, const std::string& path) {
  TextLines lines(text, path);
  const std::vector<std::string_view> header{"x", "y", "z", "radius"};
  if (!lines.next()) throw InputError(path + ": the file is empty, expected a header x,y,z,radius");
  if (lines.words() != header) lines.fail("expected the header x,y,z,radius");
  Specimen specimen = read_spheres(lines, {}, path, [](SphereColumns&) {});
  read_body_lines(text, path, specimen.domain);
  return specimen;
}

}  // namespace solidem
