// SPDX-License-Identifier: GPL-2.0-or-later
//
// [beams.anisotropy], [beams.fibres] and the [calibration] of a grain: what is read, what is
// refused.
#include <cmath>

#include "bad_scene.hpp"
#include "effects/beam_parameters.hpp"
#include "scene/body.hpp"

namespace solidem::test::anisotropy_test {

const std::string wood = R"([specimen]
shape = "box"
size = ["10 mm", "10 mm", "10 mm"]
elements = 200
periodic = [true, true, true]

[material]
density = "480 kg/m^3"

[beams]
young_modulus = "20 GPa"
poisson_ratio = 0.3
radius_ratio = 0.4

[beams.anisotropy]
grain = [3, 0, 4]
radial = [0, 2, 0]
radial_modulus = "8 GPa"
tangential_modulus = "2 GPa"
transverse_shear_modulus = "1 GPa"
exponent = 3

[beams.fibres]
reach = 1.8
alignment = 0.9
stiffness_ratio = 5

[calibration]
young_moduli = { L = "14 GPa", T = "0.7 GPa" }
shear_moduli = { RT = "0.1 GPa" }
poisson_ratios = { LT = 0.45 }
weights = { shear_moduli = 2 }
tolerance = 0.05
specimens = 2
)";

TEST(Anisotropy, IsRead) {
  const Scene scene = read_text_scene(wood);
  const Anisotropy& grain = scene.setup.get<BeamParameters>().value().anisotropy.value();
  EXPECT_DOUBLE_EQ(grain.axes.longitudinal.x, 0.6);
  EXPECT_DOUBLE_EQ(grain.axes.longitudinal.z, 0.8);
  EXPECT_EQ(grain.axes.radial.y, 1);
  EXPECT_EQ(grain.radial_modulus, 8e9);
  EXPECT_EQ(grain.tangential_modulus, 2e9);
  EXPECT_EQ(grain.transverse_shear_modulus, 1e9);
  EXPECT_EQ(grain.exponent, 3);
  const Fibres& fibres = scene.setup.get<BeamParameters>()->fibres.value();
  EXPECT_DOUBLE_EQ(fibres.rule.direction.z, 0.8);  // that of the grain
  EXPECT_EQ(fibres.rule.reach, 1.8);
  EXPECT_EQ(fibres.rule.alignment, 0.9);
  EXPECT_EQ(fibres.stiffness_ratio, 5);
  const OrthotropicRequest& request = scene.orthotropic_calibration.value();
  EXPECT_FALSE(scene.calibration);
  EXPECT_EQ(request.target[0], 14e9);
  EXPECT_FALSE(request.target[1]);
  EXPECT_EQ(request.target[2], 0.7e9);
  EXPECT_EQ(request.target[5], 0.1e9);
  EXPECT_EQ(request.target[7], 0.45);
  EXPECT_EQ(request.weight, (std::array<double, 3>{4, 2, 0.5}));
  EXPECT_EQ(request.tolerance, 0.05);
  EXPECT_EQ(request.specimens, 2);
}

TEST(Anisotropy, AcrossTheGrainAllIsAlikeUnlessARadialAxisIsGiven) {
  const Scene scene =
      read_text_scene(replaced(wood, "radial = [0, 2, 0]\nradial_modulus = \"8 GPa\"\n", ""));
  const Anisotropy& grain = scene.setup.get<BeamParameters>().value().anisotropy.value();
  EXPECT_EQ(grain.radial_modulus, grain.tangential_modulus);
  EXPECT_NEAR(dot(grain.axes.radial, grain.axes.longitudinal), 0, 1e-15);
  EXPECT_NEAR(norm(grain.axes.radial), 1, 1e-15);
}

TEST(Anisotropy, FibresAreBondsOfTheBody) {
  const Scene scene = read_text_scene(wood);
  const Specimen body = make_body(scene);
  const std::vector<Pair> contacts = bonds_in_contact(body);
  EXPECT_GT(body.bonds.size(), contacts.size() + 50);
  EXPECT_EQ(
      body.bonds.size(),
      contacts.size() + find_fibres(body, scene.setup.get<BeamParameters>()->fibres->rule).size());
}

