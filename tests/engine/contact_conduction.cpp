// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat that passes where elements touch each other or a tool, against the exact exchange.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "effects/conduction_parameters.hpp"
#include "effects/contact_conduction.hpp"
#include "laws/constants.hpp"
#include "scene/scene_text.hpp"
#include "support/thermomechanics.hpp"

namespace solidem::test::contact_conduction_test {

constexpr int pressing = 420;  // steps, after which nothing moves any more
/// A grip on the k-th of the elements of a row, which moves so many times 0.4 m/s against x for 3
/// us.
std::string grip_of(int k, double speed) {
  const auto between = [](double low, double high) {
    return "region = { lower = [\"" + std::to_string(low) +
           " mm\", \"any\", \"any\"], upper = [\"" + std::to_string(high) +
           " mm\", \"any\", \"any\"] }\n";
  };
  const std::string v = "\"" + std::to_string(-0.4 * speed) + " m/s\"";
  return "[[grips]]\nname = \"g" + std::to_string(k) + "\"\n" +
         between(0.2 * k - 0.1, 0.2 * k + 0.1) +
         "velocity = [{ time = [\"0 s\", \"3 us\", \"3.01 us\"], value = [" + v + ", " + v +
         ", \"0 m/s\"] }, \"0 m/s\", \"0 m/s\"]\n";
}

/// A scene whose specimen is made by hand.
solidem::Setup scene_with(const std::string& sections, int every = 1,
                          const std::string& conduction = "") {
  auto setup =
      read_text_scene(
          "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [1, 1, 1]\n"
          "element_radius = \"0.1 mm\"\n"
          "[material]\ndensity = \"2790 kg/m^3\"\nspecific_heat_capacity = \"880 J/(kg K)\"\n"
          "conductivity = \"134 W/(m K)\"\n"
          "[beams]\nyoung_modulus = \"70 GPa\"\nradius_ratio = 0.5\npoisson_ratio = 0.3\n"
          "[conduction]\ninitial_temperature = \"300 K\"\n" +
          conduction + sections + "[run]\nsteps = 100000\ntime_step = \"15 ns\"\n")
          .setup;
  setup.get<ConductionParameters>()->every = every;
  return setup;
}

/// Elements in a row without bonds, which nearly touch.
Specimen apart(int elements) {
  Specimen specimen = row_of(elements, 2.0002);
  specimen.bonds.clear();
  return specimen;
}

const std::string contact = "[contact]\nnormal_stiffness = \"1 MN/m\"\n";

/// A row of elements that grips press together, with their temperatures after that.
std::unique_ptr<Simulation> pressed(const solidem::Setup& setup, const Specimen& row,
                                    const std::vector<double>& temperatures) {
  auto simulation = std::make_unique<Simulation>(setup, row);
  simulation->advance(pressing);
  for (std::size_t i = 0; i < temperatures.size(); ++i)
    simulation->model().data(columns::temperature)[i] = temperatures[i];
  return simulation;
}

double capacity_of(const Simulation& simulation, std::size_t element) {
  return 1 / simulation.model().data(columns::inverse_heat_capacity)[element];
}

TEST(ContactConduction, of_two_that_touch_is_the_exact_exchange_whatever_the_steps) {
  for (const auto integrator :
       {HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2, HeatIntegratorName::implicit})
    for (const int every : {1, 7, 60})
      for (const bool by_area : {false, true}) {
        auto setup = scene_with(
            contact + "[contact_conduction]\n" +
                (by_area ? "coefficient = \"1e9 W/(m^2 K)\"\n" : "conductance = \"0.4 W/K\"\n") +
                grip_of(0, 0) + grip_of(1, 1),
            every);
        setup.get<ConductionParameters>()->integrator = integrator;
        Specimen two = apart(2);
        two.radius[0] *= 0.8;
        two.position[0].x += 0.2 * hand_radius;
        const auto simulation = pressed(setup, two, {300, 400});
        simulation->advance(840);
        const double overlap =
            1.8 * hand_radius - norm(centre_of(*simulation, 1) - centre_of(*simulation, 0));
        EXPECT_GT(overlap, 1e-6);
        const double area = 2 * pi * overlap * (0.8 / 1.8) * hand_radius;
        const double conductance = by_area ? 1e9 * area : 0.4;
        const double first = capacity_of(*simulation, 0), second = capacity_of(*simulation, 1);
        const double time = 840 * simulation->time_step().value;
        const double left = std::exp(-conductance * (1 / first + 1 / second) * time);
        const double mean = (first * 300 + second * 400) / (first + second);
        EXPECT_GT(left, 0.01);
        EXPECT_LT(left, 0.6);
        EXPECT_NEAR(temperature_of(*simulation, 1) - temperature_of(*simulation, 0), 100 * left,
                    1e-9);
        EXPECT_NEAR(
            first * temperature_of(*simulation, 0) + second * temperature_of(*simulation, 1),
            (first + second) * mean, 1e-13 * (first + second) * mean);
      }
}

TEST(ContactConduction, through_a_row_is_of_second_order_in_the_step_of_heat) {
  std::vector<double> errors;
  for (const int every : {10, 20, 40}) {
    const auto setup = scene_with(contact + "[contact_conduction]\nconductance = \"0.4 W/K\"\n" +
                                      grip_of(0, 0) + grip_of(1, 1) + grip_of(2, 2),
                                  every);
    // Pressing takes a whole number of steps of heat.
    const auto simulation = pressed(setup, apart(3), {});
    simulation->advance(40 * ((pressing + 39) / 40) - pressing);
    // The modes of a row of three: all alike, the ends against each other, the middle against both.
    constexpr double mean = 1090.0 / 3, ends = -75, middle = 35.0 / 3;
    const auto at = [&](double first, double second) {
      const double a = ends * first, b = middle * second;
      return std::array<double, 3>{mean + a + b, mean - 2 * b, mean - a + b};
    };
    const std::array<double, 3> before = at(1, 1);  // 300, 340 and 450 K
    for (std::size_t i = 0; i < 3; ++i)
      simulation->model().data(columns::temperature)[i] = before[i];
    simulation->advance(800);
    const double way = 0.4 / capacity_of(*simulation, 0) * 800 * simulation->time_step().value;
    const std::array<double, 3> after = at(std::exp(-way), std::exp(-3 * way));
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i)
      error = std::max(error, std::fabs(temperature_of(*simulation, i) - after[i]));
    errors.push_back(error);
  }
  std::printf("  error %.1e, %.1e, %.1e K\n", errors[0], errors[1], errors[2]);
  EXPECT_NEAR(std::log2(errors[1] / errors[0]), 2, 0.1);
  EXPECT_NEAR(std::log2(errors[2] / errors[1]), 2, 0.1);
}

