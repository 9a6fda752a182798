// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "effects/turning_grip.hpp"
#include "model/error.hpp"
#include "scene/scene_text.hpp"
#include "support/beams.hpp"

namespace solidem::test::turning_grips_test {

/// A bar along x, its left end held, its right end in a grip.
Scene scene_with(const std::string& right, double ratio = 0.2, const std::string& left = "") {
  return read_text_scene(
      "[specimen]\nshape = \"crystal\"\nlattice = \"bcc\"\ncells = [8, 3, 3]\n"
      "element_radius = \"0.1 mm\"\n[material]\ndensity = \"2790 kg/m^3\"\n"
      "[beams]\nyoung_modulus = \"3.5 TPa\"\nshear_modulus = \"1.35 TPa\"\nradius_ratio = 0.27\n" +
      left +
      "[[grips]]\nname = \"right\"\nregion = { axis = \"x\", side = \"high\", layers = 1 }\n" +
      right + "\n[run]\nsteps = 1\ntime_step_ratio = " + std::to_string(ratio) + "\n");
}
const std::string held =
    "[[grips]]\nname = \"left\"\nregion = { axis = \"x\", side = \"low\", layers = 1 }\n"
    "velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"]\n";
const std::string about_x =
    "rotation_axis = [1, 0, 0]\nrotation_point = [\"0 mm\", \"0.3 mm\", \"0.3 mm\"]";

Specimen bar() {
  return jittered("bcc", {8, 3, 3});
}

TEST(TurningGrips, ElementsStandExactlyOnTheirCircles) {
  const Scene scene = scene_with(
      "angular_velocity = \"3e6 rad/s\"\nrotation_axis = [1, 2, 2]\n"
      "rotation_point = [\"0.1 mm\", \"0 mm\", \"0.5 mm\"]\n"
      "velocity = [\"1 m/s\", \"free\", \"-2 m/s\"]",
      0.2, held);
  Simulation simulation(scene.setup, bar());
  simulation.advance(500);
  const double t = simulation.time(), angle = 3e6 * t;
  const Vector axis{1.0 / 3, 2.0 / 3, 2.0 / 3}, point{1e-4, 0, 5e-4};
  for (const std::int32_t e : simulation.find<TurningGrip>()->elements()) {
    const auto i = static_cast<std::size_t>(e);
    const Vector arm = simulation.model().specimen().position[i] - point;
    // Rodrigues' formula.
    const Vector turned = std::cos(angle) * arm + std::sin(angle) * cross(axis, arm) +
                          ((1 - std::cos(angle)) * dot(axis, arm)) * axis;
    const Vector expected = point + turned + Vector{t, 0, -2 * t};
    EXPECT_LT(norm(centre_of(simulation, i) - expected), 1e-15);
  }
}

TEST(TurningGrips, WorkOfATwistIsTheEnergyThatTheBarGains) {
  std::vector<double> error;
  for (const double ratio : {0.2, 0.1}) {
    const Scene scene = scene_with(
        "angle = { time = [\"0 ns\", \"400 ns\"], value = [\"0 rad\", \"0.04 rad\"] }\n"
        "displacement = [{ mean = \"0 mm\", amplitude = \"1e-4 mm\", frequency = \"1 MHz\" }, "
        "\"free\", \"free\"]\n" +
            about_x,
        ratio, held);
    Simulation simulation(scene.setup, bar());
    double worst = 0;
    for (int n = 0; n < 40; ++n) {
      simulation.advance(ratio == 0.2 ? 5 : 10);
      worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
    }
    error.push_back(worst / seen(simulation, "external_work"));
    EXPECT_GT(seen(simulation, "grip.right.torque"), 0);
  }
  std::printf("energy balance / work: %.2e, %.2e at half the step\n", error[0], error[1]);
  EXPECT_LT(error[0], 1e-3);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.3);
}

