// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bad values and combinations in what bonds do.
#include "bad_scene.hpp"

namespace solidem::test {
namespace {

class BadBeams : public testing::TestWithParam<BadScene> {};

TEST_P(BadBeams, IsRefusedWithPlaceAndRemedy) {
  expect_refused(GetParam());
}

const std::string beams = "[beams]";

/// A section in front of [run].
std::string with(const std::string& section) {
  return section + "\n[run]";
}

// name, scene, from, to, on the line of, fragments
const BadScene bad[] = {
    {"unknown_law",
     bar,
     beams,
     "[beams]\nlaw = \"timoshenk\"",
     "law =",
     {"law = \"timoshenk\"", "did you mean", "spring"}},
    {"shear_coefficient_of_euler",
     bar,
     beams,
     "[beams]\nshear_coefficient = 0.9",
     "shear_coefficient",
     {"only Timoshenko beams shear", "law = \"timoshenko\""}},
    {"shear_coefficient_beyond_one",
     bar,
     beams,
     "[beams]\nlaw = \"timoshenko\"\nshear_coefficient = 1.2",
     "shear_coefficient",
     {"shear_coefficient = 1.2", "out of range"}},
    {"poisson_ratio_of_a_spring",
     bar,
     beams,
     "[beams]\nlaw = \"spring\"",
     "poisson_ratio",
     {"poisson_ratio = 0.3", "a spring has no shear modulus"}},
    {"no_yield",
     bar,
     "[run]",
     with("[plasticity]"),
     "[plasticity]",
     {"yield_stress, yield_strain"}},
    {"two_yields",
     bar,
     "[run]",
     with("[plasticity]\nyield_strain = 0.002\nyield_stress = \"6 GPa\""),
     "yield_strain = 0.002",
     {"yield_stress", "yield_strain"}},
    {"negative_hardening",
     bar,
     "[run]",
     with("[plasticity]\nyield_strain = 0.002\nhardening_ratio = -0.1"),
     "hardening_ratio",
     {"hardening_ratio = -0.1", "out of range"}},
    {"yield_stress_in_metres",
     bar,
     "[run]",
     with("[plasticity]\nyield_stress = \"6 mm\""),
     "yield_stress",
     {"yield_stress = \"6 mm\""}},
    {"rupture_of_nothing",
     bar,
     "[run]",
     with("[rupture]\nminimal_bonds = 3"),
     "[rupture]",
     {"nothing says when a bond breaks", "stress or strain"}},
    {"unknown_hardening",
     bar,
     "[run]",
     with("[plasticity]\nhardening = \"vose\"\nyield_strain = 0.002"),
     "hardening",
     {"\"vose\"", "did you mean voce"}},
    {"hardening_of_another_law",
     bar,
     "[run]",
     with("[plasticity]\nhardening = \"voce\"\nyield_strain = 0.002\nhardening_ratio = 0.1"),
     "hardening_ratio",
     {"hardening_ratio"}},
    {"voce_without_saturation",
     bar,
     "[run]",
     with("[plasticity]\nhardening = \"voce\"\nyield_strain = 0.002\nplastic_scale = 0.01"),
     "[plasticity]",
     {"saturation_stress, saturation_strain"}},
    {"two_cohesions",
     bar,
     "[run]",
     with("[rupture]\nlaw = \"mohr-coulomb\"\ntensile_strain = 0.01\ncohesion_strain = 0.01\n"
          "cohesion = \"1 GPa\""),
     "cohesion_strain = 0.01",
     {"cohesion"}},
    {"zero_rupture_strain",
     bar,
     "[run]",
     with("[rupture]\nstrain = 0"),
     "strain = 0",
     {"strain = 0", "above 0"}},
    {"new_bonds_without_rupture",
     bar,
     "[run]",
     with("[contact]\nrebonding_pressure = \"1 GPa\""),
     "rebonding_pressure",
     {"no bond ever breaks", "[rupture]"}},
    {"two_stiffnesses_of_contacts",
     bar,
     "[run]",
     with("[contact]\nnormal_stiffness = \"1 N/m\"\nyoung_modulus = \"1 GPa\""),
     "normal_stiffness",
     {"the stiffness is given twice", "one of stiffness_ratio"}},
    {"restitution_of_nothing",
     bar,
     "[run]",
     with("[contact]\nrestitution = 0"),
     "restitution",
     {"above 0"}},
    {"friction_of_what_does_not_turn",
     bar,
     "[beams]\nyoung_modulus = \"3.5 TPa\"\npoisson_ratio = 0.3",
     "[contact]\nfriction = 0.1\n[beams]\nlaw = \"spring\"\nyoung_modulus = \"3.5 TPa\"",
     "friction",
     {"do not turn", "another law"}},
    {"contact_of_central_forces",
     bar,
     "[beams]\nyoung_modulus = \"3.5 TPa\"\npoisson_ratio = 0.3\nradius_ratio = 0.27",
     "[contact]\nnormal_stiffness = \"1 N/m\"\n[central_forces]\nlaw = \"piecewise\"\n"
     "stiffness = \"1 N/m\"\nattraction = \"1 N\"\nrange = 1.2",
     "[contact]",
     {"push elements apart already", "either [contact] or [central_forces]"}},
    {"new_bonds_by_scaled_offset",
     bar,
     "[run]",
     with("[plasticity]\nlaw = \"scaled-offset\"\nyield_strain = 0.002\n[rupture]\nstrain = 0.2\n"
          "[contact]\nrebonding_pressure = \"1 GPa\""),
     "[contact]",
     {"cannot be made anew", "radial-return"}},
    {"plasticity_without_beams",
     heat,
     "[run]",
     with("[plasticity]\nyield_strain = 0.002"),
     "[plasticity]",
     {"there are no beams", "[beams]"}},
};

INSTANTIATE_TEST_SUITE_P(Value, BadBeams, testing::ValuesIn(bad), row_name);

}  // namespace
}  // namespace solidem::test
