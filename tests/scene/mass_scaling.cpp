// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies under [mass_scaling]: longer steps, true weights, and results that stand while little
// moves.
#include <gtest/gtest.h>

#include <cmath>

#include "scene/body.hpp"
#include "scene/scene_text.hpp"

namespace solidem::test::mass_scaling_test {

const std::string crystal = R"toml([specimen]
shape = "crystal"
lattice = "bcc"
cells = [8, 3, 3]
element_radius = "0.1 mm"
[material]
density = "2700 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
)toml";
/// From rest to rest.
const std::string pull = R"toml([run]
duration = "100 us"
[[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1 }
velocity = [{ time = ["0 us", "50 us", "100 us"], value = ["0 m/s", "0.2 m/s", "0 m/s"] }, "free", "free"]
)toml";

std::string heavier(double factor) {
  return factor > 1 ? "[mass_scaling]\nfactor = " + std::to_string(factor) + "\n" : "";
}

Simulation simulate(const std::string& text) {
  const Scene scene = read_text_scene(text);
  return Simulation(scene.setup, make_body(scene));
}

double of(const Simulation& simulation, const std::string& name) {
  for (const auto& [key, value] : simulation.observe().values)
    if (key == name) return value;
  ADD_FAILURE() << "no " << name;
  return 0;
}

TEST(MassScaling, LengthensTheStepByItsRoot) {
  const Simulation as_it_is = simulate(crystal + pull);
  const Simulation heavy = simulate(crystal + pull + heavier(100));
  EXPECT_NEAR(heavy.time_step().value / as_it_is.time_step().value, 10, 1e-9);
  EXPECT_NEAR(heavy.time_step().limit / as_it_is.time_step().limit, 10, 1e-9);
}

TEST(MassScaling, LeavesASlowPullAsItIsWhileKineticEnergyIsSmallBesideTheWork) {
  const auto force = [](double factor) {
    Simulation simulation = simulate(crystal + pull + heavier(factor));
    // In the middle, where it moves fastest.
    simulation.advance(simulation.steps_to_run() / 2);
    if (factor > 1) {
      EXPECT_NEAR(of(simulation, "kinetic_over_work"),
                  of(simulation, "kinetic_energy") / of(simulation, "external_work"), 1e-12);
      EXPECT_LT(of(simulation, "kinetic_over_work"), 0.01);
    }
    simulation.advance(simulation.steps_to_run() - simulation.step());
    EXPECT_NEAR(of(simulation, "energy_balance"), 0, 1e-5 * of(simulation, "external_work"));
    return of(simulation, "grip.right.force_x");
  };
  const double still = force(1), heavy = force(4), heavier_still = force(9);
  std::printf("force %.6g N; mass times 4, 9: %.2e, %.2e off\n", still, heavy / still - 1,
              heavier_still / still - 1);
  EXPECT_NEAR(heavy, still, 0.01 * still);
  EXPECT_NEAR(heavier_still, still, 0.01 * still);
}

TEST(MassScaling, LeavesWeights) {
  const std::string weight =
      "[run]\nsteps = 100\n"
      "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81e5 m/s^2\"]\n";
  for (const double factor : {4.0, 100.0}) {
    Simulation simulation = simulate(crystal + weight + heavier(factor));
    simulation.advance(100);
    const double t = simulation.time(), fallen = 0.5 * 9.81e5 / factor * t * t;
    EXPECT_NEAR(simulation.model().specimen().position[0].z - simulation.model().positions()[0][2],
                fallen, 1e-9 * fallen);
  }
}

TEST(MassScaling, BelowTheTrueMassIsRefused) {
  EXPECT_NE(complaint(crystal + pull + "[mass_scaling]\nfactor = 0.5\n").find("factor"),
            std::string::npos);
}

}  // namespace solidem::test::mass_scaling_test
