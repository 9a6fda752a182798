// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/effect_kind.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace solidem {

namespace {

nlohmann::ordered_json to_json(const Shown& shown) {
  return std::visit(
      [](const auto& value) -> nlohmann::ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
          return nullptr;
        else
          return value;
      },
      shown);
}

}  // namespace

void add_values(const std::vector<Key>& keys, nlohmann::ordered_json& values) {
  for (const Key& key : keys)
    if (key.rule.show) values[key.name] = to_json(key.rule.show());
}

void append_values(const std::vector<Key>& keys, nlohmann::ordered_json& list) {
  nlohmann::ordered_json values = nlohmann::ordered_json::object();
  add_values(keys, values);
  list.push_back(std::move(values));
}

bool provides(const Setup& setup, Provides what) {
  const std::vector<EffectKind>& kinds = effect_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const EffectKind& kind) {
    return kind.provides == what && kind.is_named(setup);
  });
}

std::string any_section(const std::vector<std::string>& sections) {
  std::string words = "a section ";
  for (std::size_t k = 0; k < sections.size(); ++k)
    words += (k == 0 ? "[" : k + 1 < sections.size() ? ", [" : " or [") + sections[k] + "]";
  return words;
}

std::string sections_that_provide(const std::vector<Provides>& any_of) {
  std::vector<std::string> sections;
  for (const EffectKind& kind : effect_kinds())
    if (std::find(any_of.begin(), any_of.end(), kind.provides) != any_of.end())
      sections.push_back(kind.section);
  return any_section(sections);
}

}  // namespace solidem
