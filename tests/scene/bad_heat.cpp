// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bad values and combinations in what heats a body.
#include "bad_scene.hpp"

namespace solidem::test {
namespace {

class BadHeat : public testing::TestWithParam<BadScene> {};

TEST_P(BadHeat, IsRefusedWithPlaceAndRemedy) {
  expect_refused(GetParam());
}

const std::string law = "law = \"platonic\"";
const std::string region = "region = { all = true }";

/// A section in front of [run].
std::string with(const std::string& section) {
  return section + "\n[run]";
}

const std::string disc = "shape = { kind = \"cylinder\", radius = \"4 mm\" }\n";

const std::string mixed_beams =
    "[beams]\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\nradius_ratio = 0.3\n"
    "precision = \"mixed\"\n";

// name, scene, from, to, on the line of, fragments
const BadScene bad[] = {
    {"negative_conductivity",
     heat,
     "134 W/(m K)",
     "-134 W/(m K)",
     "",
     {"conductivity = \"-134 W/(m K)\"", "out of range", "above 0"}},
    {"negative_in_a_table",
     heat,
     "\"134 W/(m K)\"",
     "{ temperature = [\"300 K\", \"400 K\"], value = [\"134 W/(m K)\", \"0 W/(m K)\"] }",
     "",
     {"conductivity.value[1] = \"0 W/(m K)\"", "above 0"}},
    {"table_that_falls",
     heat,
     "\"134 W/(m K)\"",
     "{ temperature = [\"400 K\", \"300 K\"], value = [\"134 W/(m K)\", \"1 W/(m K)\"] }",
     "",
     {"temperature", "entry 1 is not above entry 0"}},
    {"unknown_law", heat, law, "law = \"voronoy\"", "", {"did you mean", "\"voronoi\""}},
    {"factor_without_its_law",
     heat,
     law,
     law + "\narea_factor = 0.8",
     "area_factor",
     {"area_factor = 0.8", "platonic-calibrated"}},
    {"broken_bonds_where_none_breaks",
     heat,
     law,
     law + "\nbroken_bonds = \"conduct\"",
     "broken_bonds",
     {"broken_bonds", "no bond ever breaks", "[rupture]"}},
    {"unknown_choice_of_broken_bonds",
     heat,
     law,
     "broken_bonds = \"isolate\"",
     "",
     {"broken_bonds = \"isolate\"", "\"insulate\"", "\"conduct\""}},
    {"auto_without_tolerance",
     heat,
     law,
     "integrator = \"auto\"",
     "",
     {"integrator = \"auto\"", "tolerance beside it"}},
    {"tolerance_of_explicit",
     heat,
     law,
     "tolerance = \"1 K\"",
     "",
     {"tolerance = \"1 K\"", "integrator = \"rkl2\""}},
    {"region_and_wall",
     heat,
     region,
     region + "\nwall = \"y_low\"",
     "wall",
     {"[[temperatures]] wall", "given beside region"}},
    {"flux_without_wall",
     heat,
     "[run]",
     with("[[heat_fluxes]]\nname = \"in\"\nflux = \"1 W/m^2\""),
     "[[heat_fluxes]]",
     {"wall is missing", "x_low"}},
    {"convection_below_zero",
     heat,
     "[run]",
     with("[[convections]]\nname = \"air\"\nwall = \"side\"\ncoefficient = \"-1 W/(m^2 K)\"\n"
          "temperature = \"25 °C\""),
     "coefficient",
     {"coefficient = \"-1 W/(m^2 K)\"", "of at least 0"}},
    {"source_nowhere",
     heat,
     "[run]",
     with("[[heat_sources]]\nname = \"disc\"\npower = \"1 W\"\n" + disc),
     "[[heat_sources]]",
     {"incomplete", "centre, path"}},
    {"source_of_two_strengths",
     heat,
     "[run]",
     with("[[heat_sources]]\nname = \"disc\"\npower = \"1 W\"\npower_density = \"1 W/m^3\"\n" +
          disc),
     "power = ",
     {"given beside power_density"}},
    {"region_that_moves",
     heat,
     "[run]",
     with("[[heat_sources]]\nname = \"s\"\npower = \"1 W\"\n" + region +
          "\nvelocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]"),
     "velocity",
     {"a region stays where it is", "a shape"}},
    {"unknown_shape",
     heat,
     "[run]",
     with("[[heat_sources]]\nname = \"s\"\npower = \"1 W\"\nshape = { kind = \"cone\" }"),
     "cone",
     {"kind = \"cone\"", "\"cylinder\""}},
    {"contact_of_one_material",
     heat,
     "[run]",
     with("[[thermal_contacts]]\nbetween = [\"a\", \"b\"]\nconductance = \"1 W/(m^2 K)\""),
     "between",
     {"between[0] = \"a\"", "unknown"}},
    {"fit_of_a_position",
     bar,
     "quantity = \"displacement\"",
     "quantity = \"displacement\"\nsampling = \"fit\"",
     "sampling",
     {"of temperatures only", "nearest"}},
    {"heat_without_conduction",
     bar,
     "[run]",
     with("[[heat_fluxes]]\nname = \"in\"\nwall = \"x_low\"\nflux = \"1 W/m^2\""),
     "[[heat_fluxes]]",
     {"nothing conducts heat", "[conduction]"}},
    {"heat_that_waits_for_nothing",
     heat,
     law,
     law + "\nevery = 2",
     "every",
     {"every = 2", "nothing moves", "[beams]"}},
    {"two_ways_to_wait",
     heat,
     law,
     law + "\nevery = 2\nlargest_change = \"1 K\"",
     "largest_change",
     {"largest_change = \"1 K\"", "given beside every"}},
    {"plastic_heat_of_nothing",
     heat,
     "[run]",
     with("[plastic_heat]\nfraction = 0.9"),
     "[plastic_heat]",
     {"no bond flows", "[plasticity]"}},
    {"more_heat_than_work",
     heat,
     "[run]",
     with("[plastic_heat]\nfraction = 1.1"),
     "fraction",
     {"fraction = 1.1", "from 0 to 1"}},
    {"expansion_without_bonds",
     heat,
     "[run]",
     with("[expansion]"),
     "[material]",
     {"expansion_coefficient", "needed by [expansion]"}},
    {"beams_without_stiffness",
     heat,
     "[run]",
     with("[softening]\nmodulus_ratio = { temperature = [\"300 K\", \"800 K\"], value = [1, 0] }"),
     "modulus_ratio",
     {"modulus_ratio.value[1] = 0", "above 0"}},
    {"softening_of_beams_in_single_precision",
     heat,
     "[run]",
     with(mixed_beams + "[softening]\nmodulus_ratio = 0.5"),
     "[softening]",
     {"mixed precision", "precision = \"double\""}},
};

INSTANTIATE_TEST_SUITE_P(Value, BadHeat, testing::ValuesIn(bad), row_name);

}  // namespace
}  // namespace solidem::test
