// SPDX-License-Identifier: GPL-2.0-or-later
//
// Free fall, terminal velocity, decay, hanging: bodies under [gravity] and [damping].
#include <gtest/gtest.h>

#include <cmath>

#include "scene/body.hpp"
#include "scene/scene_text.hpp"

namespace solidem::test::gravity_and_damping_test {

const std::string crystal = R"toml([specimen]
shape = "crystal"
lattice = "bcc"
cells = [4, 2, 2]
element_radius = "0.1 mm"
[material]
density = "2700 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[run]
steps = 1
)toml";
const std::string gravity =
    "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n";
const std::string held = R"toml([[grips]]
name = "left"
region = { axis = "x", side = "low", layers = 1 }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
)toml";

/// Strong enough for bonds that are strained by round-off to weigh nothing beside it.
constexpr double strong = 9.81e5;
const std::string strong_gravity = replaced(gravity, "-9.81 m/s^2", "-9.81e5 m/s^2");

Simulation simulate(const std::string& text) {
  const Scene scene = read_text_scene(text);
  return Simulation(scene.setup, make_body(scene));
}

std::string at_step(const std::string& text, double step) {
  return replaced(text, "steps = 1\n",
                  "steps = 1\ntime_step = \"" + std::to_string(step * 1e9) + " ns\"\n");
}

double of(const Simulation& simulation, const std::string& name) {
  for (const auto& [key, value] : simulation.observe().values)
    if (key == name) return value;
  ADD_FAILURE() << "no " << name;
  return 0;
}

double depth(const Simulation& simulation, std::size_t i = 0) {
  return simulation.model().specimen().position[i].z - simulation.model().positions()[i][2];
}

double mass(const Simulation& simulation) {
  double sum = 0;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    sum += 1 / simulation.model().data(columns::inverse_mass)[i];
  return sum;
}

TEST(Gravity, LetsBodiesFallAndTheirEnergyIsItsWork) {
  Simulation simulation = simulate(crystal + gravity);
  simulation.advance(500);
  const double t = simulation.time(), fallen = 0.5 * 9.81 * t * t;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    EXPECT_NEAR(depth(simulation, i), fallen, 1e-15);
  const double work = of(simulation, "gravity_work");
  EXPECT_NEAR(work, mass(simulation) * 9.81 * fallen, 1e-6 * work);
  EXPECT_NEAR(of(simulation, "energy_balance"), 0, 1e-6 * work);
}

TEST(Gravity, OfAHeldBodyIsBorneByItsGrip) {
  Simulation simulation = simulate(crystal + gravity + held + "[damping]\nlocal = 0.7\n");
  simulation.advance(20000);
  const double weight = mass(simulation) * 9.81;
  EXPECT_NEAR(of(simulation, "grip.left.force_z"), weight, 1e-6 * weight);
  EXPECT_NEAR(of(simulation, "grip.left.force_x"), 0, 1e-6 * weight);
}

TEST(Gravity, AndForcesThatSetABodyInMotionPayForItFromTheFirstStep) {
  const std::string pushed =
      "[[grips]]\nname = \"right\"\nregion = { axis = \"x\", side = \"high\", layers = 1 }\n"
      "force = [\"5 N\", \"1 N\", \"free\"]\nrotation = \"free\"\n";
  for (const std::string& load : {gravity, pushed}) {
    Simulation simulation = simulate(crystal + load);
    for (int n = 0; n < 20; ++n) {
      simulation.advance(1);
      EXPECT_NO_THROW(simulation.check()) << load << n;
    }
  }
}

/// Error of the depth and of the balance of energy of a body that falls with a step, against the
/// exact motion; relative.
struct FallError {
  double depth, balance;
};
FallError fall(const std::string& damping, double rate, double effective, double step) {
  Simulation simulation = simulate(at_step(crystal + strong_gravity + damping, step));
  simulation.advance(static_cast<std::int64_t>(std::lround(2e-5 / step)));
  const double t = simulation.time();
  const double exact =
      rate > 0 ? effective / rate * (t + std::expm1(-rate * t) / rate) : 0.5 * effective * t * t;
  return {depth(simulation) / exact - 1,
          of(simulation, "energy_balance") / of(simulation, "gravity_work")};
}

