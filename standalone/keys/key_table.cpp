// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/key_table.hpp"

#include <fmt/format.h>

namespace solidem {

namespace {

std::string text_of(const Shown& shown) {
  if (const auto* word = std::get_if<std::string>(&shown)) return "`\"" + *word + "\"`";
  if (const auto* flag = std::get_if<bool>(&shown)) return *flag ? "`true`" : "`false`";
  if (const auto* whole = std::get_if<std::int64_t>(&shown)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&shown)) return fmt::format("{:g}", *number);
  return "";
}

std::string default_of(const Key& key) {
  if (key.is_required) return "needed";
  if (!key.otherwise.empty() || !key.rule.show) return key.otherwise;
  return text_of(key.rule.show());
}

/// A bar would end a cell.
std::string in_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\\|");
  return text;
}

}  // namespace

std::string key_row(const Key& key) {
  const std::string& expected = key.rule.expected;
  const std::string colon = expected.empty() || key.meaning.empty() ? "" : ": ";
  return "| `" + key.name + "` | " + in_cell(expected + colon + key.meaning) + " | " +
         in_cell(default_of(key)) + " |";
}

std::string key_table(const std::vector<Key>& keys) {
  std::string table = "| key | value | default |\n|---|---|---|\n";
  for (const Key& key : keys) table += key_row(key) + "\n";
  return table;
}

}  // namespace solidem
