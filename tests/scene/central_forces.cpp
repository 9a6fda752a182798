// SPDX-License-Identifier: GPL-2.0-or-later
//
// [central_forces] and [damage]: every value in its place, every error with its place and remedy,
// and no column that a scene does not name.
#include <set>

#include "bad_scene.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/plan.hpp"

namespace solidem::test::central_forces_test {

const std::string section = R"toml([central_forces]
law = "piecewise"
stiffness = "1500 kN/m"
attraction = "25 N"
range = 1.2
)toml";

const std::string scene = R"toml([specimen]
shape = "box"
size = ["5 mm", "3 mm", "2 mm"]
elements = 1000
[material]
density = "2790 kg/m^3"
)toml" + section + R"toml([damage]
crack_threshold = 0.4
minimal_neighbours = 3
[run]
steps = 10
)toml";
const std::string* const good = &scene;

CentralForceParameters forces_of(const std::string& text) {
  return read_text_scene(text).setup.get<CentralForceParameters>().value();
}

TEST(CentralForcesScene, defaults) {
  const CentralForceParameters forces = forces_of(scene);
  const auto& law = std::get<Piecewise>(forces.law);
  EXPECT_EQ(law.stiffness, 1.5e6);
  EXPECT_EQ(law.attraction, 25);
  EXPECT_EQ(forces.range, 1.2);
  EXPECT_EQ(forces.equilibrium, CentralForceParameters::Equilibrium::initial);
  EXPECT_EQ(forces.neighbours, CentralForceParameters::Neighbours::changing);
  EXPECT_EQ(forces.interpenetration, 0.1);
  EXPECT_FALSE(forces.dissipation.has_value());
  EXPECT_FALSE(forces.skin.has_value());
  EXPECT_DOUBLE_EQ(forces.bond_tolerance, 0.2);
  const DamageParameters damage = read_text_scene(scene).setup.get<DamageParameters>().value();
  EXPECT_EQ(damage.crack_threshold, 0.4);
  EXPECT_EQ(damage.every, 1);
  EXPECT_EQ(damage.minimal_neighbours, 3);
  EXPECT_EQ(damage.removal_every, 100);
}

TEST(CentralForcesScene, every_key) {
  std::string text = replaced(scene, "range = 1.2\n",
                              "range = 1.5\nequilibrium = \"radii\"\nneighbours = \"changing\"\n"
                              "interpenetration = 0.25\ndissipation = \"80 N ms/m\"\nskin = 0.3\n");
  text = replaced(text, "[material]", "[bonds]\ntolerance = 0.05\n[material]");
  text = replaced(text, "crack_threshold = 0.4\n",
                  "crack_threshold = 0.5\nevery = 4\nremoval_every = 50\n");
  const CentralForceParameters forces = forces_of(text);
  EXPECT_EQ(forces.range, 1.5);
  EXPECT_EQ(forces.equilibrium, CentralForceParameters::Equilibrium::radii);
  EXPECT_EQ(forces.interpenetration, 0.25);
  EXPECT_DOUBLE_EQ(forces.dissipation.value(), 0.08);
  EXPECT_EQ(forces.skin, 0.3);
  EXPECT_EQ(forces.bond_tolerance, 0.05);
  const DamageParameters damage = read_text_scene(text).setup.get<DamageParameters>().value();
  EXPECT_EQ(damage.crack_threshold, 0.5);
  EXPECT_EQ(damage.every, 4);
  EXPECT_EQ(damage.removal_every, 50);
  EXPECT_EQ(
      forces_of(replaced(scene, "range = 1.2", "range = 1.2\nneighbours = \"fixed\"")).neighbours,
      CentralForceParameters::Neighbours::fixed);
}

/// A section of a law of the table with a number of its own for each parameter.
template <class Law>
std::string section_of(const Law& law) {
  std::string text = std::string("[central_forces]\nrange = 1.2\nlaw = \"") + law.name + "\"\n";
  int number = 2 + static_cast<int>(Law::parameters().size());
  for (const auto& parameter : Law::parameters()) {
    const std::string value = std::to_string(number--);
    text += std::string(parameter.name) + " = ";
    switch (parameter.quantity) {
      case LawQuantity::energy:
        text += "\"" + value + " mJ\"\n";
        break;
      case LawQuantity::force:
        text += "\"" + value + " kN\"\n";
        break;
      case LawQuantity::stiffness:
        text += "\"" + value + " N/mm\"\n";
        break;
      case LawQuantity::ratio:
        text += std::string(parameter.name) == "threshold_strain" ? "0.0" + value + "\n"
                                                                  : "1." + value + "\n";
        break;
      case LawQuantity::exponent:
        text += value + "\n";
        break;
    }
  }
  return text;
}