/// A tool that the second grip presses an element on.
std::string wall_at(const std::string& temperature) {
  return "[[tools]]\nname = \"wall\"\nshape = \"plane\"\nnormal = [1, 0, 0]\n"
         "stiffness = \"1 MN/m\"\norigin = [\"-0.10001 mm\", \"0 mm\", \"0 mm\"]\n" +
         temperature;
}

TEST(ContactConduction, with_a_tool_that_has_a_temperature_is_exact_and_counted) {
  for (const int every : {1, 60})
    for (const bool by_area : {false, true}) {
      const auto setup = scene_with("[contact_conduction]\n" +
                                        std::string(by_area ? "coefficient = \"1e9 W/(m^2 K)\"\n"
                                                            : "conductance = \"0.4 W/K\"\n") +
                                        wall_at("temperature = \"500 K\"\n") + grip_of(0, 1),
                                    every);
      const auto simulation = pressed(setup, apart(1), {});
      const double before = temperature_of(*simulation, 0);
      simulation->advance(840);
      const double overlap = -0.00001e-3 - centre_of(*simulation, 0).x;
      const double conductance = by_area ? 1e9 * 2 * pi * hand_radius * overlap : 0.4;
      const double capacity = capacity_of(*simulation, 0);
      const double left = std::exp(-conductance / capacity * 840 * simulation->time_step().value);
      EXPECT_LT(left, 0.7);
      EXPECT_NEAR(500 - temperature_of(*simulation, 0), (500 - before) * left, 1e-9);
      const HistoryRow row = simulation->observe();
      EXPECT_NEAR(value_of(row, "tool.wall.conducted_heat"),
                  capacity * (temperature_of(*simulation, 0) - 300), 1e-11 * capacity * 300);
      EXPECT_LE(std::fabs(value_of(row, "heat_balance")), 1e-11 * value_of(row, "heat_input"));
    }
}

