// SPDX-License-Identifier: GPL-2.0-or-later
//
// [calibration.curve].
#include <fmt/format.h>

#include <algorithm>

#include "keys/rules.hpp"
#include "output/read_file.hpp"
#include "scene/sections.hpp"
#include "specimen/text_lines.hpp"

namespace solidem {

namespace {

constexpr double least_lasting_strain = 5e-4;
constexpr std::size_t fewest_points = 3;
constexpr Range strain_range{0, 1, false, true};

/// What the section says of a curve.
struct CurveWords {
  JohnsonCookCurve law;
  std::string file;
  double stress_unit = 1;
  bool is_true = true;
  bool is_compressed = false;
  std::vector<double> strains;
  double tolerance = CurveTarget{}.tolerance;
};

Rule strain_list(std::vector<double>& strains) {
  const std::string expected = "strains above 0 and up to 1, rising";
  return {expected, [&strains, expected](const Value& value) {
            for (const Value& entry : value.entries(-1, expected)) {
              const double strain = read_number(entry, strain_range);
              if (!strains.empty() && strain <= strains.back())
                entry.refuse("not above the one before", expected);
              strains.push_back(strain);
            }
          }};
}

std::vector<Key> law_keys(JohnsonCookCurve& law) {
  const char* reason = "or file, for a curve of points";
  return {
      must_have("yield_stress", quantity(law.yield_stress, dimension::modulus, positive), reason),
      must_have("hardening_stress", quantity(law.hardening_stress, dimension::modulus, positive)),
      must_have("hardening_exponent", number(law.hardening_exponent, positive))};
}

std::vector<Key> file_keys(CurveWords& words) {
  return {
      must_have("file", path(words.file)),
      must_have("measure", choice<bool>(words.is_true, {{"true", true}, {"engineering", false}})),
      may_have("stress_unit", quantity(words.stress_unit, dimension::modulus, positive))};
}

/// True measures of engineering ones.
FlowPoint measured(const CurveWords& words, double strain, double stress) {
  return words.is_compressed ? compressed_point(strain, stress) : true_point(strain, stress);
}

/// Lines of strain and stress; the first may name the columns.
std::vector<FlowPoint> read_table(const CurveWords& words) {
  const std::string text = read_file(words.file);
  TextLines lines(text, words.file);
  std::vector<FlowPoint> points;
  for (bool is_first = true; lines.next(); is_first = false) {
    if (is_first && lines.begins_with_letter()) continue;
    if (lines.words().size() != 2) lines.fail("expected two numbers, a strain and a stress");
    const FlowPoint given{lines.number(0), words.stress_unit * lines.number(1)};
    if (given.strain < 0 || given.strain > 1)
      lines.fail("expected a strain from 0 to 1, as a share");
    if (words.is_compressed && !words.is_true && given.strain == 1)
      lines.fail("expected a strain below 1: of a body compressed by 1 nothing is left");
    points.push_back(words.is_true ? given : measured(words, given.strain, given.stress));
    if (points.size() > 1 && points.back().strain <= points[points.size() - 2].strain)
      lines.fail("expected a strain above the one before");
  }
  return points;
}

/// The points of a table in the flow, or where it is to be met.
std::vector<FlowPoint> points_of_table(const Section& section, const CurveWords& words,
                                       double young_modulus) {
  const std::vector<FlowPoint> table = read_table(words);
  std::vector<FlowPoint> points;
  if (!section.has("strains")) {
    std::copy_if(table.begin(), table.end(), std::back_inserter(points), [&](const FlowPoint& p) {
      return lasting_strain(p, young_modulus) >= least_lasting_strain;
    });
    return points;
  }
  for (const double strain : words.strains) {
    const double at = words.is_true ? strain : measured(words, strain, 0).strain;
    points.push_back({at, stress_at(table, at)});
    if (std::isnan(points.back().stress))
      section.refuse("strains", fmt::format("{:g} lies outside of the table", strain),
                     "strains between its first and its last");
  }
  return points;
}

std::string in_words(const FlowPoint& p) {
  return fmt::format("{:.4g} MPa at a strain of {:.4g}", p.stress / 1e6, p.strain);
}

/// What no hardening of bonds can give is refused before anything is tried.
void check(const Section& section, const std::vector<FlowPoint>& points, double young_modulus) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (lasting_strain(points[k], young_modulus) < least_lasting_strain)
      section.refuse(
          "strains",
          fmt::format("{} is not in the flow: young_modulus leaves a lasting strain of {:.2g}",
                      in_words(points[k]), lasting_strain(points[k], young_modulus)),
          fmt::format("lasting strains from {:g} on", least_lasting_strain));
    if (k > 0 && points[k].stress < points[k - 1].stress)
      section.refuse(
          fmt::format("falls from {} to {}", in_words(points[k - 1]), in_words(points[k])),
          "a true stress that never falls: bonds harden, and soften by heat and rupture alone");
  }
  if (points.size() < fewest_points)
    section.refuse(fmt::format("has {} points in the flow", points.size()),
                   fmt::format("{} at least", fewest_points));
}

}  // namespace

Rule curve_section(std::optional<CurveTarget>& target, const double& young_modulus) {
  return table([&target, &young_modulus](const Section& section) {
    CurveWords words;
    const bool is_table = section.has("file");
    std::vector<Key> keys = is_table ? file_keys(words) : law_keys(words.law);
    keys.push_back(may_have("strains", strain_list(words.strains)));
    keys.push_back(may_have("tolerance", number(words.tolerance, positive)));
    keys.push_back(may_have(
        "load", choice<bool>(words.is_compressed, {{"tension", false}, {"compression", true}})));
    section.read(keys, is_table ? "a curve of points" : "a curve of Johnson and Cook");
    if (words.strains.empty() && !section.has("strains")) words.strains = {0.005, 0.01, 0.02, 0.05};
    const std::vector<FlowPoint> points = is_table
                                              ? points_of_table(section, words, young_modulus)
                                              : points_of(words.law, young_modulus, words.strains);
    check(section, points, young_modulus);
    target = CurveTarget{points, words.tolerance, words.is_compressed};
  });
}

}  // namespace solidem
