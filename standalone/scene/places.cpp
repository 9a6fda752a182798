// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/places.hpp"

#include <cctype>

#include "keys/place.hpp"

namespace solidem {

namespace {

bool begins_with(const std::string& text, const std::string& name) {
  if (text.compare(0, name.size(), name) != 0) return false;
  if (text.size() == name.size()) return true;
  const auto next = static_cast<unsigned char>(text[name.size()]);
  return std::isalnum(next) == 0 && next != '_';
}

/// By its own name, or by its number from 1.
std::string name_of_entry(const toml::table& entry, std::size_t number) {
  const auto name = entry["name"].value<std::string>();
  return name ? "\"" + *name + "\"" : std::to_string(number);
}

}  // namespace

Places::Places(const toml::table& file, const std::string& path) : path_(path) {
  for (const auto& [key, node] : file) add_section(node, std::string(key.str()));
}

void Places::add(const toml::node& node, const std::string& name) {
  place_.emplace(name, place_of(node, path_));
}

/// A section of [name] or those of [[name]]; the first entry is found by [[name]] alone.
void Places::add_section(const toml::node& node, const std::string& name) {
  const std::string single = "[" + name + "]", list = "[[" + name + "]]";
  if (const toml::table* table = node.as_table()) {
    for (const std::string& called : {single, list}) {
      add(node, called);
      add_keys(*table, called);
    }
    for (const auto& [key, inner] : *table)
      if (inner.is_table() || is_array_of_tables(inner))
        add_section(inner, name + "." + std::string(key.str()));
  } else if (is_array_of_tables(node)) {
    std::size_t number = 0;
    for (const toml::node& entry : *node.as_array()) {
      const toml::table& keys = *entry.as_table();
      const std::string called = list + " " + name_of_entry(keys, ++number);
      add(entry, list);
      add(entry, called);
      add_keys(keys, called);
    }
  }
}

void Places::add_keys(const toml::table& table, const std::string& name) {
  for (const auto& [key, node] : table) {
    const std::string called = name + " " + std::string(key.str());
    add(node, called);
    if (!is_array_of_tables(node)) continue;
    std::size_t number = 0;
    for (const toml::node& entry : *node.as_array())
      add(entry, called + " " + std::to_string(++number));
  }
}

std::string Places::located(const std::string& message) const {
  if (message.empty() || message.front() != '[') return message;
  const std::string* found = &path_;
  std::size_t length = 0;
  for (const auto& [name, place] : place_)
    if (name.size() > length && begins_with(message, name)) {
      length = name.size();
      found = &place;
    }
  return found->empty() ? message : *found + ": " + message;
}

}  // namespace solidem