TEST(CentralForcesScene, parameters_of_every_law_of_the_table) {
  CentralLaws::for_each([](const auto& which) {
    using Law = std::decay_t<decltype(which)>;
    const std::string text = replaced(scene, section, section_of(which));
    ASSERT_EQ(complaint(text), "") << text;
    const Law law = std::get<Law>(forces_of(text).law);
    int number = 2 + static_cast<int>(Law::parameters().size());
    for (const auto& parameter : Law::parameters()) {
      const double value = number--;
      double expected = value;
      if (parameter.quantity == LawQuantity::energy) expected = 1e-3 * value;
      if (parameter.quantity == LawQuantity::force) expected = 1e3 * value;
      if (parameter.quantity == LawQuantity::stiffness) expected = 1e3 * value;
      if (parameter.quantity == LawQuantity::ratio)
        expected = std::string(parameter.name) == "threshold_strain" ? value / 100 : 1 + value / 10;
      EXPECT_DOUBLE_EQ(law.*parameter.place, expected) << law.name << " " << parameter.name;
    }
    // None can be left out.
    for (const auto& parameter : Law::parameters()) {
      const std::string key = std::string("\n") + parameter.name + " =";
      const std::size_t at = text.find(key);
      std::string without = text;
      without.erase(at, text.find('\n', at + 1) - at);
      const std::string words = complaint(without);
      EXPECT_NE(words.find(parameter.name), std::string::npos) << words;
      EXPECT_NE(words.find(law.name), std::string::npos) << words;
      EXPECT_NE(words.find("scene.toml:"), std::string::npos) << words;
    }
  });
}

class BadCentralForces : public testing::TestWithParam<BadScene> {};

TEST_P(BadCentralForces, IsRefusedWithPlaceAndRemedy) {
  expect_refused(GetParam());
}

const std::string mie =
    "law = \"mie\"\nenergy = \"1 mJ\"\nrepulsive_exponent = 4\n"
    "attractive_exponent = 8\n";
const std::string range = "range = 1.2\n";

// name, scene, from, to, on the line of, fragments
/// A law that has its pole at an overlap of 18 %.
const std::string shifted = replaced(scene, "law = \"piecewise\"\nstiffness = \"1500 kN/m\"\n",
                                     "law = \"shifted-lennard-jones\"\npeak_separation = 1.02\n");