TEST(Damping, ViscousLeavesTheTerminalVelocityToSecondOrder) {
  constexpr double rate = 4e5;
  const std::string damping = "[damping]\nviscous = \"4e5 1/s\"\n";
  const FallError coarse = fall(damping, rate, strong, 2e-8),
                  fine = fall(damping, rate, strong, 1e-8);
  EXPECT_LT(std::fabs(fine.depth), 1e-5);
  EXPECT_NEAR(coarse.depth / fine.depth, 4, 0.1);
  EXPECT_LT(std::fabs(fine.balance), 1e-4);
  EXPECT_NEAR(coarse.balance / fine.balance, 4, 0.4);
}

TEST(Damping, ViscousDecayOfAFreeFlightIsExactAtAnyStep) {
  const std::string flying = crystal +
                             "[[initial_velocities]]\nregion = { all = true }\n"
                             "velocity = [\"3 m/s\", \"0 m/s\", \"0 m/s\"]\n"
                             "[damping]\nviscous = \"1e7 1/s\"\n";
  Simulation simulation = simulate(flying);
  const double start = of(simulation, "kinetic_energy");
  simulation.advance(20);
  const double left = std::exp(-2 * 1e7 * simulation.time());
  EXPECT_NEAR(of(simulation, "kinetic_energy"), start * left, 1e-12 * start);
  EXPECT_NEAR(of(simulation, "viscous_damping"), start * (1 - left), 1e-12 * start);
}

TEST(Damping, LocalLeavesAFractionOfAFreeFall) {
  const FallError error = fall("[damping]\nlocal = 0.3\n", 0, 0.7 * strong, 1e-8);
  EXPECT_LT(std::fabs(error.depth), 1e-10);
  EXPECT_LT(std::fabs(error.balance), 1e-10);
}

std::string struck(const std::string& damping) {
  return crystal + held + damping +
         "[[grips]]\nname = \"right\"\nregion = { axis = \"x\", side = \"high\", layers = 1 }\n"
         "force = [\"5 N\", \"1 N\", \"free\"]\nrotation = \"free\"\n";
}

TEST(Damping, ClosesTheBalanceOfALoadedBarToSecondOrder) {
  for (const char* damping : {"[damping]\nviscous = \"2e5 1/s\"\n", "[damping]\nlocal = 0.2\n",
                              "[damping]\nviscous = \"2e5 1/s\"\nlocal = 0.2\n"}) {
    double worst[2] = {};
    for (const int k : {0, 1}) {
      Simulation simulation = simulate(at_step(struck(damping), k == 0 ? 4e-9 : 2e-9));
      double most = 0;
      for (int n = 0; n < 50; ++n) {
        simulation.advance(k == 0 ? 20 : 40);
        most = std::max(most, std::fabs(of(simulation, "external_work")));
        worst[k] = std::max(worst[k], std::fabs(of(simulation, "energy_balance")));
      }
      worst[k] /= most;
    }
    std::printf("  %s balance %.1e at 4 ns, %.1e at 2 ns\n", damping, worst[0], worst[1]);
    EXPECT_LT(worst[1], 1e-3) << damping;
    EXPECT_GT(worst[0] / worst[1], 3) << damping;
  }
}

TEST(Damping, GoesOnFromACheckpointToTheSameBits) {
  const std::string text = struck("[damping]\nviscous = \"2e5 1/s\"\nlocal = 0.2\n") + gravity;
  Simulation whole = simulate(text), first = simulate(text), second = simulate(text);
  whole.advance(300);
  first.advance(120);
  second.restore(120, first.save());
  second.advance(180);
  EXPECT_EQ(second.save(), whole.save());
}

TEST(Damping, IsRefusedWhereItMakesNoSense) {
  EXPECT_NE(complaint(crystal + "[damping]\n").find("viscous, local or bonds"), std::string::npos);
  EXPECT_NE(complaint(crystal + "[damping]\nlocal = 1.0\n").find("[damping] local"),
            std::string::npos);
}

}  // namespace solidem::test::gravity_and_damping_test
