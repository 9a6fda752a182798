// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rigid tools against exact motions: what bounces, slides, rolls, is pushed and is carried along.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <fstream>
#include <numeric>

#include "effects/tools.hpp"
#include "laws/constants.hpp"
#include "model/error.hpp"
#include "scene/scene_text.hpp"
#include "support/beams.hpp"
#include "support/meshes.hpp"

namespace solidem::test::tools_test {

/// A scene whose specimen is made by hand; `law`: "spring" for elements that do not turn.
Setup setup_with(const std::string& sections, const std::string& run = "time_step_ratio = 0.1",
                 const std::string& law = "euler-bernoulli") {
  return read_text_scene(
             "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [1, 1, 1]\n"
             "element_radius = \"0.1 mm\"\n[material]\ndensity = \"2790 kg/m^3\"\n"
             "[beams]\nyoung_modulus = \"70 GPa\"\nradius_ratio = 0.5\nlaw = \"" +
             law + "\"\n" + (law == "spring" ? "" : "poisson_ratio = 0.3\n") + sections +
             "\n[run]\nsteps = 1\n" + run + "\n")
      .setup;
}

/// One ball of a radius of 0.1 mm, the height of its centre over the plane z = 0 in radii.
Specimen ball(double height = 1) {
  return string_of({{0, 0, height * hand_radius}});
}

const std::string floor_of(const std::string& contact) {
  return "[[tools]]\nname = \"floor\"\nshape = \"plane\"\nstiffness = \"100 kN/m\"\n" + contact +
         "\n";
}

Vector velocity_of(const Simulation& simulation, std::size_t element) {
  Observation seen;
  simulation.observe(seen);
  return seen.motion.velocity[element];
}
Vector spin_of(const Simulation& simulation, std::size_t element) {
  Observation seen;
  simulation.observe(seen);
  return seen.motion.angular_velocity[element];
}

double speed_after_bounce(double restitution, double ratio) {
  const auto setup = setup_with(floor_of("restitution = " + std::to_string(restitution)),
                                "time_step_ratio = " + std::to_string(ratio));
  Simulation simulation(setup, ball(1.001));
  set_velocity(simulation, 0, {0, 0, -1});
  while (velocity_of(simulation, 0).z <= 0 || centre_of(simulation, 0).z < 1.0005 * hand_radius)
    simulation.advance(1);
  return velocity_of(simulation, 0).z;
}

TEST(Tools, ABallBouncesWithItsCoefficientOfRestitutionToSecondOrder) {
  for (const double e : {1.0, 0.8, 0.3}) {
    const double coarse = std::fabs(speed_after_bounce(e, 0.1) - e);
    const double fine = std::fabs(speed_after_bounce(e, 0.025) - e);
    std::printf("restitution %.1f: error %.1e, %.1e at a quarter of the step\n", e, coarse, fine);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_LT(fine, 5e-4);
  }
}

TEST(Tools, ABallThatSlidesRollsInTheEndAtFiveSeventhsOfItsSpeed) {
  constexpr double mu = 0.5, g = 1e3, v = 1;
  const auto setup =
      setup_with(floor_of("friction = 0.5\nrestitution = 0.1") +
                 "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-1e3 m/s^2\"]");
  Simulation simulation(setup, ball());
  set_velocity(simulation, 0, {v, 0, 0});
  const double rolls_at = 2 * v / (7 * mu * g);
  // Before, speed falls by μ g.
  while (simulation.time() < 0.8 * rolls_at) simulation.advance(1);
  EXPECT_NEAR(velocity_of(simulation, 0).x, v - mu * g * simulation.time(), 2e-3);
  double slid_until = 0;
  while (simulation.time() < 2 * rolls_at) {
    simulation.advance(1);
    const double slip = velocity_of(simulation, 0).x - hand_radius * spin_of(simulation, 0).y;
    if (slip > 2e-3 * v) slid_until = simulation.time();
  }
  EXPECT_NEAR(slid_until, rolls_at, 5e-3 * rolls_at);
  EXPECT_NEAR(velocity_of(simulation, 0).x, 5.0 / 7 * v, 4e-4);
  EXPECT_NEAR(hand_radius * spin_of(simulation, 0).y, 5.0 / 7 * v, 1e-3);
  const double m = 1 / simulation.model().data(columns::inverse_mass)[0];
  EXPECT_NEAR(seen(simulation, "friction"), m * v * v / 7, 2e-3 * m * v * v);
}

/// Acceleration down an incline of tan θ = 0.3 over g.
double acceleration_on_incline(double friction, const std::string& law) {
  const double theta = std::atan(0.3), g = 1e4;
  const auto setup = setup_with(
      floor_of("friction = " + std::to_string(friction) + "\nrestitution = 0.1") +
          "[gravity]\nacceleration = [\"" + std::to_string(g * std::sin(theta)) +
          " m/s^2\", \"0 m/s^2\", \"" + std::to_string(-g * std::cos(theta)) + " m/s^2\"]",
      "time_step_ratio = 0.1", law);
  Simulation simulation(setup, ball());
  simulation.advance(400);
  const double v = velocity_of(simulation, 0).x, t = simulation.time();
  simulation.advance(1600);
  return (velocity_of(simulation, 0).x - v) / (simulation.time() - t) / g;
}

TEST(Tools, ABlockSlidesOnAnInclineThatIsSteeperThanItsFriction) {
  const double theta = std::atan(0.3);
  EXPECT_NEAR(acceleration_on_incline(0.2, "spring"), std::sin(theta) - 0.2 * std::cos(theta),
              2e-4);
  EXPECT_NEAR(acceleration_on_incline(0.31, "spring"), 0, 2e-3);
}

TEST(Tools, ABallRollsDownAnInclineOrSlidesWhereFrictionIsTooLow) {
  const double theta = std::atan(0.3);
  EXPECT_NEAR(acceleration_on_incline(0.2, "euler-bernoulli"), 5.0 / 7 * std::sin(theta), 2e-3);
  EXPECT_NEAR(acceleration_on_incline(0.05, "euler-bernoulli"),
              std::sin(theta) - 0.05 * std::cos(theta), 2e-4);
}

/// Where a ball that is thrown on a floor stands, moves and spins after bouncing and rolling.
std::vector<double> thrown_on(const std::string& floor) {
  const auto setup = setup_with(
      "[[tools]]\nname = \"floor\"\nstiffness = \"100 kN/m\"\n"
      "friction = 0.4\nrestitution = 0.6\n" +
      floor + "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-3e4 m/s^2\"]");
  Simulation simulation(setup, ball(1.1));
  set_velocity(simulation, 0, {3, 1.7, -1});
  set_spin(simulation, 0, {2e3, -5e3, 9e3});
  std::vector<double> state;
  for (int n = 0; n < 20; ++n) {
    simulation.advance(200);
    const Vector x = centre_of(simulation, 0), v = velocity_of(simulation, 0),
                 w = hand_radius * spin_of(simulation, 0);
    state.insert(state.end(), {x.x / hand_radius, x.y / hand_radius, x.z / hand_radius, v.x, v.y,
                               v.z, w.x, w.y, w.z});
  }
  return state;
}

void write_stl(const std::string& path, const TriangleMesh& mesh) {
  std::ofstream file(path);
  file.precision(17);
  file << "solid mesh\n";
  for (const Facet& facet : mesh.facets) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const std::int32_t corner : facet) {
      const Vector& v = mesh.vertices[static_cast<std::size_t>(corner)];
      file << "vertex " << v.x << ' ' << v.y << ' ' << v.z << '\n';
    }
    file << "endloop\nendfacet\n";
  }
  file << "endsolid mesh\n";
}