const BadScene bad[] = {
    {"unknown_law",
     good,
     "\"piecewise\"",
     "\"piecewize\"",
     "law =",
     {"law = \"piecewize\"", "did you mean", "piecewise", "mie"}},
    {"no_law", good, "law = \"piecewise\"\n", "", "[central_forces]", {"law"}},
    {"key_of_another_law", good, range, range + "energy = \"1 J\"\n", "energy", {"energy"}},
    {"stiffness_without_unit", good, "\"1500 kN/m\"", "1500", "stiffness", {"stiffness = 1500"}},
    {"stiffness_in_pascals",
     good,
     "\"1500 kN/m\"",
     "\"1500 kPa\"",
     "stiffness",
     {"stiffness = \"1500 kPa\""}},
    {"negative_attraction", good, "\"25 N\"", "\"-25 N\"", "attraction", {"above 0"}},
    {"exponents_swapped",
     good,
     "law = \"piecewise\"\nstiffness = \"1500 kN/m\"\nattraction = \"25 N\"\n",
     mie,
     "law =",
     {"law = \"mie\"", "attractive_exponent must be below repulsive_exponent"}},
    {"range_of_one", good, range, "range = 1\n", "range", {"range = 1", "above 1"}},
    {"no_range", good, range, "", "[central_forces]", {"range"}},
    {"unknown_equilibrium",
     good,
     range,
     range + "equilibrium = \"start\"\n",
     "equilibrium",
     {"equilibrium = \"start\"", "initial", "radii"}},
    {"unknown_neighbours",
     good,
     range,
     range + "neighbours = \"some\"\n",
     "neighbours",
     {"neighbours = \"some\"", "changing", "fixed"}},
    {"whole_interpenetration",
     good,
     range,
     range + "interpenetration = 1\n",
     "interpenetration",
     {"interpenetration = 1", "out of range"}},
    {"interpenetration_beyond_the_pole",
     &shifted,
     range,
     range + "interpenetration = 0.3\n",
     "interpenetration",
     {"interpenetration = 0.3", "pole", "a smaller one"}},
    {"no_dissipation",
     good,
     range,
     range + "dissipation = \"0 N s/m\"\n",
     "dissipation",
     {"dissipation = \"0 N s/m\"", "above 0"}},
    {"dissipation_in_newtons",
     good,
     range,
     range + "dissipation = \"1 N\"\n",
     "dissipation",
     {"dissipation = \"1 N\""}},
    {"no_skin", good, range, range + "skin = 0\n", "skin", {"skin = 0", "above 0"}},
    {"skin_of_fixed_neighbours",
     good,
     range,
     range + "neighbours = \"fixed\"\nskin = 0.1\n",
     "skin",
     {"skin = 0.1", "neighbours are fixed", "changing"}},
    {"misspelt_key",
     good,
     range,
     range + "disipation = \"1 N s/m\"\n",
     "disipation",
     {"disipation", "did you mean", "dissipation"}},
    {"beams_beside_them",
     good,
     "[damage]",
     "[beams]\nyoung_modulus = \"1 TPa\"\npoisson_ratio = 0.3\nradius_ratio = 0.27\n[damage]",
     "[central_forces]",
     {"beams act between the same elements", "either [beams]"}},
    {"damage_of_nothing",
     good,
     "crack_threshold = 0.4\nminimal_neighbours = 3\n",
     "",
     "[damage]",
     {"nothing says what is damaged", "crack_threshold or minimal_neighbours"}},
    {"every_without_crack_threshold",
     good,
     "crack_threshold = 0.4\n",
     "every = 5\n",
     "every",
     {"every = 5", "no crack faces are looked for", "crack_threshold"}},
    {"removal_without_number",
     good,
     "minimal_neighbours = 3\n",
     "removal_every = 5\n",
     "removal_every",
     {"removal_every = 5", "no element is removed", "minimal_neighbours"}},
    {"negative_crack_threshold",
     good,
     "crack_threshold = 0.4",
     "crack_threshold = -0.4",
     "crack_threshold",
     {"crack_threshold = -0.4", "above 0"}},
    {"no_step_between_looks",
     good,
     "crack_threshold = 0.4\n",
     "crack_threshold = 0.4\nevery = 0\n",
     "every",
     {"every = 0"}},
    {"half_a_neighbour",
     good,
     "minimal_neighbours = 3",
     "minimal_neighbours = 2.5",
     "minimal_neighbours",
     {"minimal_neighbours = 2.5"}},
    {"damage_without_central_forces",
     bar,
     "[run]",
     "[damage]\ncrack_threshold = 0.4\n[run]",
     "[damage]",
     {"no pair can part", "a section [central_forces] or [rupture]"}},
};

INSTANTIATE_TEST_SUITE_P(Value, BadCentralForces, testing::ValuesIn(bad), row_name);

using Names = std::set<std::string>;

Names columns_of(const std::string& text, bool periodic = false) {
  Names names;
  for (const PlannedColumn& planned : make_plan(read_text_scene(text).setup, periodic).columns)
    names.insert(planned.column->name);
  return names;
}

TEST(CentralForcesPlan, asks_no_column_that_the_scene_does_not_name) {
  const std::string bare =
      replaced(replaced(scene, "[damage]\ncrack_threshold = 0.4\nminimal_neighbours = 3\n", ""),
               range, range + "equilibrium = \"radii\"\nneighbours = \"fixed\"\n");
  const Names least = {"position", "velocity", "inverse_mass"};
  const auto with = [&](Names more) {
    more.insert(least.begin(), least.end());
    return more;
  };
  EXPECT_EQ(columns_of(bare), least);
  EXPECT_EQ(columns_of(bare, true), with({"image_shift"}));
  EXPECT_EQ(columns_of(replaced(bare, "\"radii\"", "\"initial\"")), with({"rest_length"}));
  EXPECT_EQ(columns_of(replaced(bare, "\"fixed\"", "\"changing\"")),
            with({"listed_position", "listed_margin"}));
  EXPECT_EQ(columns_of(replaced(bare, range, range + "dissipation = \"1 N s/m\"\n")),
            (Names{"position_and_velocity", "velocity", "inverse_mass", "dissipated_energy"}));
  EXPECT_EQ(columns_of(replaced(bare, "[run]", "[damage]\ncrack_threshold = 0.4\n[run]")),
            with({"barycentre"}));
  EXPECT_EQ(columns_of(replaced(bare, "[run]", "[damage]\nminimal_neighbours = 3\n[run]")), least);
}

}  // namespace solidem::test::central_forces_test
