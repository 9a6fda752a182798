// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "model/error.hpp"

namespace solidem {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

// Longer texts are no units anybody means; the limit keeps what UDUNITS has to digest small.
constexpr std::size_t longest_unit = 60;
// Letters up to which all upper and lower case spellings are tried for a suggestion.
constexpr std::size_t most_letters = 8;

ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);  // it would write to stderr; we say what is wrong
    ut_system* read = ut_read_xml(nullptr);
    if (read == nullptr)
      throw InputError(
          "the UDUNITS-2 database of units cannot be read; install it (Debian: libudunits2-data) "
          "or "
          "set UDUNITS2_XML_PATH");
    return read;
  }();
  return system;
}

Unit parse_unit(const std::string& text) {
  return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8));
}

bool has_dimension(const Unit& unit, const Dimension& expected) {
  return unit && ut_are_convertible(unit.get(), parse_unit(expected.unit).get()) != 0;
}

/// In base units: "1000 m²·kg·s⁻³·K⁻¹".
std::string in_base_units(const Unit& unit) {
  char text[256] = "";
  const int size = ut_format(unit.get(), text, sizeof text, UT_UTF8 | UT_DEFINITION);
  return size > 0 && size < static_cast<int>(sizeof text) ? text : "";
}

/// Units that differ from `text` in upper and lower case only and have the right dimension.
std::vector<std::string> case_variants(const std::string& text, const Dimension& expected) {
  std::vector<std::size_t> letters;
  for (std::size_t k = 0; k < text.size(); ++k)
    if (std::isalpha(static_cast<unsigned char>(text[k])) != 0) letters.push_back(k);
  std::vector<std::string> found;
  if (letters.size() > most_letters) return found;
  for (unsigned flips = 1; flips < 1U << letters.size(); ++flips) {
    std::string variant = text;
    for (std::size_t k = 0; k < letters.size(); ++k)
      if ((flips >> k & 1U) != 0) variant[letters[k]] ^= 0x20;  // ASCII: the other case
    if (has_dimension(parse_unit(variant), expected)) found.push_back(variant);
  }
  return found;
}

/// " (did you mean ...?)" or nothing.
std::string suggestion(const std::string& number, const std::string& unit,
                       const Dimension& expected) {
  static const std::map<std::string, std::string> slips = {
      {"C", "°C"}, {"c", "°C"}, {"F", "°F"}, {"deg", "degree"}};
  std::vector<std::string> better = case_variants(unit, expected);
  const auto slip = slips.find(unit);
  if (slip != slips.end() && has_dimension(parse_unit(slip->second), expected))
    better.insert(better.begin(), slip->second);
  std::string text;
  for (std::size_t k = 0; k < better.size() && k < 3; ++k)
    text += (k == 0 ? " (did you mean \"" : " or \"") + number + " " + better[k] + "\"";
  return text.empty() ? text : text + "?)";
}

/// Signs as people and programs print them, in those that UDUNITS reads: "W⋅m⁻¹" as "W.m^-1".
std::string spelt_plainly(std::string text) {
  static const std::pair<const char*, const char*> signs[] = {
      {"⁻", "-"}, {"⁺", ""},  {"⁰", "0"}, {"¹", "1"}, {"²", "2"}, {"³", "3"},
      {"⁴", "4"}, {"⁵", "5"}, {"⁶", "6"}, {"⁷", "7"}, {"⁸", "8"}, {"⁹", "9"}};
  static const std::pair<const char*, const char*> others[] = {
      {"−", "-"}, {"⋅", "."}, {"∙", "."},      {"•", "."},      {"×", "."},
      {"º", "°"}, {"˚", "°"}, {"\u00a0", " "}, {"\u202f", " "}, {"\u2009", " "}};
  std::string plain;
  bool is_raised = false;
  for (std::size_t k = 0; k < text.size();) {
    const auto stands_here = [&](const auto& sign) {
      return text.compare(k, std::strlen(sign.first), sign.first) == 0;
    };
    const auto sign = std::find_if(std::begin(signs), std::end(signs), stands_here);
    const auto other = std::find_if(std::begin(others), std::end(others), stands_here);
    if (sign != std::end(signs)) {
      plain += (is_raised ? "" : "^") + std::string(sign->second);
      k += std::strlen(sign->first);
    } else if (other != std::end(others)) {
      plain += other->second;
      k += std::strlen(other->first);
    } else {
      plain += text[k++];
    }
    is_raised = sign != std::end(signs);
  }
  return plain;
}

