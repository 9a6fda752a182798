// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/fingerprint.hpp"

#include <gtest/gtest.h>

#include "scene_text.hpp"

namespace solidem::test::fingerprint_test {

std::string fingerprint_of(const std::string& text) {
  return fingerprint(read_text_scene(text));
}

TEST(Fingerprint, IsTheSameForALongerRunThatWritesOtherwise) {
  const std::string original = fingerprint_of(bar_scene);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "\"1 ms\"\ntime", "\"2 ms\"\ntime")), original);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "duration = \"1 ms\"", "steps = 5")), original);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "observe_every = 10\n", "")), original);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "frames = 20", "frames = 2")), original);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "a bar", "the bar")), original);
  // Of two ways to the same time step, neither changes a state; checkpoints compare the step
  // itself.
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "time_step_ratio = 0.2", "time_step_ratio = 0.1")),
            original);
}

TEST(Fingerprint, IsTheSameInOtherUnitsAndAnotherOrder) {
  const std::string original = fingerprint_of(bar_scene);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "3.5 TPa", "3500 GPa")), original);
  EXPECT_EQ(fingerprint_of(replaced(bar_scene, "poisson_ratio = 0.3\nradius_ratio = 0.27",
                                    "radius_ratio = 0.27\npoisson_ratio = 0.3")),
            original);
}

TEST(Fingerprint, ChangesWithAllThatMatters) {
  const std::pair<const char*, const char*> changes[] = {
      {"elements = 1000", "elements = 1001"},
      {"elements = 1000", "elements = 1000\nseed = 2"},
      {"\"5 mm\", \"3 mm\"", "\"5 mm\", \"3.0000000000000004 mm\""},
      {"tolerance = 0.05", "tolerance = 0.04"},
      {"2790", "2791"},
      {"3.5 TPa", "3.6 TPa"},
      {"poisson_ratio = 0.3", "poisson_ratio = 0.2"},
      {"radius_ratio = 0.27", "radius_ratio = 0.28"},
      {"radius_ratio = 0.27", "radius_ratio = 0.27\nradius_from = \"pair\""},
      {"depth = \"0.3 mm\"", "depth = \"0.2 mm\""},
      {"layers = 1.5", "layers = 1"},
      {"\"2 m/s\"", "\"3 m/s\""},
      {"50 Hz", "60 Hz"},
      {"rotation = \"free\"", "rotation = \"fixed\""},
      {"-3.3 mm/s", "-3.4 mm/s"},
      {"name = \"A\"", "name = \"B\""},
      {"lower = \"1.5 mm\"", "lower = \"1.4 mm\""},
  };
  const std::string original = fingerprint_of(bar_scene);
  for (const auto& [from, to] : changes) {
    const std::string changed = fingerprint_of(replaced(bar_scene, from, to));
    EXPECT_NE(changed, original) << to;
    EXPECT_NE(first_difference(original, changed), "") << to;
  }
}

TEST(Fingerprint, TheDifferenceIsNamed) {
  const std::string original = fingerprint_of(bar_scene);
  EXPECT_EQ(first_difference(original, original), "");
  const std::string changed =
      fingerprint_of(replaced(bar_scene, "radius_ratio = 0.27", "radius_ratio = 0.5"));
  EXPECT_EQ(first_difference(original, changed), "beams.radius_ratio = 0.27, not 0.5");
  const std::string longer = fingerprint_of(
      replaced(bar_scene, "radius_ratio = 0.27", "radius_ratio = 0.27\nradius_from = \"pair\""));
  EXPECT_EQ(first_difference(original, longer), "beams.radius_from not given, not \"pair\"");
  EXPECT_EQ(first_difference(longer, original), "beams.radius_from = \"pair\", not given");
}

}  // namespace solidem::test::fingerprint_test
