// SPDX-License-Identifier: GPL-2.0-or-later
//
// Files that are no scene, and scenes whose parts do not go together.
#include "bad_scene.hpp"

namespace solidem::test::bad_files_test {

class BadFiles : public testing::TestWithParam<BadScene> {};

TEST_P(BadFiles, IsRefusedWithPlaceAndRemedy) {
  expect_refused(GetParam());
}

// name, scene, from, to, on the line of, fragments
const BadScene without_their_effect[] = {
    {"grips",
     heat,
     "[run]",
     "[[grips]]\nname = \"g\"\nregion = { all = true }\n[run]",
     "[[grips]]",
     {"[[grips]]", "a section [beams]"}},
    {"gauge",
     heat,
     "[run]",
     "[gauge]\naxis = \"x\"\nlower = \"0 m\"\nupper = \"1 mm\"\n[run]",
     "[gauge]",
     {"[gauge]", "a section [beams]"}},
    {"initial_velocities",
     heat,
     "[run]",
     "[[initial_velocities]]\nregion = { all = true }\nvelocity = [\"1 m/s\", \"0 m/s\", \"0 "
     "m/s\"]\n[run]",
     "[[initial",
     {"[[initial_velocities]]", "a section [beams]"}},
    {"temperatures",
     bar,
     "[run]",
     "[[temperatures]]\nname = \"t\"\nregion = { all = true }\nvalue = \"1 K\"\n[run]",
     "[[temperatures]]",
     {"[[temperatures]]", "a section [conduction]"}},
    {"temperature_sensor",
     bar,
     "\"displacement\"",
     "\"temperature\"",
     "",
     {"quantity = \"temperature\"", "a section [conduction]"}},
    {"velocity_sensor",
     heat,
     "\"temperature\"",
     "\"velocity\"",
     "",
     {"quantity = \"velocity\"", "a section [beams]"}},
    {"no_effect_at_all",
     heat,
     "[conduction]\nlaw = \"platonic\"\ninitial_temperature = \"25 °C\"\n[[temperatures]]\nname = "
     "\"hot\"\nregion = { all = true }\nvalue = \"798 K\"\n[[sensors]]\nname = \"B\"\npoint = [\"1 "
     "mm\", \"0 mm\", \"0 mm\"]\nquantity = \"temperature\"\n",
     "",
     "[material]",
     {"[material]", "[beams], [contact], [central_forces] or [conduction]"}},
};

INSTANTIATE_TEST_SUITE_P(WithoutItsEffect, BadFiles, testing::ValuesIn(without_their_effect),
                         row_name);

const BadScene not_toml[] = {
    {"broken_header", bar, "[beams]", "[beams", "", {"column 7", "not TOML"}},
    {"key_given_twice",
     bar,
     "radius_ratio = 0.27",
     "radius_ratio = 0.27\nradius_ratio = 0.3",
     "radius_ratio = 0.3",
     {"not TOML", "radius_ratio"}},
    {"unquoted_quantity", bar, "\"3.5 TPa\"", "3.5 TPa", "", {"not TOML"}},
    {"value_left_out", bar, "\"3.5 TPa\"", "", "young_modulus", {"not TOML"}},
    {"not_utf8", bar, "a bar", "a \xff bar", "", {"not TOML"}},
};

INSTANTIATE_TEST_SUITE_P(NotToml, BadFiles, testing::ValuesIn(not_toml), row_name);

TEST(BadSceneFile, Empty) {
  for (const char* text : {"", "\n\n", "# nothing but a comment\n"}) {
    const std::string words = complaint(text);
    EXPECT_NE(words.find("scene.toml: empty; expected a scene"), std::string::npos) << words;
  }
}

TEST(BadSceneFile, SectionsMissing) {
  const std::string no_specimen = complaint("[run]\nsteps = 1\n");
  EXPECT_NE(no_specimen.find("[specimen] is missing"), std::string::npos) << no_specimen;
  const std::string no_run =
      complaint(replaced(heat_scene, "[run]\nsteps = 100\ntime_step = \"1 ns\"\n", ""));
  EXPECT_NE(no_run.find("[run] is missing"), std::string::npos) << no_run;
  const std::string no_material =
      complaint(replaced(bar_scene, "[material]\ndensity = \"2790 kg/m^3\"\n", ""));
  EXPECT_NE(no_material.find("[material] is missing"), std::string::npos) << no_material;
}

TEST(BadSceneFile, NotThereOrNotAFile) {
  const auto words_on = [](const std::string& path) -> std::string {
    try {
      read_scene(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string absent = folder().file("absent.toml");
  EXPECT_NE(words_on(absent).find(absent + ": no such file"), std::string::npos);
  EXPECT_NE(words_on(folder().file(".")).find(": a folder"), std::string::npos);
  EXPECT_NE(words_on("").find("no such file"), std::string::npos);
  const std::string secret = folder().write("secret.toml", heat_scene);
  std::filesystem::permissions(secret, std::filesystem::perms::none);
  if (geteuid() != 0) {  // root reads everything
    EXPECT_NE(words_on(secret).find("cannot be read"), std::string::npos);
  }
}

}  // namespace solidem::test::bad_files_test
