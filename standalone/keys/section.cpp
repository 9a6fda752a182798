// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "keys/nearest_name.hpp"
#include "keys/place.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

constexpr std::size_t longest_text = 60;

/// On one line, without control characters, and not too long; never cut inside a UTF-8 character.
std::string shorten(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  if (text.size() <= longest_text) return text;
  std::size_t end = longest_text;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "…";
}

std::string text_of(const toml::node& node) {
  if (const auto* text = node.as_string()) return "\"" + shorten(text->get()) + "\"";
  if (const auto* number = node.as_floating_point()) return fmt::format("{:#}", number->get());
  std::ostringstream stream;
  node.visit([&stream](const auto& value) { stream << value; });
  return shorten(stream.str());
}

/// "[beams]" or "[[grips]]", and not "[beams] young_modulus" or "[run] x[2]".
bool names_section(const std::string& label) {
  return !label.empty() && label.front() == '[' && label.find(' ') == std::string::npos;
}

}  // namespace

std::string place_of(const toml::node& node, const std::string& file) {
  const toml::source_region& source = node.source();
  if (source.path && *source.path != file) return *source.path;
  return file + (source.begin.line > 0 ? ":" + std::to_string(source.begin.line) : "");
}

bool is_array_of_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array != nullptr && array->is_homogeneous(toml::node_type::table);
}

const toml::node* Value::find(const std::string& key) const {
  const toml::table* table = node_.as_table();
  return table == nullptr ? nullptr : table->get(key);
}

Value Value::child(const std::string& key) const {
  return {*find(key), file_, child_label(key), record_};
}

std::string Value::child_label(const std::string& key) const {
  const toml::node* node = find(key);
  const std::string name = shorten(key);
  if (!label_.empty()) return label_ + (names_section(label_) ? " " : ".") + name;
  if (node == nullptr || node->is_table()) return "[" + name + "]";  // what may lack is a section
  return is_array_of_tables(*node) ? "[[" + name + "]]" : name;
}

std::vector<Value> Value::entries(int size, const std::string& expected) const {
  const toml::array* array = node_.as_array();
  if (array == nullptr) refuse("not an array", expected);
  if (size >= 0 && array->size() != static_cast<std::size_t>(size))
    refuse("has " + std::to_string(array->size()) + " entries, not " + std::to_string(size),
           expected);
  std::vector<Value> values;
  for (std::size_t k = 0; k < array->size(); ++k) {
    const std::string entry = names_section(label_) ? "" : "[" + std::to_string(k) + "]";
    values.emplace_back((*array)[k], file_, label_ + entry, record_);
  }
  return values;
}

std::string Value::place() const {
  return (label_.empty() ? file_ : place_of(node_, file_)) + ": ";
}

void Value::refuse(const std::string& problem, const std::string& expected) const {
  std::string name = label_;
  if (!label_.empty() && !names_section(label_)) name += " = " + text_of(node_);
  throw InputError(place() + name + (name.empty() ? "" : ": ") + problem + "; expected " +
                   expected);
}

void Value::refuse_missing(const std::string& key, const std::string& expected) const {
  throw InputError(place() + child_label(key) + " is missing; expected " + expected);
}

Section::Section(const Value& value) : value_(value) {
  if (!value.node().is_table()) value.refuse("not a section", "a table of keys and values");
}

void Section::read(const std::vector<Key>& keys, const std::string& kind) const {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  for_each([&](const std::string& name, const Value& value) {
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    value.refuse("no such key" + (kind.empty() ? "" : " in " + kind) + did_you_mean(name, names),
                 "one of " + join(names));
  });
  for (const Key& key : keys) read_one(key);
}

void Section::read_one(const Key& key) const {
  if (has(key.name))
    key.rule.read(value_.child(key.name));
  else if (key.is_required)
    value_.refuse_missing(key.name,
                          key.rule.expected + (key.reason.empty() ? "" : " (" + key.reason + ")"));
}

void Section::for_each(
    const std::function<void(const std::string& key, const Value&)>& visit) const {
  // TOML tables are kept in alphabetical order; errors should come in the order of the file.
  std::vector<std::string> keys;
  for (const auto& [key, node] : *value_.node().as_table()) keys.emplace_back(key.str());
  const auto position = [this](const std::string& key) {
    const toml::source_position at = value_.find(key)->source().begin;
    return std::make_pair(at.line, at.column);
  };
  std::stable_sort(keys.begin(), keys.end(), [&](const std::string& a, const std::string& b) {
    return position(a) < position(b);
  });
  for (const std::string& key : keys) visit(key, value_.child(key));
}

void Section::at_most_one_of(const std::vector<std::string>& keys) const {
  std::string first;
  for (const std::string& key : keys) {
    if (!has(key)) continue;
    if (!first.empty()) refuse(key, "given beside " + first, "only one of " + join(keys));
    first = key;
  }
}

void Section::exactly_one_of(const std::vector<std::string>& keys) const {
  at_most_one_of(keys);
  if (std::none_of(keys.begin(), keys.end(), [this](const auto& key) { return has(key); }))
    refuse("incomplete", "one of " + join(keys));
}

void Section::refuse(const std::string& key, const std::string& problem,
                     const std::string& expected) const {
  if (has(key)) value_.child(key).refuse(problem, expected);
  value_.refuse(problem, expected);
}

Rule table(const std::function<void(const Section&)>& read) {
  return {"a section", [read](const Value& value) {
            if (!value.node().is_table()) value.refuse("not a section", "[section] with its keys");
            read(Section(value));
          }};
}

Rule tables(const std::function<void(const Section&)>& read_each) {
  return {"one or more [[sections]]", [read_each](const Value& value) {
            if (!is_array_of_tables(value.node()))
              value.refuse("not a list of sections", "double brackets, [[ ]], for each of them");
            for (const Value& entry : value.entries(-1, "")) read_each(Section(entry));
          }};
}

}  // namespace solidem
