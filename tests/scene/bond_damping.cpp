// SPDX-License-Identifier: GPL-2.0-or-later
//
// [damping] bonds: decay of two elements, energy, momentum, the stable step, checkpoints, threads.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdio>

#include "engine/simulation.hpp"
#include "laws/constants.hpp"
#include "model/lane_vectors.hpp"
#include "scene/body.hpp"
#include "scene/scene_text.hpp"
#include "support/beams.hpp"

namespace solidem::test::bond_damping_test {

const std::string material = R"toml([material]
density = "2700 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.4
)toml";

/// Two elements of a radius of 0.1 mm that touch, with opposite velocities along an axis.
Simulation pair(double ratio, const std::string& velocity, double step) {
  const auto moving = [&](const char* side, const std::string& v) {
    return std::string("[[initial_velocities]]\nregion = { axis = \"x\", side = \"") + side +
           "\", layers = 1 }\nvelocity = " + v + "\n";
  };
  const Scene scene = read_text_scene(
      "[specimen]\nshape = \"box\"\nsize = [\"1 mm\", \"1 mm\", \"1 mm\"]\nelements = 20\n" +
      material + "[damping]\nbonds = " + std::to_string(ratio) + "\n" + moving("high", velocity) +
      "[run]\nsteps = 1\ntime_step = \"" + std::to_string(step * 1e12) + " ps\"\n");
  return Simulation(scene.setup, row_of(2));
}

double place(const Simulation& simulation, std::size_t i, std::size_t k) {
  return simulation.model().positions()[i][k];
}

double angle_z(const Simulation& simulation, std::size_t i) {
  return 2 * std::asin(place(simulation, i, 7));
}

/// Squared frequencies of a pair, 1/s²: of its tension and of its shear.
double squared_frequency(bool shear) {
  const double length = 2 * hand_radius, radius = 4e-5, young = 70e9;
  const double mass = row_of(2).domain.volume * 2700 / 2;
  const double inertia = 0.4 * mass * hand_radius * hand_radius;
  if (!shear) return young * pi * radius * radius / length * 2 / mass;
  return 12 * young * pi / 4 * std::pow(radius, 4) / length *
         (0.5 / inertia + 2 / (mass * length * length));
}

/// Largest departure from the exact decay in three turns, over the amplitude.
double error_of_decay(bool shear, double ratio, int steps_a_turn) {
  const double omega = std::sqrt(squared_frequency(shear));
  const double damped = omega * std::sqrt(1 - ratio * ratio);
  const double step = 2 * pi / omega / steps_a_turn, speed = 1e-3, length = 2 * hand_radius;
  Simulation simulation = pair(
      ratio, shear ? R"(["0 m/s", "1 mm/s", "0 m/s"])" : R"(["1 mm/s", "0 m/s", "0 m/s"])", step);
  double worst = 0;
  for (int n = 0; n < 3 * steps_a_turn; ++n) {
    simulation.advance(1);
    const double t = simulation.time();
    const double way = shear ? (place(simulation, 1, 1) - place(simulation, 0, 1)) -
                                   0.5 * length * (angle_z(simulation, 0) + angle_z(simulation, 1))
                             : place(simulation, 1, 0) - place(simulation, 0, 0) - length;
    const double exact = speed / damped * std::exp(-ratio * omega * t) * std::sin(damped * t);
    worst = std::max(worst, std::fabs(way - exact) * omega / speed);
  }
  return worst;
}

TEST(BondDamping, LetsTwoElementsDecayAsTheRatioSaysToSecondOrder) {
  for (const bool shear : {false, true})
    for (const double ratio : {0.05, 0.3}) {
      const double coarse = error_of_decay(shear, ratio, 60),
                   fine = error_of_decay(shear, ratio, 120);
      std::printf("  %s, ratio %.2f: %.1e, %.1e\n", shear ? "shear" : "tension", ratio, coarse,
                  fine);
      EXPECT_LT(fine, 5e-3);
      EXPECT_NEAR(coarse / fine, 4, 0.4);
    }
}

const std::string bar = R"toml([specimen]
shape = "box"
size = ["3 mm", "1 mm", "1 mm"]
elements = 200
[material]
density = "2700 kg/m^3"
[beams]
young_modulus = "70 GPa"
poisson_ratio = 0.3
radius_ratio = 0.5
[run]
steps = 1
)toml";
const std::string shaken =
    "[[initial_velocities]]\nregion = { axis = \"x\", side = \"high\", layers = 2 }\n"
    "velocity = [\"1 m/s\", \"-2 m/s\", \"0.5 m/s\"]\n";
const std::string pulled =
    "[[grips]]\nname = \"left\"\nregion = { axis = \"x\", side = \"low\", layers = 1 }\n"
    "velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"]\n"
    "[[grips]]\nname = \"right\"\nregion = { axis = \"x\", side = \"high\", layers = 1 }\n"
    "velocity = [{ time = [\"0 us\", \"1 us\"], value = [\"0 m/s\", \"2 m/s\"] }, \"free\", "
    "\"free\"]\n";

Simulation simulate(const std::string& text) {
  const Scene scene = read_text_scene(text);
  return Simulation(scene.setup, make_body(scene));
}