TEST(TurningGrips, ATorqueTurnsAFreeBodyByItsMomentOfInertia) {
  // The grip holds all of it: T = I α.
  Scene scene = scene_with("torque = \"1e-3 N m\"\n" + about_x);
  scene.setup.all<TurningGripParameters>().front().grip.region = Region{};
  Simulation simulation(scene.setup, bar());
  const Model& model = simulation.model();
  double inertia = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector& p = model.specimen().position[i];
    inertia +=
        (std::pow(p.y - 3e-4, 2) + std::pow(p.z - 3e-4, 2)) / model.data(columns::inverse_mass)[i] +
        1 / model.data(columns::inverse_inertia)[i];
  }
  simulation.advance(300);
  const double t = simulation.time(), angle = 0.5 * 1e-3 / inertia * t * t;
  EXPECT_NEAR(seen(simulation, "grip.right.angle"), angle, 1e-9 * angle);
  EXPECT_NEAR(seen(simulation, "external_work"), 1e-3 * angle, 1e-9 * 1e-3 * angle);
  EXPECT_NEAR(seen(simulation, "kinetic_energy"), 1e-3 * angle, 1e-9 * 1e-3 * angle);
}

TEST(TurningGrips, ATorqueOnABarTwistsItUntilTheBondsHoldIt) {
  const Scene scene = scene_with(
      "torque = { time = [\"0 ns\", \"60 us\"], value = [\"0 N m\", \"1e-3 N m\"] }\n" + about_x,
      0.5, held + "[damping]\nviscous = \"1e6 1/s\"\n");
  Simulation driven(scene.setup, bar());
  while (driven.time() < 30e-6) driven.advance(100);
  const double angle = seen(driven, "grip.right.angle");
  EXPECT_GT(angle, 0);
  EXPECT_NEAR(seen(driven, "energy_balance"), 0, 2e-3 * seen(driven, "external_work"));
  // Slowly loaded, it holds the torque of now and follows linearly.
  const double then = driven.time();
  while (driven.time() < 60e-6) driven.advance(100);
  EXPECT_NEAR(seen(driven, "grip.right.angle") / angle, driven.time() / then, 0.02);
}

TEST(TurningGrips, ARestartGivesTheSameBits) {
  for (const char* how : {"torque = \"1e-3 N m\"\n", "angular_velocity = \"1e5 rpm\"\n"}) {
    const Scene scene = scene_with(how + about_x, 0.2, held);
    Simulation whole(scene.setup, bar()), first(scene.setup, bar()), second(scene.setup, bar());
    whole.advance(200);
    first.advance(77);
    second.restore(77, first.save());
    second.advance(123);
    EXPECT_EQ(second.save(), whole.save());
  }
}

TEST(TurningGrips, WhatDoesNotGoTogetherIsRefused) {
  const auto refused = [](const std::string& right) {
    try {
      scene_with(right);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto says = [&](const std::string& right, const std::string& words) {
    EXPECT_NE(refused(right).find(words), std::string::npos) << refused(right);
  };
  says("angle = \"1 rad\"", "\"rotation_axis\" is missing");
  says("angle = \"1 rad\"\ntorque = \"1 N m\"\n" + about_x, "torque");
  says("angle = \"1 rad\"\nforce = [\"1 N\", \"free\", \"free\"]\n" + about_x,
       "does not go where a force pushes it");
  says("angle = \"1 rad\"\nrotation = \"free\"\n" + about_x, "turn with it");
  says(about_x, "the grip does not turn");
  says("angular_velocity = \"10 Hz\"\n" + about_x, "counts no angle");
}

TEST(TurningGrips, CentralForcesCarryOnBodiesThatAreTurnedRound) {
  const Scene scene = read_text_scene(
      "[specimen]\nshape = \"crystal\"\nlattice = \"fcc\"\ncells = [3, 3, 3]\n"
      "element_radius = \"0.1 mm\"\n[material]\ndensity = \"2790 kg/m^3\"\n"
      "[central_forces]\nlaw = \"piecewise\"\nstiffness = \"1500 kN/m\"\nattraction = \"25 N\"\n"
      "range = 1.2\ndissipation = \"0.05 N s/m\"\n"
      "[[grips]]\nname = \"right\"\nregion = { all = true }\nangle = { time = [\"0 s\", \"1 us\"], "
      "value = [\"0 rad\", \"6.283185307179586 rad\"] }\n" +
      about_x + "\n[run]\nsteps = 1\n");
  Simulation simulation(scene.setup, crystal("fcc", {3, 3, 3}));
  while (simulation.time() < 1e-6) simulation.advance(1);
  const Model& model = simulation.model();
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const double* now = model.positions()[i];
    EXPECT_LT(norm(Vector{now[0], now[1], now[2]} - model.specimen().position[i]), 1e-15);
  }
}

}  // namespace solidem::test::turning_grips_test