class RefusedAnisotropy : public testing::TestWithParam<BadScene> {};
TEST_P(RefusedAnisotropy, SaysWhatWouldBeRight) {
  expect_refused(GetParam());
}

const BadScene refused[] = {
    {"no_grain", &wood, "grain = [3, 0, 4]\n", "", "[beams.anisotropy]", {"grain is missing"}},
    {"grain_of_no_length", &wood, "[3, 0, 4]", "[0, 0, 0]", "", {"no direction", "not all zero"}},
    {"grain_of_two_numbers", &wood, "[3, 0, 4]", "[3, 0]", "", {"grain", "three numbers"}},
    {"radial_along_the_grain", &wood, "[0, 2, 0]", "[1, 2, 0]", "", {"radial", "right angles"}},
    {"radial_without_modulus",
     &wood,
     "radial_modulus = \"8 GPa\"\n",
     "",
     "radial = [0, 2, 0]",
     {"radial", "both, or neither"}},
    {"modulus_without_radial",
     &wood,
     "radial = [0, 2, 0]\n",
     "",
     "radial_modulus",
     {"radial_modulus", "both, or neither"}},
    {"no_tangential_modulus",
     &wood,
     "tangential_modulus = \"2 GPa\"\n",
     "",
     "[beams.anisotropy]",
     {"tangential_modulus is missing"}},
    {"exponent_zero", &wood, "exponent = 3", "exponent = 0", "", {"exponent = 0", "above 0"}},
    {"reach_of_one", &wood, "reach = 1.8", "reach = 1", "", {"reach = 1", "above 1"}},
    {"alignment_of_one", &wood, "alignment = 0.9", "alignment = 1", "", {"alignment = 1"}},
    {"no_stiffness",
     &wood,
     "stiffness_ratio = 5",
     "stiffness_ratio = 0",
     "",
     {"stiffness_ratio = 0"}},
    {"unknown_key", &wood, "reach = 1.8", "raech = 1.8", "", {"did you mean reach?"}},
    {"shear_of_a_spring",
     &wood,
     "poisson_ratio = 0.3\n",
     "law = \"spring\"\n",
     "transverse_shear_modulus",
     {"a spring has no shear modulus"}},
    {"unknown_axis", &wood, "{ RT = ", "{ TR = ", "", {"TR", "LR, LT, RT"}},
    {"modulus_without_unit", &wood, "L = \"14 GPa\"", "L = 14", "", {"has no unit"}},
    {"mixed_targets",
     &wood,
     "tolerance = 0.05",
     "young_modulus = \"14 GPa\"",
     "",
     {"no such key in a calibration along the axes of a grain"}},
};
INSTANTIATE_TEST_SUITE_P(Scenes, RefusedAnisotropy, testing::ValuesIn(refused), row_name);

TEST(Anisotropy, FibresNeedADirection) {
  const std::size_t from = wood.find("[beams.anisotropy]"), to = wood.find("[beams.fibres]");
  std::string plain = wood.substr(0, from) + wood.substr(to);
  plain.erase(plain.find("[calibration]"));
  const std::string words = complaint(plain + "[run]\nsteps = 1\n");
  EXPECT_NE(words.find("nothing says along what"), std::string::npos) << words;
  EXPECT_EQ(
      complaint(replaced(plain, "reach", "direction = [0, 0, 1]\nreach") + "[run]\nsteps = 1\n"),
      "");
}

TEST(Anisotropy, CalibrationAlongAGrainNeedsOne) {
  const std::size_t from = wood.find("[beams.anisotropy]"), to = wood.find("[calibration]");
  const std::string words = complaint(wood.substr(0, from) + wood.substr(to));
  EXPECT_NE(words.find("the beams have no grain"), std::string::npos) << words;
}

TEST(Anisotropy, FibresShorterThanBondsAreRefused) {
  const Scene scene = read_text_scene("[bonds]\ntolerance = 0.9\n\n" + wood);
  EXPECT_THROW(make_body(scene), InputError);
}

}  // namespace solidem::test::anisotropy_test