double of(const Simulation& simulation, const std::string& name) {
  return value_of(simulation.observe(), name);
}

std::string damped(double ratio) {
  return "[damping]\nbonds = " + std::to_string(ratio) + "\n";
}

TEST(BondDamping, TakesNoMomentumAndWhatItTakesOfTheEnergyIsInTheLedger) {
  Simulation simulation = simulate(bar + shaken + damped(0.1));
  const auto momentum = [&simulation] {
    Vector sum{};
    for (std::size_t i = 0; i < simulation.model().elements(); ++i)
      sum +=
          (1 / simulation.model().data(columns::inverse_mass)[i]) *
          lanes_vector(simulation.model().data(columns::velocity), Model::at(columns::velocity, i));
    return sum;
  };
  const Vector start = momentum();
  const double energy = of(simulation, "kinetic_energy");
  simulation.advance(400);
  EXPECT_NEAR(norm(momentum() - start), 0, 1e-12 * norm(start));
  EXPECT_GT(of(simulation, "bond_damping"), 0.2 * energy);
}

TEST(BondDamping, ClosesTheBalanceToSecondOrder) {
  for (const std::string& load : {shaken, pulled}) {
    double worst[2] = {};
    for (const int k : {0, 1}) {
      Simulation simulation = simulate(
          replaced(bar, "steps = 1",
                   k == 0 ? "steps = 1\ntime_step = \"2 ns\"" : "steps = 1\ntime_step = \"1 ns\"") +
          load + damped(0.1));
      double most = of(simulation, "kinetic_energy");
      for (int n = 0; n < 20; ++n) {
        simulation.advance(k == 0 ? 20 : 40);
        most = std::max(most, std::fabs(of(simulation, "external_work")));
        worst[k] = std::max(worst[k], std::fabs(of(simulation, "energy_balance")));
      }
      worst[k] /= most;
    }
    std::printf("  balance %.1e at 2 ns, %.1e at 1 ns\n", worst[0], worst[1]);
    EXPECT_LT(worst[1], 1e-3);
    EXPECT_GT(worst[0] / worst[1], 3);
  }
}

TEST(BondDamping, ShortensTheStableStepToWhereItIs) {
  for (const double ratio : {0.1, 1.0}) {
    const TimeStepChoice free = simulate(bar).time_step();
    const TimeStepChoice choice = simulate(bar + damped(ratio)).time_step();
    std::printf("  ratio %.1f: %.2e s for %.2e s\n", ratio, choice.limit, free.limit);
    EXPECT_LT(choice.limit, 0.9 * free.limit);
    EXPECT_EQ(choice.criterion, "damping of the bonds");
    for (const double part : {0.97, 1.05}) {
      const std::string step =
          "steps = 1\ntime_step = \"" + std::to_string(part * choice.limit * 1e15) + " fs\"";
      const Scene scene =
          read_text_scene(replaced(bar, "steps = 1", step) + shaken + damped(ratio));
      Simulation simulation(scene.setup, make_body(scene), true);
      const double energy = of(simulation, "kinetic_energy");
      const auto grown = [&] {
        try {
          simulation.advance(3000);
          return of(simulation, "kinetic_energy") / energy;
        } catch (const RunError&) {
          return std::numeric_limits<double>::infinity();
        }
      }();
      if (part < 1)
        EXPECT_LT(grown, 1) << ratio;
      else
        EXPECT_GT(grown, 1e3) << ratio;
    }
  }
}

TEST(BondDamping, GoesOnFromACheckpointAndOnAnyNumberOfThreadsToTheSameBits) {
  const std::string text = bar + pulled + damped(0.2);
  Simulation whole = simulate(text), first = simulate(text), second = simulate(text);
  whole.advance(100);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(3);
  first.advance(40);
  omp_set_num_threads(threads);
  second.restore(40, first.save());
  second.advance(60);
  EXPECT_EQ(second.save(), whole.save());
}

TEST(BondDamping, StandsWithFlowAndRupture) {
  const std::string torn = bar + pulled + damped(0.2) +
                           "[plasticity]\nyield_stress = \"300 MPa\"\nlaw = \"radial-return\"\n"
                           "[rupture]\nstrain = 0.01\n";
  Simulation simulation = simulate(replaced(torn, "2 m/s\"]", "60 m/s\"]"));
  simulation.advance(3000);
  EXPECT_GT(of(simulation, "broken_bonds"), 10);
  const double work = of(simulation, "external_work");
  EXPECT_LT(std::fabs(of(simulation, "energy_balance")), 5e-3 * work);
}

TEST(BondDamping, NeedsBeams) {
  const std::string said = complaint(
      "[specimen]\nshape = \"box\"\nsize = [\"1 mm\", \"1 mm\", \"1 mm\"]\nelements = 50\n"
      "[material]\ndensity = \"2700 kg/m^3\"\n[central_forces]\nlaw = \"piecewise\"\n"
      "stiffness = \"1e6 N/m\"\nattraction = \"25 N\"\nrange = 1.2\n[run]\nsteps = 1\n" +
      damped(0.1));
  EXPECT_NE(said.find("[damping] bonds"), std::string::npos) << said;
  EXPECT_NE(said.find("[beams]"), std::string::npos) << said;
}

}  // namespace solidem::test::bond_damping_test
