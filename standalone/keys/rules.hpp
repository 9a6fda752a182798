// SPDX-License-Identifier: GPL-2.0-or-later
//
// The kinds of values a scene is made of. Each function makes the rule that reads one kind into a
// place; an std::optional is a place too.
#ifndef SOLIDEM_KEYS_RULES_HPP
#define SOLIDEM_KEYS_RULES_HPP

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "keys/nearest_name.hpp"
#include "keys/section.hpp"
#include "keys/units.hpp"
#include "model/specimen.hpp"
#include "model/temperature_function.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// The values that make sense, in SI units.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_included = true, upper_included = true;

  bool contains(double value) const;
  std::string text() const;  ///< " above 0", " from 0 to 0.5"; empty when there is no bound
};

inline constexpr Range anything{};
inline constexpr Range positive{0, std::numeric_limits<double>::infinity(), false, true};
inline constexpr Range not_negative{0};

/// What a quantity must be, in words.
std::string describe(const Dimension& dimension, const Range& range);

/// A string with a unit, "73 GPa", in SI.
double read_quantity(const Value& value, const Dimension& dimension, const Range& range);

/// A bare number; or a share such as "5 %".
double read_number(const Value& value, const Range& range);

std::int64_t read_integer(const Value& value, std::int64_t lower, std::int64_t upper);

std::string read_text(const Value& value, const std::string& expected);

/// A constant quantity, or {temperature, value}.
TemperatureFunction read_property(const Value& value, const Dimension& dimension,
                                  const Range& range);

/// A constant quantity, {time, value} or {mean, amplitude, frequency, phase}; every value the
/// function takes lies in the range.
TimeFunction read_function(const Value& value, const Dimension& dimension, const Range& range);

/// {time, position}: a place that moves.
std::array<TimeFunction, 3> read_path(const Section& section);

/// What stands in a place.
template <class Number>
Shown shown(Number value) {
  if constexpr (std::is_integral_v<Number>)
    return static_cast<std::int64_t>(value);
  else
    return value;
}
template <class Place>
Shown shown(const std::optional<Place>& value) {
  return value ? shown(*value) : Shown{};
}

template <class Place>
Rule quantity(Place& place, const Dimension& dimension, const Range& range = anything) {
  return {describe(dimension, range),
          [&place, dimension, range](const Value& value) {
            place = read_quantity(value, dimension, range);
          },
          [&place] { return shown(place); }};
}

template <class Place>
Rule number(Place& place, const Range& range = anything) {
  return {"a number" + range.text(),
          [&place, range](const Value& value) { place = read_number(value, range); },
          [&place] { return shown(place); }};
}

template <class Place>
Rule integer(Place& place, std::int64_t lower,
             std::int64_t upper = std::numeric_limits<std::int64_t>::max()) {
  return {"an integer from " + std::to_string(lower),
          [&place, lower, upper](const Value& value) {
            place = static_cast<Place>(read_integer(value, lower, upper));
          },
          [&place] { return shown(place); }};
}

Rule flag(bool& place);

/// Text without restriction.
Rule text(std::string& place);

/// A name that becomes part of column and group names: letters, digits, _ and -; each once.
Rule name(std::string& place, std::set<std::string>& taken);

/// A path, relative to the folder of the scene file.
Rule path(std::string& place, const std::string& scene_file);

inline Rule function(TimeFunction& place, const Dimension& dimension,
                     const Range& range = anything) {
  return {describe(dimension, range) + ", or a function of time",
          [&place, dimension, range](const Value& value) {
            place = read_function(value, dimension, range);
          }};
}

inline Rule property(TemperatureFunction& place, const Dimension& dimension,
                     const Range& range = anything) {
  return {describe(dimension, range) + ", or a table {temperature, value}",
          [&place, dimension, range](const Value& value) {
            place = read_property(value, dimension, range);
          }};
}

/// One of several words.
template <class Place>
Rule choice(Place& place, const std::vector<std::pair<std::string, Place>>& words) {
  std::vector<std::string> names, quoted;
  for (const auto& word : words) {
    names.push_back(word.first);
    quoted.push_back("\"" + word.first + "\"");
  }
  const std::string expected = (names.size() > 1 ? "one of " : "") + join(quoted);
  return {expected,
          [&place, words, names, expected](const Value& value) {
            const std::string given = read_text(value, expected);
            for (const auto& word : words) {
              if (word.first != given) continue;
              place = word.second;
              return;
            }
            value.refuse("unknown" + did_you_mean(given, names), expected);
          },
          [&place, words]() -> Shown {
            for (const auto& word : words)
              if (word.second == place) return word.first;
            return {};
          }};
}

/// "x", "y" or "z" as 0, 1 or 2.
inline Rule axis(int& place) {
  return choice<int>(place, {{"x", 0}, {"y", 1}, {"z", 2}});
}

/// Three entries along x, y, z; `read_entry` reads the one of an axis.
Rule triple(const std::string& expected_entry,
            const std::function<void(const Value& entry, int axis)>& read_entry);

/// Three quantities.
Rule vector(Vector& place, const Dimension& dimension, const Range& range = anything);

}  // namespace solidem

#endif