TEST(Tools, AFloorOfFacetsIsThePlaneToRoundOffWhateverIsRolledOver) {
  const std::vector<double> plane = thrown_on("shape = \"plane\"\n");
  // Facets of the size of the ball: dozens of edges and vertices are crossed.
  write_stl(folder().file("floor.stl"), sheet_mesh(6, 60));
  const std::vector<double> mesh =
      thrown_on("shape = \"mesh\"\nfile = \"floor.stl\"\nunit = \"1 mm\"\n");
  double crossed = plane[plane.size() - 9];
  EXPECT_GT(crossed, 3);
  for (std::size_t k = 0; k < plane.size(); ++k) EXPECT_NEAR(mesh[k], plane[k], 1e-10) << k;
}

Specimen block() {
  return jittered("bcc", {6, 6, 6}, 0.05);
}

/// The block that a moving platen presses, turning and with friction, against a floor.
Setup pressed_setup(double ratio) {
  double low = 1, high = -1;
  const Specimen body = block();
  for (std::size_t i = 0; i < body.size(); ++i) {
    low = std::min(low, body.position[i].z - body.radius[i]);
    high = std::max(high, body.position[i].z + body.radius[i]);
  }
  const auto at = [](double z) {
    return "origin = [\"0.5 mm\", \"0.5 mm\", \"" + std::to_string(1e3 * z) + " mm\"]\n";
  };
  return setup_with(
      "[[tools]]\nname = \"floor\"\nshape = \"plane\"\n" + at(low - 1e-6) +
          "friction = 0.3\nrestitution = 0.5\n"
          "[[tools]]\nname = \"platen\"\nshape = \"box\"\n"
          "size = [\"4 mm\", \"4 mm\", \"0.2 mm\"]\n" +
          at(high + 0.101e-3) +
          "friction = 0.2\nrestitution = 0.7\n"
          "velocity = [\"3 m/s\", \"-1 m/s\", { mean = \"-10 m/s\", amplitude = \"9 m/s\", "
          "frequency = \"100 kHz\" }]\n"
          "angular_velocity = \"2000 rad/s\"\nrotation_axis = [0, 0, 1]\n",
      "time_step_ratio = " + std::to_string(ratio));
}

