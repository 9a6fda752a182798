// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/say.hpp"
#include "effects/effect_kind.hpp"
#include "engine/frame_fields.hpp"
#include "keys/key_table.hpp"
#include "keys/nearest_name.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// "[beams]" or "[[grips]]".
std::string heading(const EffectKind& kind, const std::string& section) {
  return kind.is_list ? "[[" + section + "]]" : "[" + section + "]";
}

void print(const EffectKind& kind) {
  kind.visit_keys([&](const std::string& section, const std::vector<Key>& keys) {
    say("### `{}`\n\n{}\n", heading(kind, section), key_table(keys));
  });
  if (!kind.example.empty()) say("```toml\n{}```\n\n", kind.example);
}

/// What [output] fields may name.
void print_fields() {
  std::string table = "| field | what it shows, of each element (or bond) |\n|---|---|\n";
  for (const FieldName& field : frame_field_names())
    table += fmt::format("| `{}` | {} |\n", field.name, field.meaning);
  say("### `[output] fields`\n\n{}\n", table);
}

}  // namespace

void list_keys(const std::string& section) {
  std::vector<std::string> sections{"fields"};
  bool is_known = section.empty() || section == "fields";
  for (const EffectKind& kind : effect_kinds()) {
    sections.push_back(kind.section);
    if (!section.empty() && kind.section != section) continue;
    is_known = true;
    print(kind);
  }
  if (section.empty() || section == "fields") print_fields();
  if (!is_known)
    throw InputError("keys: no effect has a section [" + section + "]" +
                     did_you_mean(section, sections) + "; expected one of " + join(sections));
}

}  // namespace solidem
