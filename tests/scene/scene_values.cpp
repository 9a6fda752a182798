// SPDX-License-Identifier: GPL-2.0-or-later
//
// Good scenes: every value arrives in its place, in SI units.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "scene_text.hpp"

namespace solidem::test::scene_values_test {

using AxisKind = AxisControl::Kind;
using RegionKind = Region::Kind;

TEST(Scene, SpecimenAndBonds) {
  const Scene bar = read_text_scene(bar_scene);
  EXPECT_EQ(bar.title, "a bar");
  EXPECT_EQ(bar.path, folder().file("scene.toml"));
  EXPECT_EQ(bar.specimen.shape, "box");
  EXPECT_EQ(bar.specimen.size.x, 5e-3);
  EXPECT_EQ(bar.specimen.size.y, 3e-3);
  EXPECT_EQ(bar.specimen.size.z, 2e-3);
  EXPECT_EQ(bar.specimen.elements, 1000);
  EXPECT_EQ(bar.bond_tolerance, 0.05);

  const Scene cylinder = read_text_scene(heat_scene);
  EXPECT_EQ(cylinder.title, "scene");
  EXPECT_EQ(cylinder.specimen.length, 2e-3);
  EXPECT_EQ(cylinder.specimen.radius, 1e-4);
  EXPECT_EQ(cylinder.specimen.elements, 0);
  EXPECT_EQ(cylinder.specimen.mean_radius, 9e-6);
  EXPECT_EQ(cylinder.specimen.seed, 7U);
  EXPECT_EQ(cylinder.specimen.radius_spread, 0.1);
  EXPECT_EQ(cylinder.specimen.axis, "y");
  EXPECT_EQ(cylinder.specimen.periodic, (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(cylinder.specimen.origin.x, 1e-3);
  EXPECT_EQ(cylinder.specimen.origin.z, -1e-3);
  EXPECT_FALSE(cylinder.bond_tolerance.has_value());
}

TEST(Scene, OtherShapes) {
  const std::string box = "shape = \"box\"\nsize = [\"5 mm\", \"3 mm\", \"2 mm\"]\n";
  const SpecimenRecipe plate =
      read_text_scene(replaced(bar_scene, box,
                               "shape = \"plate\"\nlength = \"50 mm\"\nwidth = \"30 mm\"\n"
                               "thickness = \"2 mm\"\n"))
          .specimen;
  EXPECT_EQ(plate.size.x, 50e-3);
  EXPECT_EQ(plate.size.y, 30e-3);
  EXPECT_EQ(plate.size.z, 2e-3);
  const SpecimenRecipe crystal =
      read_text_scene(replaced(bar_scene, box + "elements = 1000\n",
                               "shape = \"crystal\"\nlattice = \"fcc\"\ncells = [1, 2, 3]\n"
                               "element_radius = \"0.1 mm\"\n"))
          .specimen;
  const SpecimenRecipe wedge =
      read_text_scene(replaced(bar_scene, box,
                               "shape = \"wedge\"\nlength = \"3 mm\"\ninner_radius = \"1 mm\"\n"
                               "outer_radius = \"2 mm\"\nangle = \"90 degree\"\naxis = \"z\"\n"))
          .specimen;
  EXPECT_EQ(wedge.length, 3e-3);
  EXPECT_EQ(wedge.inner_radius, 1e-3);
  EXPECT_EQ(wedge.radius, 2e-3);
  EXPECT_DOUBLE_EQ(wedge.angle, 2 * std::atan(1.0));
  EXPECT_EQ(wedge.axis, "z");
  EXPECT_EQ(crystal.lattice, "fcc");
  EXPECT_EQ(crystal.cells, (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(crystal.element_radius, 1e-4);
}

TEST(Scene, MaterialsKeepOnlyWhatAnEffectNeeds) {
  const std::string thermal = "density = \"2790 kg/m^3\"\nconductivity = \"134 W/(m K)\"\n";
  const Scene bar = read_text_scene(replaced(bar_scene, "density = \"2790 kg/m^3\"\n", thermal));
  ASSERT_EQ(bar.setup.materials.size(), 1U);
  EXPECT_EQ(bar.setup.materials[0].density, 2790);
  EXPECT_EQ(bar.setup.materials[0].conductivity(298), 0);
  EXPECT_EQ(bar.setup.materials[0].region.kind, RegionKind::all);

  const Material heat = read_text_scene(heat_scene).setup.materials.at(0);
  EXPECT_EQ(heat.density, 2790);
  EXPECT_EQ(heat.specific_heat(298), 880);
  EXPECT_EQ(heat.conductivity(298), 134);
}

TEST(Scene, SeveralMaterials) {
  const Scene scene =
      read_text_scene(replaced(bar_scene, "[material]\ndensity = \"2790 kg/m^3\"\n",
                               "[[material]]\nregion = { set = \"left\" }\ndensity = \"1 kg/m^3\"\n"
                               "[[material]]\nregion = { upper = [\"any\", \"2 mm\", \"any\"] }\n"
                               "density = \"2 kg/m^3\"\n"));
  ASSERT_EQ(scene.setup.materials.size(), 2U);
  EXPECT_EQ(scene.setup.materials[0].region.kind, RegionKind::face);
  EXPECT_EQ(scene.setup.materials[1].region.kind, RegionKind::box);
  EXPECT_EQ(scene.setup.materials[1].region.upper.y, 2e-3);
  EXPECT_EQ(scene.setup.materials[1].region.upper.x, Region::infinity);
  EXPECT_EQ(scene.setup.materials[1].region.lower.y, -Region::infinity);
}

TEST(Scene, EffectsAreTheOnesNamed) {
  const auto bar = read_text_scene(bar_scene).setup;
  ASSERT_TRUE(bar.get<BeamParameters>().has_value());
  EXPECT_FALSE(bar.get<ConductionParameters>().has_value());
  EXPECT_EQ(bar.get<BeamParameters>()->young_modulus, 3.5e12);
  EXPECT_DOUBLE_EQ(bar.get<BeamParameters>()->shear_modulus, 3.5e12 / 2.6);
  EXPECT_EQ(bar.get<BeamParameters>()->radius_ratio, 0.27);
  EXPECT_EQ(bar.get<BeamParameters>()->radius_from, BeamParameters::RadiusFrom::mean);

  const auto heat = read_text_scene(heat_scene).setup;
  EXPECT_FALSE(heat.get<BeamParameters>().has_value());
  ASSERT_TRUE(heat.get<ConductionParameters>().has_value());
  EXPECT_DOUBLE_EQ(heat.get<ConductionParameters>()->initial_temperature, 298.15);
}

TEST(Scene, ShearModulusInsteadOfPoissonRatio) {
  const std::string scene = replaced(bar_scene, "poisson_ratio = 0.3",
                                     "shear_modulus = \"1 TPa\"\nradius_from = \"pair\"");
  const BeamParameters beams = *read_text_scene(scene).setup.get<BeamParameters>();
  EXPECT_EQ(beams.shear_modulus, 1e12);
  EXPECT_EQ(beams.radius_from, BeamParameters::RadiusFrom::pair);
}

TEST(Scene, GripsAndRegions) {
  const std::vector<GripParameters> grips = read_text_scene(bar_scene).setup.all<GripParameters>();
  ASSERT_EQ(grips.size(), 2U);
  EXPECT_EQ(grips[0].name, "left");
  EXPECT_EQ(grips[0].region.kind, RegionKind::face);
  EXPECT_FALSE(grips[0].region.high_side);
  EXPECT_EQ(grips[0].region.depth, 0.3e-3);
  EXPECT_TRUE(grips[0].rotation_fixed);
  EXPECT_TRUE(grips[1].region.high_side);
  EXPECT_EQ(grips[1].region.layers, 1.5);
  EXPECT_FALSE(grips[1].rotation_fixed);
  EXPECT_EQ(grips[1].axis[0].kind, AxisKind::velocity);
  EXPECT_EQ(grips[1].axis[1].kind, AxisKind::force);
  EXPECT_EQ(grips[1].axis[2].kind, AxisKind::free);
}

TEST(Scene, FunctionsOfTime) {
  const std::vector<GripParameters> grips = read_text_scene(bar_scene).setup.all<GripParameters>();
  const TimeFunction& ramp = grips.at(1).axis[0].function;
  EXPECT_EQ(ramp(-1), 0);
  EXPECT_DOUBLE_EQ(ramp(0.5e-3), 1);
  EXPECT_EQ(ramp(1), 2);
  const TimeFunction& sine = grips.at(1).axis[1].function;
  EXPECT_DOUBLE_EQ(sine(0), 7);  // a phase of 90° begins at the crest
  EXPECT_DOUBLE_EQ(sine(0.01), 3);
  const TimeFunction constant = grips.at(0).axis[0].function;
  EXPECT_EQ(constant(0), 0);
  EXPECT_EQ(constant(1), 0);
}

TEST(Scene, TemperaturesAsFunctionsOfTime) {
  const std::string ramp = "value = { time = [\"0 s\", \"1 s\"], value = [\"0 °C\", \"100 °C\"] }";
  const Scene scene = read_text_scene(replaced(heat_scene, "value = \"798 K\"", ramp));
  EXPECT_DOUBLE_EQ(scene.setup.all<ImposedTemperatureParameters>().at(0).temperature(0.5), 323.15);
  const std::string sine =
      "value = { mean = \"20 °C\", amplitude = \"10 K\", frequency = \"1 Hz\" }";
  const Scene swing = read_text_scene(replaced(heat_scene, "value = \"798 K\"", sine));
  EXPECT_DOUBLE_EQ(swing.setup.all<ImposedTemperatureParameters>().at(0).temperature(0.25), 303.15);
}

TEST(Scene, ObservationRunAndOutput) {
  const auto bar = read_text_scene(bar_scene).setup;
  EXPECT_EQ(bar.all<InitialVelocity>().at(0).velocity.z, -3.3e-3);
  EXPECT_EQ(bar.all<InitialVelocity>().at(0).region.lower.x, 1e-3);
  EXPECT_EQ(bar.sensors.at(0).quantity, Sensor::Quantity::displacement);
  EXPECT_EQ(bar.sensors.at(0).point.y, -2e-3);
  EXPECT_EQ(bar.gauge->axis, 0);
  EXPECT_EQ(bar.gauge->lower, 1.5e-3);
  EXPECT_EQ(bar.run.duration, 1e-3);
  EXPECT_EQ(bar.run.time_step_ratio, 0.2);
  EXPECT_EQ(bar.run.observe_every, 10);
  EXPECT_FALSE(bar.run.steps || bar.run.time_step);
  EXPECT_EQ(bar.output.frames, 20);
  EXPECT_EQ(bar.output.checkpoint_every, 1000);

  const auto heat = read_text_scene(heat_scene).setup;
  EXPECT_EQ(heat.run.steps, 100);
  EXPECT_EQ(heat.run.time_step, 1e-9);
  EXPECT_FALSE(heat.run.duration || heat.run.time_step_ratio || heat.run.observe_every);
  EXPECT_EQ(heat.output.frames, 10);
  EXPECT_EQ(heat.output.checkpoint_every, 0);
}

TEST(Scene, SharesAsPercent) {
  const Scene scene = read_text_scene(replaced(bar_scene, "= 0.27", "= \"27 %\""));
  EXPECT_EQ(scene.setup.get<BeamParameters>()->radius_ratio, 0.27);
}

TEST(Scene, SpecimenFileLiesBesideTheScene) {
  folder().write("bar.h5", "content");
  const std::string from_file =
      replaced(replaced(bar_scene,
                        "shape = \"box\"\nsize = [\"5 mm\", \"3 mm\", \"2 mm\"]\nelements = 1000\n",
                        "file = \"bar.h5\"\n"),
               "left = { axis = \"x\", side = \"low\", depth = \"0.3 mm\" }", "");
  const Scene scene = read_text_scene(from_file);
  EXPECT_EQ(scene.specimen.file, folder().file("bar.h5"));
  // The scene has no set "left"; that of the file is meant.
  EXPECT_EQ(scene.setup.all<GripParameters>().at(0).region.kind, RegionKind::set);
  EXPECT_EQ(scene.setup.all<GripParameters>().at(0).region.set, "left");
}

TEST(Scene, RecipeAloneIsAScene) {
  const Scene scene = read_text_scene(
      "[specimen]\nshape = \"box\"\n"
      "size = [\"1 mm\", \"1 mm\", \"1 mm\"]\nelements = 10\n");
  EXPECT_TRUE(scene.setup.materials.empty());
  EXPECT_EQ(scene.specimen.radius_spread, 0.125);
  EXPECT_EQ(scene.specimen.seed, 1U);
}

TEST(Scene, EveryExampleReads) {
  int examples = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(SOLIDEM_SOURCE_DIR "/docs/examples")) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_NO_THROW(read_scene(entry.path().string())) << entry.path();
    ++examples;
  }
  EXPECT_GE(examples, 5);
}

TEST(Scene, TheExampleOfTheReferencePageReads) {
  const std::string page = file_text(SOLIDEM_SOURCE_DIR "/docs/scene.md");
  const std::size_t begin = page.find("```toml\n"), end = page.find("\n```", begin + 8);
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  EXPECT_EQ(complaint(page.substr(begin + 8, end - begin - 8)), "");
}

TEST(Scene, laws_of_bonds_take_parameters_as_numbers_and_as_stresses) {
  const std::string beams =
      "[beams]\nyoung_modulus = \"2 TPa\"\npoisson_ratio = 0.3\nradius_ratio = 0.3\n";
  std::string text = bar_scene;
  const auto from = text.find("[beams]"), to = text.find("\n[", from + 1);
  text.replace(from, to + 1 - from,
               beams +
                   "[plasticity]\nlaw = \"scaled-offset\"\nhardening = \"voce\"\n"
                   "yield_stress = \"4 GPa\"\nsaturation_strain = 0.003\nplastic_scale = 0.01\n"
                   "[rupture]\nlaw = \"mohr-coulomb\"\ntensile_strength = \"6 GPa\"\n"
                   "cohesion_strain = 0.004\nminimal_bonds = 2\n");
  const Scene scene = read_text_scene(text);
  const auto& voce = std::get<VoceHardening>(scene.setup.get<PlasticityParameters>()->hardening);
  EXPECT_EQ(scene.setup.get<PlasticityParameters>()->law, FlowRule::scaled_offset);
  EXPECT_DOUBLE_EQ(voce.yield_strain, 0.002);
  EXPECT_DOUBLE_EQ(voce.saturation_strain, 0.003);
  EXPECT_DOUBLE_EQ(voce.plastic_scale, 0.01);
  const auto& law = std::get<MohrCoulombRupture>(scene.setup.get<RuptureParameters>()->law);
  EXPECT_DOUBLE_EQ(law.tensile_strain, 0.003);
  EXPECT_DOUBLE_EQ(law.cohesion_strain, 0.004);
  EXPECT_DOUBLE_EQ(law.friction_coefficient, 0);
  EXPECT_EQ(scene.setup.get<RuptureParameters>()->minimal_bonds, 2);
}

}  // namespace solidem::test::scene_values_test
