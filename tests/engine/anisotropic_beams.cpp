// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies in motion whose beams depend on direction and whose fibres are bonds among others.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/beam_properties.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "support/specimens.hpp"

namespace solidem::anisotropic_beams_test {

Setup grained_setup() {
  Setup setup = elastic_setup();
  Anisotropy grain;
  grain.axes = {{0.6, 0, 0.8}, {0, 1, 0}};
  grain.radial_modulus = 1.2e12;
  grain.tangential_modulus = 0.4e12;
  setup.get<BeamParameters>()->anisotropy = grain;
  setup.get<BeamParameters>()->fibres = Fibres{};
  setup.get<BeamParameters>()->fibres->rule.direction = grain.axes.longitudinal;
  return setup;
}

Specimen body_with_fibres(const Setup& setup) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {1e-3, 1e-3, 1e-3};
  recipe.elements = 150;
  Specimen specimen = make_specimen(recipe);
  if (setup.get<BeamParameters>()->fibres)
    add_fibres(specimen, setup.get<BeamParameters>()->fibres->rule);
  return specimen;
}

void set_in_motion(Setup& setup, std::int64_t steps) {
  Region half;
  half.kind = Region::Kind::face;
  half.axis = 0;
  half.high_side = true;
  half.layers = 3;
  InitialVelocity kick{};
  kick.region = half;
  kick.velocity = {3, 1, -2};
  setup.all<InitialVelocity>().push_back(kick);
  setup.run.steps = steps;
}

std::vector<double> poses_after(const Setup& setup, const Specimen& specimen) {
  Simulation simulation(setup, specimen);
  simulation.advance(simulation.steps_to_run());
  const Model& model = simulation.model();
  return {model.data(columns::pose), model.data(columns::pose) + model.size(columns::pose)};
}

TEST(AnisotropicBeams, SectionFollowsDirectionAndFibre) {
  const auto setup = grained_setup();
  const Specimen specimen = body_with_fibres(setup);
  const BeamProperties properties(*setup.get<BeamParameters>(), specimen);
  const double touching = 1.9e-4, far = 3.5e-4;
  const auto young = [&](const Vector& chord) {
    return properties.section(1e-4, 1e-4, chord).young_modulus;
  };
  EXPECT_DOUBLE_EQ(young(touching * Vector{0.6, 0, 0.8}), 3.5e12);
  EXPECT_DOUBLE_EQ(young(touching * Vector{0, -1, 0}), 1.2e12);
  EXPECT_NEAR(young(touching * Vector{-0.8, 0, 0.6}), 0.4e12, 1);
  EXPECT_DOUBLE_EQ(young(far * Vector{0.6, 0, 0.8}), 3.5e13);  // ten times, a fibre
  const BeamSection<double> across = properties.section(1e-4, 1e-4, touching * Vector{0, 1, 0});
  EXPECT_DOUBLE_EQ(across.shear_modulus / across.young_modulus, 1.35 / 3.5);
}

TEST(AnisotropicBeams, OfEqualModuliMoveLikePlainOnesToTheLastBit) {
  auto plain = elastic_setup();
  set_in_motion(plain, 200);
  auto oriented = plain;
  oriented.get<BeamParameters>()->anisotropy = Anisotropy{};
  oriented.get<BeamParameters>()->anisotropy->radial_modulus =
      oriented.get<BeamParameters>()->anisotropy->tangential_modulus =
          plain.get<BeamParameters>()->young_modulus;
  const Specimen specimen = body_with_fibres(plain);
  EXPECT_EQ(poses_after(plain, specimen), poses_after(oriented, specimen));
}

TEST(AnisotropicBeams, KeepEnergyAndMomentum) {
  auto setup = grained_setup();
  set_in_motion(setup, 2000);
  setup.run.time_step_ratio = 0.05;
  Simulation simulation(setup, body_with_fibres(setup));
  Observation start, end;
  simulation.observe(start);
  simulation.advance(simulation.steps_to_run());
  simulation.observe(end);
  const double before = start.motion.kinetic_energy;
  EXPECT_GT(end.energies.of("elastic_energy"), 0.1 * before);
  EXPECT_NEAR(end.motion.kinetic_energy + end.energies.of("elastic_energy"), before, 2e-4 * before);
}

TEST(AnisotropicBeams, HeatDoesNotPassAlongFibres) {
  auto warm = grained_setup();
  warm.get<ConductionParameters>() = ConductionParameters{};
  warm.get<ConductionParameters>()->initial_temperature = 298;
  warm.run.steps = 1;
  const Specimen body = body_with_fibres(warm);
  const Simulation simulation(warm, body);
  EXPECT_EQ(simulation.model().conductors().pairs(), bonds_in_contact(body));
  EXPECT_EQ(simulation.model().slots().pairs(), body.bonds);
}

}  // namespace solidem::anisotropic_beams_test