TEST(ContactConduction, leaves_pairs_alone_whose_cells_share_a_face_through_which_heat_passes) {
  Specimen two = crystal("simple_cubic", {2, 1, 1});
  two.bonds.clear();
  const std::string grips =
      "[[grips]]\nname = \"left\"\nregion = { axis = \"x\", side = \"low\", layers = 1 }\n"
      "velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"]\n"
      "[[grips]]\nname = \"right\"\nregion = { axis = \"x\", side = \"high\", layers = 1 }\n"
      "velocity = [\"-0.4 m/s\", \"0 m/s\", \"0 m/s\"]\n";
  std::vector<double> warm;
  for (const std::string conduction : {"", "[contact_conduction]\nconductance = \"0.4 W/K\"\n"}) {
    const auto simulation = pressed(
        scene_with(contact + conduction + grips, 1, "law = \"voronoi\"\n"), two, {300, 400});
    EXPECT_EQ(seen(*simulation, "contacts"), 1);
    simulation->advance(20);
    warm.push_back(temperature_of(*simulation, 0));
  }
  EXPECT_GT(warm[0], 300.01);
  EXPECT_EQ(warm[0], warm[1]);
}

TEST(ContactConduction, lets_a_crack_conduct_when_it_closes) {
  const std::string tears =
      "[rupture]\nstrain = 0.002\n[[grips]]\nname = \"left\"\n"
      "region = { axis = \"x\", side = \"low\", layers = 1 }\n"
      "velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"]\n"
      "[[grips]]\nname = \"right\"\nregion = { axis = \"x\", side = \"high\", layers = 1 }\n"
      "velocity = [{ time = [\"0 s\", \"2 us\", \"2.1 us\"], value = [\"1 m/s\", \"1 m/s\", \"-1 "
      "m/s\"] }, \"0 m/s\", \"0 m/s\"]\n";
  Simulation simulation(
      scene_with(contact + "[contact_conduction]\nconductance = \"0.4 W/K\"\n" + tears), row_of(2));
  simulation.advance(133);
  EXPECT_EQ(seen(simulation, "broken_bonds"), 1);
  simulation.model().data(columns::temperature)[1] = 400;
  simulation.advance(20);
  EXPECT_EQ(seen(simulation, "contacts"), 0);
  EXPECT_EQ(temperature_of(simulation, 0), 300);
  simulation.advance(300);
  EXPECT_EQ(seen(simulation, "contacts"), 1);
  EXPECT_GT(temperature_of(simulation, 0), 300.1);
}

TEST(ContactConduction, warms_loose_elements_that_have_no_other_way) {
  const auto setup =
      read_text_scene(
          "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [3, 1, 1]\n"
          "element_radius = \"0.1 mm\"\n"
          "[material]\ndensity = \"2790 kg/m^3\"\nspecific_heat_capacity = \"880 J/(kg K)\"\n"
          "conductivity = \"134 W/(m K)\"\n"
          "[conduction]\ninitial_temperature = \"300 K\"\n"
          "[contact]\nnormal_stiffness = \"1 MN/m\"\n"
          "[contact_conduction]\nconductance = \"4 W/K\"\n"
          "[[temperatures]]\nname = \"hot\"\nvalue = \"400 K\"\n"
          "region = { axis = \"x\", side = \"low\", layers = 1 }\n"
          "[run]\nsteps = 4000\ntime_step_ratio = 0.1\n")
          .setup;
  Simulation simulation(setup, apart(3));
  set_velocity(simulation, 0, {0.5, 0, 0});
  simulation.advance(4000);
  std::printf("  %.3f, %.3f, %.3f K\n", temperature_of(simulation, 0),
              temperature_of(simulation, 1), temperature_of(simulation, 2));
  EXPECT_NEAR(capacity_of(simulation, 1), 2790 * 880 * 4.0 / 3 * pi * std::pow(hand_radius, 3),
              1e-15);
  EXPECT_GT(temperature_of(simulation, 1), 305);
  EXPECT_GT(temperature_of(simulation, 2), 300.1);
  const HistoryRow row = simulation.observe();
  EXPECT_GT(value_of(row, "temperature.hot.heat"), 0);
  EXPECT_LE(std::fabs(value_of(row, "heat_balance")), 1e-11 * value_of(row, "heat_input"));
}

}  // namespace solidem::test::contact_conduction_test
