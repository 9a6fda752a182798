// SPDX-License-Identifier: GPL-2.0-or-later
//
// The kinds of values a scene is made of. Each function makes the rule that reads one kind into a
// target; an std::optional is a target too.
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

/// {time, position}: a target that moves.
std::array<TimeFunction, 3> read_path(const Section& section);

/// What stands in a target.
template <class Number>
Shown shown(Number value) {
  if constexpr (std::is_integral_v<Number>)
    return static_cast<std::int64_t>(value);
  else
    return value;
}
template <class Target>
Shown shown(const std::optional<Target>& value) {
  return value ? shown(*value) : Shown{};
}

template <class Target>
Rule quantity(Target& target, const Dimension& dimension, const Range& range = anything) {
  return {describe(dimension, range),
          [&target, dimension, range](const Value& value) {
            target = read_quantity(value, dimension, range);
          },
          [&target] { return shown(target); }};
}

template <class Target>
Rule number(Target& target, const Range& range = anything) {
  return {"a number" + range.text(),
          [&target, range](const Value& value) { target = read_number(value, range); },
          [&target] { return shown(target); }};
}

template <class Target>
Rule integer(Target& target, std::int64_t lower,
             std::int64_t upper = std::numeric_limits<std::int64_t>::max()) {
  return {"an integer from " + std::to_string(lower),
          [&target, lower, upper](const Value& value) {
            target = static_cast<Target>(read_integer(value, lower, upper));
          },
          [&target] { return shown(target); }};
}

Rule flag(bool& target);

/// Text without restriction.
Rule text(std::string& target);

/// A name that becomes part of column and group names: letters, digits, _ and -; each once.
Rule name(std::string& target, std::set<std::string>& taken);

/// A path, relative to the folder of the scene file.
Rule path(std::string& target);
inline Rule path(std::string& target, const std::string& /*scene_file*/) {
  return path(target);
}

inline Rule function(TimeFunction& target, const Dimension& dimension,
                     const Range& range = anything) {
  return {describe(dimension, range) + ", or a function of time",
          [&target, dimension, range](const Value& value) {
            target = read_function(value, dimension, range);
          }};
}

inline Rule property(TemperatureFunction& target, const Dimension& dimension,
                     const Range& range = anything) {
  return {describe(dimension, range) + ", or a table {temperature, value}",
          [&target, dimension, range](const Value& value) {
            target = read_property(value, dimension, range);
          }};
}

/// One of several words.
template <class Target>
Rule choice(Target& target, const std::vector<std::pair<std::string, Target>>& words) {
  std::vector<std::string> names, quoted;
  for (const auto& word : words) {
    names.push_back(word.first);
    quoted.push_back("\"" + word.first + "\"");
  }
  const std::string expected = (names.size() > 1 ? "one of " : "") + join(quoted);
  return {expected,
          [&target, words, names, expected](const Value& value) {
            const std::string given = read_text(value, expected);
            for (const auto& word : words) {
              if (word.first != given) continue;
              target = word.second;
              return;
            }
            value.refuse("unknown" + did_you_mean(given, names), expected);
          },
          [&target, words]() -> Shown {
            for (const auto& word : words)
              if (word.second == target) return word.first;
            return {};
          }};
}

/// Any of several words, each once.
Rule words(std::vector<std::string>& target, const std::vector<std::string>& known);

/// "x", "y" or "z" as 0, 1 or 2.
inline Rule axis(int& target) {
  return choice<int>(target, {{"x", 0}, {"y", 1}, {"z", 2}});
}

/// Three entries along x, y, z; `read_entry` reads the one of an axis.
Rule triple(const std::string& expected_entry,
            const std::function<void(const Value& entry, int axis)>& read_entry);

/// Three quantities.
Rule vector(Vector& target, const Dimension& dimension, const Range& range = anything);

/// Three numbers that say where something points; of unit length in the target.
Rule direction(Vector& target);

}  // namespace solidem

#endif