/// The number at the start of a quantity; `rest` is what follows it.
double leading_number(const std::string& quantity, std::string& number, std::string& rest) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
  std::size_t begin = 0;
  while (begin < quantity.size() && is_space(quantity[begin])) ++begin;
  if (begin < quantity.size() && quantity[begin] == '+') ++begin;
  double value = 0;
  const char* const first = quantity.data() + begin;
  const auto [end, error] = std::from_chars(first, quantity.data() + quantity.size(), value);
  if (error == std::errc::invalid_argument) throw InputError("does not begin with a number");
  if (error != std::errc() || !std::isfinite(value)) throw InputError("not a finite number");
  number.assign(first, end);
  rest.assign(end, quantity.data() + quantity.size());
  while (!rest.empty() && is_space(rest.back())) rest.pop_back();
  std::size_t unit_begin = 0;
  while (unit_begin < rest.size() && is_space(rest[unit_begin])) ++unit_begin;
  rest.erase(0, unit_begin);
  return value;
}

/// UDUNITS would take "2 GPa" or "@ 5" for units, which turns slips such as "73 2 GPa" into values.
bool looks_like_a_unit(const std::string& text) {
  if (text.size() > longest_unit) return false;
  if (text.compare(0, 2, "1/") == 0) return true;
  const auto first = static_cast<unsigned char>(text.front());
  const bool is_name = std::isalpha(first) != 0 || first >= 0x80 || first == '%' || first == '(';
  return is_name && text.find('@') == std::string::npos;
}

/// value × factor, for factors such as 1e-3 that binary numbers do not hold a division by 1000: so
/// "60 um" is the same number as 60e-6.
double scaled(double value, double factor) {
  const auto is_whole = [](double x) { return std::abs(x - std::round(x)) <= 1e-14 * std::abs(x); };
  if (is_whole(factor)) return value * std::round(factor);
  if (is_whole(1 / factor)) return value / std::round(1 / factor);
  return value * factor;
}

/// Converts, provided that the conversion is a plain factor (or, where allowed, factor and offset).
double convert(double value, const Unit& unit, const std::string& unit_text,
               const Dimension& expected) {
  const Unit target = parse_unit(expected.unit);
  const Converter converter(ut_get_converter(unit.get(), target.get()));
  if (!converter) throw InputError("\"" + unit_text + "\" cannot be converted");
  const auto at = [&](double x) { return cv_convert_double(converter.get(), x); };
  const double offset = at(0), factor = at(1) - offset;
  if (std::abs(at(2) - offset - 2 * factor) > 1e-9 * std::abs(factor))
    throw InputError("\"" + unit_text + "\" is a logarithmic unit");
  if (offset != 0 && !expected.offset_is_allowed)
    throw InputError("\"" + unit_text + "\" has an offset, which makes no sense for " +
                     expected.name);
  const double converted = offset == 0 ? scaled(value, factor) : at(value);
  if (!std::isfinite(converted)) throw InputError("too large");
  return converted;
}

}  // namespace

double to_si(const std::string& quantity, const Dimension& expected) {
  std::string number, unit_text;
  const double value = leading_number(spelt_plainly(quantity), number, unit_text);
  if (unit_text.empty()) throw InputError("has no unit");
  if (unit_text.front() == ',') throw InputError("a decimal comma; write a point");
  const Unit unit = looks_like_a_unit(unit_text) ? parse_unit(unit_text) : nullptr;
  if (!unit)
    throw InputError("\"" + unit_text + "\" is no unit" + suggestion(number, unit_text, expected));
  if (!has_dimension(unit, expected))
    throw InputError("\"" + unit_text + "\" has another dimension (" + in_base_units(unit) + ")" +
                     suggestion(number, unit_text, expected));
  // Radians count as pure numbers in UDUNITS, so 60 rpm would pass for 6.28 Hz.
  const auto is_angular = [](const std::string& text) {
    return text.find("rad") != std::string::npos;
  };
  if (is_angular(in_base_units(unit)) && !is_angular(expected.unit))
    throw InputError("\"" + unit_text + "\" counts an angle, where none is meant");
  if (!is_angular(in_base_units(unit)) && is_angular(expected.unit))
    throw InputError("\"" + unit_text + "\" counts no angle, where one is meant");
  return convert(value, unit, unit_text, expected);
}

}  // namespace solidem
