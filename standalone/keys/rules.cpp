// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "model/error.hpp"

namespace solidem {

bool Range::contains(double value) const {
  return (lower_included ? value >= lower : value > lower) &&
         (upper_included ? value <= upper : value < upper);
}

std::string Range::text() const {
  const bool bounded_below = std::isfinite(lower), bounded_above = std::isfinite(upper);
  std::string words;
  if (bounded_below && bounded_above && lower_included && upper_included)
    return fmt::format(" from {:g} to {:g}", lower, upper);
  if (bounded_below)
    words += fmt::format(lower_included ? " of at least {:g}" : " above {:g}", lower);
  if (bounded_below && bounded_above) words += " and";
  if (bounded_above)
    words += fmt::format(upper_included ? " of at most {:g}" : " below {:g}", upper);
  return words;
}

std::string describe(const Dimension& dimension, const Range& range) {
  std::string words = dimension.name + range.text();
  // Zero is zero in every unit; other bounds need theirs.
  const bool zero_only = (!std::isfinite(range.lower) || range.lower == 0) &&
                         (!std::isfinite(range.upper) || range.upper == 0);
  if (!zero_only || dimension.offset_is_allowed) words += std::string(" ") + dimension.unit;
  return words + " such as \"" + dimension.example + "\"";
}

double read_quantity(const Value& value, const Dimension& dimension, const Range& range) {
  const std::string expected = describe(dimension, range);
  const toml::node& node = value.node();
  const bool is_pure = std::string(dimension.unit) == dimension::number.unit;
  if (is_pure && node.is_number()) return read_number(value, range);
  if (node.is_number()) value.refuse("has no unit", expected);
  if (!node.is_string()) value.refuse("not a quantity", expected);
  double si = 0;
  try {
    si = to_si(node.as_string()->get(), dimension);
  } catch (const InputError& error) {
    value.refuse(error.what(), expected);
  }
  if (!range.contains(si))
    value.refuse(fmt::format("{:g} {} is out of range", si, dimension.unit), expected);
  value.note(fmt::format("{}", si));  // the shortest text that reads back as the same number
  return si;
}

double read_number(const Value& value, const Range& range) {
  const std::string expected = "a number" + range.text();
  if (value.node().is_string()) {
    if (value.node().as_string()->get().find('%') == std::string::npos)
      value.refuse("text", expected + ", without quotes");
    return read_quantity(value, dimension::number, range);
  }
  const auto number = value.node().value<double>();
  if (!number || !value.node().is_number()) value.refuse("not a number", expected);
  if (!std::isfinite(*number)) value.refuse("not finite", expected);
  if (!range.contains(*number)) value.refuse("out of range", expected);
  value.note(fmt::format("{}", *number));
  return *number;
}

std::int64_t read_integer(const Value& value, std::int64_t lower, std::int64_t upper) {
  const std::string expected = upper == std::numeric_limits<std::int64_t>::max()
                                   ? fmt::format("an integer of at least {}", lower)
                                   : fmt::format("an integer from {} to {}", lower, upper);
  if (!value.node().is_integer()) value.refuse("not an integer", expected);
  const std::int64_t number = value.node().as_integer()->get();
  if (number < lower || number > upper) value.refuse("out of range", expected);
  value.note(std::to_string(number));
  return number;
}

namespace {

std::string text_of(const Value& value, const std::string& expected) {
  if (!value.node().is_string()) value.refuse("not text", expected);
  return value.node().as_string()->get();
}

}  // namespace

std::string read_text(const Value& value, const std::string& expected) {
  std::string text = text_of(value, expected);
  value.note("\"" + text + "\"");
  return text;
}

Rule flag(bool& target) {
  return {"true or false",
          [&target](const Value& value) {
            if (!value.node().is_boolean()) value.refuse("neither true nor false", "true or false");
            target = value.node().as_boolean()->get();
            value.note(target ? "true" : "false");
          },
          [&target]() -> Shown { return target; }};
}

Rule text(std::string& target) {
  return {"text in quotes",
          [&target](const Value& value) { target = read_text(value, "text in quotes"); },
          [&target]() -> Shown { return target; }};
}

Rule name(std::string& target, std::set<std::string>& taken) {
  const std::string expected = "a name of letters, digits, _ and -, different from the others";
  return {expected, [&target, &taken, expected](const Value& value) {
            target = read_text(value, expected);
            const bool is_plain =
                !target.empty() && target.find_first_not_of(
                                       "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789_-") == std::string::npos;
            if (!is_plain) value.refuse("not a name", expected);
            if (!taken.insert(target).second) value.refuse("the name is taken", expected);
          }};
}

Rule path(std::string& target) {
  const std::string expected = "the path of a file, relative to the folder of the scene";
  return {expected, [&target, expected](const Value& value) {
            const std::string given = text_of(value, expected);
            if (given.empty() || given.find('\0') != std::string::npos)
              value.refuse("not a path", expected);
            const auto full = std::filesystem::path(value.file()).parent_path() / given;
            std::error_code error;
            const std::filesystem::file_status status = std::filesystem::status(full, error);
            if (!std::filesystem::status_known(status))
              value.refuse(full.string() + " cannot be looked at: " + error.message(), expected);
            if (!std::filesystem::exists(status))
              value.refuse("no such file (" + full.string() + ")", expected);
            if (std::filesystem::is_directory(status)) value.refuse("a folder", expected);
            target = full.string();
            value.note("\"" + full.filename().string() + "\"");  // folders may move
          }};
}

Rule words(std::vector<std::string>& target, const std::vector<std::string>& known) {
  std::vector<std::string> quoted;
  for (const std::string& word : known) quoted.push_back("\"" + word + "\"");
  const std::string expected = "a list of any of " + join(quoted);
  return {expected, [&target, known, expected](const Value& value) {
            std::vector<std::string> read;
            for (const Value& entry : value.entries(-1, expected)) {
              const std::string word = read_text(entry, expected);
              if (std::find(known.begin(), known.end(), word) == known.end())
                entry.refuse("unknown" + did_you_mean(word, known), expected);
              if (std::find(read.begin(), read.end(), word) != read.end())
                entry.refuse("given twice", "each once");
              read.push_back(word);
            }
            target = read;
          }};
}

Rule triple(const std::string& expected_entry,
            const std::function<void(const Value& entry, int axis)>& read_entry) {
  const std::string expected = "three entries [x, y, z], each " + expected_entry;
  return {expected, [expected, read_entry](const Value& value) {
            const std::vector<Value> entries = value.entries(3, expected);
            for (int k = 0; k < 3; ++k) read_entry(entries[static_cast<std::size_t>(k)], k);
          }};
}

Rule vector(Vector& target, const Dimension& dimension, const Range& range) {
  Rule rule =
      triple(describe(dimension, range), [&target, dimension, range](const Value& entry, int k) {
        component(target, k) = read_quantity(entry, dimension, range);
      });
  rule.show = [&target] { return std::array<double, 3>{target.x, target.y, target.z}; };
  return rule;
}

Rule direction(Vector& target) {
  const std::string expected = "three numbers [x, y, z], not all zero";
  return {expected, [&target, expected](const Value& value) {
            const std::vector<Value> entries = value.entries(3, expected);
            Vector v{};
            for (int k = 0; k < 3; ++k)
              component(v, k) = read_number(entries[static_cast<std::size_t>(k)], anything);
            const double length = norm(v);
            if (!(length > 0) || !std::isfinite(length)) value.refuse("no direction", expected);
            target = (1 / length) * v;
          }};
}

namespace {

Rule quantities(std::vector<double>& target, const Dimension& dimension, const Range& range) {
  const std::string expected = "an array, each entry " + describe(dimension, range);
  return {expected, [&target, dimension, range, expected](const Value& value) {
            for (const Value& entry : value.entries(-1, expected))
              target.push_back(read_quantity(entry, dimension, range));
          }};
}

/// Refuses abscissas that are none or do not increase, and another number of values.
void check_table(const Section& section, const std::string& key, const std::vector<double>& at,
                 const std::string& value_key, std::size_t values) {
  if (at.empty()) section.refuse(key, "empty", "at least one " + key);
  if (values != at.size())
    section.refuse(value_key, fmt::format("{} entries", values),
                   fmt::format("as many as of {}, {}", key, at.size()));
  for (std::size_t k = 1; k < at.size(); ++k)
    if (at[k] <= at[k - 1])
      section.refuse(key, fmt::format("entry {} is not above entry {}", k, k - 1),
                     "increasing entries");
}

TimeFunction read_table(const Section& section, const Dimension& dimension, const Range& range) {
  TimeFunction function;
  section.read({must_have("time", quantities(function.time, dimension::time, anything)),
                must_have("value", quantities(function.value, dimension, range))},
               "a function of time by a table");
  check_table(section, "time", function.time, "value", function.value.size());
  return function;
}

TimeFunction read_sine(const Section& section, const Dimension& dimension, const Range& range) {
  // An amplitude of "10 °C" would be 283.15 K: a difference of temperatures has no offset.
  const Dimension swing =
      dimension.offset_is_allowed ? dimension::temperature_difference : dimension;
  TimeFunction function = TimeFunction::constant(0);
  section.read(
      {may_have("mean", quantity(function.value[0], dimension)),
       must_have("amplitude", quantity(function.amplitude, swing)),
       must_have("frequency", quantity(function.frequency, dimension::frequency, positive)),
       may_have("phase", quantity(function.phase, dimension::angle))},
      "a function of time by a sine");
  const double reach = std::abs(function.amplitude);
  for (const double extreme : {function.value[0] - reach, function.value[0] + reach})
    if (!range.contains(extreme))
      section.refuse(fmt::format("reaches {:g} {}", extreme, dimension.unit),
                     "values that are " + describe(dimension, range));
  return function;
}

}  // namespace

TimeFunction read_function(const Value& value, const Dimension& dimension, const Range& range) {
  if (!value.node().is_table())
    return TimeFunction::constant(read_quantity(value, dimension, range));
  const Section section(value);
  if (section.has("time") || section.has("value")) return read_table(section, dimension, range);
  for (const char* key : {"mean", "amplitude", "frequency", "phase"})
    if (section.has(key)) return read_sine(section, dimension, range);
  value.refuse("no function of time", std::string(dimension.name) +
                                          ", {time, value} or {mean, amplitude, frequency, phase}");
}

TemperatureFunction read_property(const Value& value, const Dimension& dimension,
                                  const Range& range) {
  if (!value.node().is_table()) return {read_quantity(value, dimension, range)};
  const Section section(value);
  std::vector<double> temperature, values;
  section.read(
      {must_have("temperature", quantities(temperature, dimension::temperature, not_negative)),
       must_have("value", quantities(values, dimension, range))},
      "a table over temperature");
  check_table(section, "temperature", temperature, "value", values.size());
  return {temperature, values};
}

std::array<TimeFunction, 3> read_path(const Section& section) {
  std::vector<double> time;
  std::array<TimeFunction, 3> path;
  const std::string expected = "an array, each entry three lengths";
  section.read(
      {must_have("time", quantities(time, dimension::time, anything)),
       must_have("position", {expected,
                              [&](const Value& value) {
                                for (const Value& entry : value.entries(-1, expected)) {
                                  Vector point{};
                                  vector(point, dimension::length).read(entry);
                                  for (std::size_t k = 0; k < 3; ++k)
                                    path[k].value.push_back(component(point, static_cast<int>(k)));
                                }
                              }})},
      "a path");
  check_table(section, "time", time, "position", path[0].value.size());
  for (TimeFunction& along : path) along.time = time;
  return path;
}

}  // namespace solidem
