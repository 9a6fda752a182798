// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "effects/effect_kind.hpp"
#include "keys/key_table.hpp"
#include "scene/scene_text.hpp"

namespace solidem::test::keys_on_the_page_test {

TEST(KeysOnThePage, AreThoseThatTheReaderKnowsWithTheirDefaults) {
  const std::string page = file_text(SOLIDEM_SOURCE_DIR "/docs/scene.md");
  for (const EffectKind& kind : effect_kinds())
    kind.visit_keys([&](const std::string& section, const std::vector<Key>& keys) {
      const std::size_t heading =
          page.find(kind.is_list ? "# `[[" + section + "]]`" : "# `[" + section + "]`");
      ASSERT_NE(heading, std::string::npos) << section;
      const std::size_t table = page.find("| key |", heading);
      EXPECT_EQ(page.compare(table, key_table(keys).size() + 1, key_table(keys) + "\n"), 0)
          << "[" << section << "]: run docs/make_key_tables";
    });
}

TEST(KeysOnThePage, SayWhatEachIsUnlessItsNameSaysIt) {
  for (const EffectKind& kind : effect_kinds())
    kind.visit_keys([&](const std::string& section, const std::vector<Key>& keys) {
      for (const Key& key : keys)
        EXPECT_TRUE(key.is_required || key.rule.show || !key.otherwise.empty())
            << section << "." << key.name << ": nothing says what holds without it";
    });
}

}  // namespace solidem::test::keys_on_the_page_test
