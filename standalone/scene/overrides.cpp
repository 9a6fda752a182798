// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "keys/nearest_name.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

constexpr const char* example = "SECTION.KEY=VALUE, such as beams.young_modulus=\"3 TPa\"";

/// A key of the scene and, unless it is to go, its value: a table that holds nothing else.
struct Assignment {
  std::string words;  ///< "--set KEY=VALUE"
  toml::table tree;
  bool goes = false;

  [[noreturn]] void refuse(const std::string& problem, const std::string& expected) const {
    throw InputError(words + ": " + problem + "; expected " + expected);
  }
};

std::optional<toml::table> parse(const std::string& line, const std::string& words) {
  try {
    return toml::parse(line, words);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe + '"';
}

Assignment read_assignment(const std::string& text) {
  Assignment read{"--set " + text, {}};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) read.refuse("no key and value", example);
  if (std::any_of(text.begin(), text.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    read.refuse("holds a line break or another control character", example);
  const std::string key = text.substr(0, equals) + " = ", value = text.substr(equals + 1);
  const std::size_t first = value.find_first_not_of(' ');
  read.goes = first == std::string::npos;
  std::optional<toml::table> tree;
  if (!read.goes) tree = parse(key + value, read.words);
  if (!tree) {
    if (!parse(key + "0", read.words)) read.refuse("no key of a scene", example);
    if (!read.goes && std::string("[{\"'").find(value[first]) != std::string::npos)
      read.refuse("the value is not TOML", "such as \"3 TPa\", 0.3, true or [\"1 m\", \"2 m\"]");
    tree = parse(key + quoted(value), read.words);
  }
  if (!tree || tree->size() != 1) read.refuse("no key and value", example);
  read.tree = std::move(*tree);
  return read;
}

/// The entry of a list that a key names, or numbers; none: −1.
std::ptrdiff_t entry_of(const toml::array& list, const std::string& key) {
  for (std::size_t k = 0; k < list.size(); ++k)
    if (const toml::table* entry = list[k].as_table())
      if (entry->at_path("name").value<std::string>() == key) return static_cast<std::ptrdiff_t>(k);
  std::size_t number = 0;
  const char* const end = key.data() + key.size();
  const auto [stop, error] = std::from_chars(key.data(), end, number);
  const bool is_entry = error == std::errc() && stop == end && number < list.size();
  return is_entry ? static_cast<std::ptrdiff_t>(number) : -1;
}

std::vector<std::string> names_in(const toml::array& list) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const toml::table* entry = list[k].as_table();
    names.push_back(entry == nullptr
                        ? std::to_string(k)
                        : entry->at_path("name").value<std::string>().value_or(std::to_string(k)));
  }
  return names;
}

/// Puts one branch of an override into what stands there. `path` leads to it, for messages.
void put(toml::node& there, toml::table& branch, const Assignment& from, const std::string& path);

void put_value(toml::table& table, const std::string& key, toml::node& value,
               const Assignment& from, const std::string& path) {
  if (!from.goes)
    return value.visit([&](auto& typed) { table.insert_or_assign(key, std::move(typed)); });
  std::vector<std::string> names;
  for (const auto& [name, node] : table) names.emplace_back(name.str());
  if (table.erase(key) == 0)
    from.refuse((path.empty() ? "the scene" : path) + " has no " + key + did_you_mean(key, names),
                "one of " + join(names) + ", to take it out");
}

void put_into_list(toml::array& list, const std::string& key, toml::node& value,
                   const Assignment& from, const std::string& path) {
  const std::vector<std::string> names = names_in(list);
  const std::ptrdiff_t entry = entry_of(list, key);
  if (entry < 0)
    from.refuse(path + " has no entry " + key + did_you_mean(key, names),
                "one of " + join(names) + ", or a number from 0");
  const auto at = list.begin() + entry;
  if (toml::table* further = value.as_table(); further != nullptr && !further->is_inline())
    put(*at, *further, from, path + "." + key);
  else if (from.goes)
    list.erase(at);
  else
    value.visit([&](auto& typed) { list.replace(at, std::move(typed)); });
}

void put(toml::node& there, toml::table& branch, const Assignment& from, const std::string& path) {
  const std::string key(branch.begin()->first.str());
  toml::node& value = branch.begin()->second;
  if (toml::array* list = there.as_array()) return put_into_list(*list, key, value, from, path);
  toml::table* const table = there.as_table();
  if (table == nullptr)
    from.refuse(path + " is no section, so it has no " + key, "the key of a single value");
  // Only a table in braces is a value; others are what the dots of the key make.
  toml::table* const further = value.as_table();
  toml::node* const found = table->get(key);
  if (further != nullptr && !further->is_inline() && found != nullptr)
    put(*found, *further, from, path.empty() ? key : path + "." + key);
  else
    put_value(*table, key, value, from, path);
}

}  // namespace

void override_value(toml::table& scene, const std::string& assignment) {
  Assignment read = read_assignment(assignment);
  put(scene, read.tree, read, "");
}

}  // namespace solidem