TEST(Tools, WorkOfToolsIsWhatTheBodyGainsToSecondOrder) {
  std::vector<double> error;
  for (const double ratio : {0.1, 0.05}) {
    const auto setup = pressed_setup(ratio);
    Simulation simulation(setup, block());
    double worst = 0;
    for (int n = 0; n < 40; ++n) {
      simulation.advance(ratio == 0.1 ? 40 : 80);
      worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
    }
    EXPECT_GT(seen(simulation, "friction"), 0);
    EXPECT_GT(seen(simulation, "contact_damping"), 0);
    error.push_back(worst / std::fabs(seen(simulation, "external_work")));
  }
  std::printf("energy balance / work: %.2e, %.2e at half the step\n", error[0], error[1]);
  EXPECT_LT(error[0], 1e-4);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.6);
}

std::map<std::string, std::vector<double>> end_of(Simulation& simulation, int steps) {
  simulation.advance(steps);
  return simulation.save();
}

TEST(Tools, ARestartAndAnyNumberOfThreadsGiveTheSameBits) {
  const auto setup = pressed_setup(0.1);
  Simulation whole(setup, block());
  const auto expected = end_of(whole, 400);
  EXPECT_FALSE(whole.find<Tool>()->touched().empty());
  Simulation first(setup, block()), second(setup, block());
  second.restore(177, end_of(first, 177));
  EXPECT_EQ(end_of(second, 400 - 177), expected);
  const int before = omp_get_max_threads();
  for (const int threads : {2, 3}) {
    omp_set_num_threads(threads);
    Simulation parallel(setup, block());
    EXPECT_EQ(end_of(parallel, 400), expected) << threads;
  }
  omp_set_num_threads(before);
}

TEST(Tools, ForcesOfAToolAndOfWhatItTouchesAreOpposite) {
  const auto setup = pressed_setup(0.1);
  Simulation simulation(setup, block());
  simulation.advance(400);
  const Vector before = momenta_of(simulation).linear;
  const double dt = simulation.time_step().value;
  Vector impulse{};
  const auto add_half_a_step = [&] {
    for (const char* tool : {"floor", "platen"})
      for (int k = 0; k < 3; ++k)
        component(impulse, k) -=
            0.5 * dt * seen(simulation, std::string("tool.") + tool + ".force_" + "xyz"[k]);
  };
  for (int n = 0; n < 50; ++n) {
    add_half_a_step();
    simulation.advance(1);
    add_half_a_step();
  }
  EXPECT_GT(norm(impulse), 0);
  EXPECT_LT(norm(momenta_of(simulation).linear - before - impulse), 1e-10 * norm(impulse));
}

