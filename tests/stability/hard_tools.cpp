// SPDX-License-Identifier: GPL-2.0-or-later
//
// Tools where it is hard: facets thinner than an element, two that close on one, an edge to fall
// from, a blow at the speed of sound.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "effects/tools.hpp"
#include "model/error.hpp"
#include "scene/scene_text.hpp"
#include "support/beams.hpp"
#include "support/meshes.hpp"

namespace solidem::test::hard_tools_test {

Simulation simulate(const std::string& sections, Specimen specimen, double ratio = 0.1) {
  const Scene scene = read_text_scene(
      "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [1, 1, 1]\n"
      "element_radius = \"0.1 mm\"\n[material]\ndensity = \"2790 kg/m^3\"\n"
      "[beams]\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\nradius_ratio = 0.5\n" +
      sections + "\n[run]\nsteps = 1\ntime_step_ratio = " + std::to_string(ratio) + "\n");
  return Simulation(scene.setup, std::move(specimen));
}

std::string obj_of(const TriangleMesh& mesh) {
  std::string text;
  for (const Vector& v : mesh.vertices)
    text +=
        "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
  for (const auto& [a, b, c] : mesh.facets)
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
            std::to_string(c + 1) + "\n";
  return text;
}

std::string mesh_tool(const std::string& file, const std::string& more) {
  return "[[tools]]\nname = \"mesh\"\nshape = \"mesh\"\nfile = \"" + file +
         "\"\nunit = \"1 mm\"\nstiffness = \"100 kN/m\"\n" + more + "\n";
}

const std::string falls = "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-1e4 m/s^2\"]\n";

TEST(HardTools, FacetsThatAreNeedlesThinnerThanAnElementAreOnePlane) {
  // Needles of 4 mm by 4 um: the ball of 0.1 mm lies on 50 of them at once.
  TriangleMesh needles;
  for (int k = 0; k <= 1000; ++k)
    for (const double y : {-2.0, 2.0}) needles.vertices.push_back({-2 + 0.004 * k, y, 0});
  for (std::int32_t k = 0; k < 1000; ++k) {
    needles.facets.push_back({2 * k, 2 * k + 2, 2 * k + 1});
    needles.facets.push_back({2 * k + 1, 2 * k + 2, 2 * k + 3});
  }
  folder().write("needles.obj", obj_of(needles));
  const std::string contact = "friction = 0.5\nrestitution = 0.5";
  Simulation on_needles =
      simulate(mesh_tool("needles.obj", contact) + falls, string_of({{0, 0, 1.05e-4}}));
  Simulation on_plane =
      simulate("[[tools]]\nname = \"floor\"\nshape = \"plane\"\nstiffness = \"100 kN/m\"\n" +
                   contact + "\n" + falls,
               string_of({{0, 0, 1.05e-4}}));
  for (Simulation* simulation : {&on_needles, &on_plane}) {
    set_velocity(*simulation, 0, {5, 0.3, 0});
    simulation->advance(5000);
  }
  EXPECT_GT(centre_of(on_plane, 0).x, 3e-4);
  EXPECT_LT(norm(centre_of(on_needles, 0) - centre_of(on_plane, 0)), 1e-10 * hand_radius);
}

TEST(HardTools, AnElementBetweenTwoClosingToolsIsSqueezedByHalfOnEachSide) {
  const std::string plate =
      "shape = \"box\"\nsize = [\"1 mm\", \"1 mm\", \"0.2 mm\"]\nstiffness = \"100 kN/m\"\n";
  Simulation simulation = simulate(
      "[[tools]]\nname = \"low\"\n" + plate + "origin = [\"0 mm\", \"0 mm\", \"-0.2 mm\"]\n" +
          "[[tools]]\nname = \"high\"\n" + plate + "origin = [\"0 mm\", \"0 mm\", \"0.2 mm\"]\n" +
          "velocity = [\"0 m/s\", \"0 m/s\", \"-0.2 m/s\"]\n[damping]\nviscous = \"1e6 1/s\"\n",
      string_of({{0, 0, 0}}));
  // The gap closes from 0.2 mm to 0.1 mm: half of the ball.
  while (seen(simulation, "tool.high.displacement_z") > -1e-4) simulation.advance(100);
  const double overlap = -0.5 * seen(simulation, "tool.high.displacement_z");
  EXPECT_NEAR(seen(simulation, "tool.high.force_z"), 1e5 * overlap, 1e-3 * 1e5 * overlap);
  EXPECT_NEAR(seen(simulation, "tool.low.force_z"), -1e5 * overlap, 1e-3 * 1e5 * overlap);
  EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 1e-5 * seen(simulation, "external_work"));
}

TEST(HardTools, AnElementThatLeavesTheEdgeOfAMeshFallsWithItsEnergy) {
  folder().write("table.obj", obj_of(sheet_mesh(2, 8)));
  Simulation simulation =
      simulate(mesh_tool("table.obj", "friction = 0.3") + falls, string_of({{0.9e-3, 0, 1e-4}}));
  set_velocity(simulation, 0, {1, 0, 0});
  double worst = 0;
  while (centre_of(simulation, 0).z > -3e-4) {
    simulation.advance(50);
    worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
  }
  EXPECT_GT(centre_of(simulation, 0).x, 1e-3);
  EXPECT_LT(worst, 1e-4 * seen(simulation, "kinetic_energy"));
  EXPECT_TRUE(simulation.find<Tool>()->touched().empty());
}

TEST(HardTools, ABlowAtTheSpeedOfSoundIsBorneAndBalanced) {
  // Bars of aluminium carry sound at 5000 m/s.
  Simulation simulation = simulate(
      "[[tools]]\nname = \"ram\"\nshape = \"plane\"\nnormal = [1, 0, 0]\nrestitution = 0.5\n"
      "origin = [\"-0.101 mm\", \"0 mm\", \"0 mm\"]\nvelocity = [\"5000 m/s\", \"0 m/s\", \"0 "
      "m/s\"]\n",
      crystal("simple_cubic", {12, 3, 3}), 0.1);
  double worst = 0;
  for (int n = 0; n < 40; ++n) {
    simulation.advance(10);
    worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
  }
  std::printf("  balance within %.1e of the work\n", worst / seen(simulation, "external_work"));
  EXPECT_GT(seen(simulation, "external_work"), 0);
  EXPECT_LT(worst, 0.02 * seen(simulation, "external_work"));
}

TEST(HardTools, ATurningPinThatLeavesTheBodyBehindIsStillWhereItsAngleSays) {
  Simulation simulation = simulate(
      "[[tools]]\nname = \"pin\"\nshape = \"box\"\nsize = [\"0.4 mm\", \"0.1 mm\", \"1 mm\"]\n"
      "origin = [\"0.6 mm\", \"0 mm\", \"0 mm\"]\nstiffness = \"100 kN/m\"\nfriction = 0.4\n"
      "angular_velocity = \"1e9 rpm\"\nrotation_axis = [0, 0, 1]\n",
      string_of({{0, 0, 0}}));
  simulation.advance(20000);
  const double turns = seen(simulation, "tool.pin.angle") / 6.283185307179586;
  EXPECT_GT(turns, 100);
  const RigidPose pose = simulation.find<Tool>()->pose();
  const double angle = 1e9 / 60 * 6.283185307179586 * simulation.time();
  EXPECT_NEAR(rotate(pose.orientation, Vector{1, 0, 0}).x, std::cos(angle), 1e-9);
  EXPECT_NEAR(norm(pose.position - Vector{0.6e-3, 0, 0}), 0, 1e-15);
}

}  // namespace solidem::test::hard_tools_test
