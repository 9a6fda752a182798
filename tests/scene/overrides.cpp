// SPDX-License-Identifier: GPL-2.0-or-later
//
// Values beside a scene file: they hold instead of those in it, and messages say where they stood.
#include <gtest/gtest.h>

#include "scene/fingerprint.hpp"
#include "scene_text.hpp"
#include "support/refusal.hpp"

namespace solidem::test::overrides_test {

Scene read_with(const std::vector<std::string>& set) {
  SceneSource source("bar.toml");
  source.text = bar_scene;
  source.set = set;
  return read_scene(source);
}

std::string complaint_with(const std::string& assignment) {
  return test::refusal_of([&] { read_with({assignment}); });
}

std::string complaint_head(const std::string& assignment, const std::string& rest) {
  const std::string head = "--set " + assignment + ": " + rest;
  const std::string found = complaint_with(assignment);
  return found.rfind(head, 0) == 0 ? "" : found;
}

TEST(Overrides, change_what_a_changed_file_would_change) {
  const Scene by_file = read_text_scene(replaced(replaced(bar_scene, "\"3.5 TPa\"", "\"3 TPa\""),
                                                 "poisson_ratio = 0.3", "poisson_ratio = 0.25"));
  const Scene by_words = read_with({"beams.young_modulus=3 TPa", "beams.poisson_ratio=0.25"});
  EXPECT_EQ(fingerprint(by_words), fingerprint(by_file));
  EXPECT_EQ(by_words.set.size(), 2U);
}

TEST(Overrides, reach_the_entries_of_lists_by_name_and_by_number) {
  const auto velocity = [](const std::string& key) {
    return fingerprint(read_with({key + "=[\"3 m/s\", \"0 m/s\", \"0 m/s\"]"}));
  };
  EXPECT_EQ(velocity("grips.left.velocity"), velocity("grips.0.velocity"));
  EXPECT_EQ(velocity("grips.left.velocity"),
            fingerprint(read_with({"grips.left.velocity.0=3 m/s"})));
  EXPECT_NE(velocity("grips.left.velocity"), fingerprint(read_with({})));
}

TEST(Overrides, reach_into_tables_in_braces_and_make_sections) {
  const std::string deeper = fingerprint(read_with({"sets.left.depth=0.5 mm"}));
  EXPECT_NE(deeper, fingerprint(read_with({})));
  const Scene braked =
      read_with({"gravity.acceleration=[\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]"});
  EXPECT_NE(fingerprint(braked).find("gravity.acceleration"), std::string::npos);
}

TEST(Overrides, take_out_what_is_given_no_value) {
  EXPECT_TRUE(read_with({}).setup.gauge);
  EXPECT_FALSE(read_with({"gauge="}).setup.gauge);
  EXPECT_EQ(complaint_head("beams.yung_modulus=",
                           "beams has no yung_modulus (did you mean young_modulus?)"),
            "");
}

TEST(Overrides, hold_in_their_order) {
  EXPECT_EQ(fingerprint(read_with({"beams.young_modulus=1 TPa", "beams.young_modulus=3 TPa"})),
            fingerprint(read_with({"beams.young_modulus=3 TPa"})));
}

TEST(Overrides, are_named_in_messages) {
  EXPECT_EQ(complaint_head("beams.young_modulus=3 kg", "[beams] young_modulus = \"3 kg\": "), "");
  EXPECT_EQ(complaint_head("beams.yung_modulus=3 TPa", "[beams] yung_modulus = \"3 TPa\": no such"),
            "");
  EXPECT_EQ(complaint_head("bems.young_modulus=3 TPa", "[bems]: no such key"), "");
  EXPECT_EQ(complaint_head("grips.left.velocity.0=3 kg", "[[grips]] velocity[0] = \"3 kg\": "), "");
}

TEST(Overrides, that_lead_nowhere_are_refused) {
  EXPECT_EQ(
      complaint_head("grips.lft.velocity=0 m/s", "grips has no entry lft (did you mean left?)"),
      "");
  EXPECT_EQ(complaint_head("beams.young_modulus.x=1", "beams.young_modulus is no section"), "");
  for (const char* nonsense : {"beams", "=3", "a b=3", "[beams]=3"})
    EXPECT_EQ(complaint_head(nonsense, "no key"), "") << nonsense;
  EXPECT_EQ(complaint_head("grips.left.velocity=[\"1 m/s\"", "the value is not TOML"), "");
  EXPECT_EQ(complaint_head("title=\"a\nb\"", "holds a line break"), "");
}

TEST(Overrides, leave_the_lines_of_the_file_in_its_own_messages) {
  SceneSource source("bar.toml");
  source.text = replaced(bar_scene, "poisson_ratio = 0.3", "poisson_ratio = 3");
  source.set = {"beams.young_modulus=3 TPa"};
  try {
    read_scene(source);
    FAIL() << "a Poisson ratio of 3 was taken";
  } catch (const InputError& error) {
    const int line = line_of(bar_scene, "poisson_ratio");
    EXPECT_EQ(std::string(error.what()).rfind("bar.toml:" + std::to_string(line) + ": ", 0), 0U)
        << error.what();
  }
}

}  // namespace solidem::test::overrides_test