TEST(Tools, ADrivenToolAndABallExchangeMomentumAndEnergy) {
  const auto setup = setup_with(
      "[[tools]]\nname = \"ram\"\nshape = \"sphere\"\nradius = \"1 mm\"\n"
      "origin = [\"0 mm\", \"0 mm\", \"1.3 mm\"]\nstiffness = \"100 kN/m\"\n"
      "force = \"-1e-4 N\"\nforce_axis = [0, 0, 1]\nmass = \"2e-8 kg\"\n");
  Simulation simulation(setup, ball(0));
  const double m = 1 / simulation.model().data(columns::inverse_mass)[0], M = 2e-8;
  double speed = 0;
  const double gap = 0.2e-3;
  while (velocity_of(simulation, 0).z >= 0 || seen(simulation, "tool.ram.force_z") > 0) {
    const double before = seen(simulation, "tool.ram.displacement_z");
    simulation.advance(1);
    if (seen(simulation, "tool.ram.force_z") == 0 && velocity_of(simulation, 0).z == 0)
      speed = (before - seen(simulation, "tool.ram.displacement_z")) / simulation.time_step().value;
  }
  EXPECT_NEAR(speed, std::sqrt(2 * 1e-4 / M * gap), 5e-3 * speed);
  // Elastic: the heavier ball is left with 2 M / (M + m) of the speed, and a little of the force.
  EXPECT_NEAR(-velocity_of(simulation, 0).z, 2 * M / (M + m) * speed, 5e-3 * speed);
  EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 1e-3 * seen(simulation, "external_work"));
}

TEST(Tools, ATurningDiscSpinsABallAndItsTorqueDoesTheWork) {
  const auto setup = setup_with(
      floor_of("friction = 0.5\nrestitution = 0.2\nangular_velocity = \"20000 rad/s\"\n"
               "rotation_axis = [0, 0, 1]\nrotation_point = [\"1 mm\", \"0 mm\", \"0 mm\"]") +
      "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-1e5 m/s^2\"]");
  Simulation simulation(setup, ball());
  double worst = 0;
  for (int n = 0; n < 20; ++n) {
    simulation.advance(10);
    worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
  }
  // The floor moves by ω R = −20 m/s along y under the ball, which it drags along.
  EXPECT_LT(velocity_of(simulation, 0).y, -0.1);
  EXPECT_LT(spin_of(simulation, 0).x, 0);  // its bottom goes along
  EXPECT_GT(std::fabs(seen(simulation, "tool.floor.torque_z")), 0);
  EXPECT_LT(worst, 1e-4 * seen(simulation, "external_work"));
}

TEST(Tools, AfterTenThousandRevolutionsAToolStandsWhereItBegan) {
  ToolMotion motion;
  motion.angular_velocity = TimeFunction::constant(2 * pi * 1e4);
  motion.rotation_axis = (1 / std::sqrt(3.0)) * Vector{1, 1, 1};
  motion.rotation_point = {0.1, -0.2, 0.3};
  const RigidPose start{{1, 2, 3}, rotation_about({0, 0, 1}, 0.4)};
  for (const double time : {1.0, 1.0 + 1.0 / 3e4}) {
    const RigidPose now = moved(start, motion, motion.way(time), motion.angle(time));
    const RigidPose exact = moved(start, motion, {}, time == 1 ? 0 : 2 * pi / 3);
    for (const Vector& p : {Vector{0, 0, 0}, Vector{1, 0, 0}, Vector{0, 0, -2}})
      EXPECT_LT(norm(now.to_world(p) - exact.to_world(p)), 1e-10);
  }
}

TEST(Tools, TurnZIntoAnyDirectionToRoundOff) {
  for (const Vector& d : {Vector{0, 0, 1}, Vector{0, 0, -1}, Vector{0.6, 0, 0.8}, Vector{0, 1, 0},
                          Vector{4e-6, 3e-6, -std::sqrt(1 - 25e-12)}, Vector{0.48, -0.64, -0.6}}) {
    const Quaternion<double> q = rotation_of_z(d);
    EXPECT_NEAR(q.w * q.w + dot(q.v, q.v), 1, 1e-15);
    EXPECT_LT(norm(rotate(q, Vector{0, 0, 1}) - d), 1e-15);
  }
}

TEST(Tools, ListsOfWhatMayTouchAreMadeSeldomAndChangeNothing) {
  const auto setup = pressed_setup(0.1);
  Simulation simulation(setup, block());
  simulation.advance(1400);
  EXPECT_LT(simulation.find<Tool>()->searches(), 140U);
}

}  // namespace solidem::test::tools_test
