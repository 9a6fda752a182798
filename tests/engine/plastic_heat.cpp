// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat from plastic work, and the clock of heat beside motion.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "engine/heat.hpp"
#include "model/error.hpp"
#include "support/thermomechanics.hpp"

namespace solidem::plastic_heat_test {

/// A bar that flows in many places while it is heated by its own work.
Setup flowing(double fraction = 0.9) {
  auto setup = warm(yielding_setup(2e-3, 0.01));
  setup.get<PlasticHeatParameters>() = PlasticHeatParameters{fraction};
  setup.run.time_step_ratio = 0.2;
  return setup;
}

const Specimen& bar() {
  static const Specimen specimen = jittered("bcc", {8, 2, 2});
  return specimen;
}

struct Case {
  const char* name;
  HeatIntegratorName integrator;
  std::int64_t every;
  bool capacity_varies;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class PlasticHeatOf : public testing::TestWithParam<Case> {};

TEST_P(PlasticHeatOf, is_the_fraction_of_the_plastic_work_at_any_moment) {
  auto setup = flowing();
  setup.get<ConductionParameters>()->integrator = GetParam().integrator;
  setup.get<ConductionParameters>()->every = GetParam().every;
  if (GetParam().capacity_varies)
    setup.materials[0].specific_heat = TemperatureFunction({290, 320}, {880, 1000});
  const auto simulation = struck(setup, bar(), 60);
  double work = 0;
  for (int n = 0; n < 12; ++n) {
    simulation->advance(67);
    const HistoryRow row = simulation->observe();
    work = value_of(row, "plastic_work");
    EXPECT_NEAR(value_of(row, "thermal_energy") + value_of(row, "waiting_heat"), 0.9 * work,
                1e-12 * work);
    EXPECT_NEAR(value_of(row, "plastic_heat"), 0.9 * work, 1e-15 * work);
    EXPECT_LE(std::fabs(value_of(row, "heat_balance")), 1e-12 * work);
  }
  EXPECT_GT(work, 0);
  EXPECT_GT(extremes(*simulation).second, 300.5);
}

INSTANTIATE_TEST_SUITE_P(
    All, PlasticHeatOf,
    testing::Values(Case{"explicit", HeatIntegratorName::explicit_euler, 1, false},
                    Case{"explicit every 50", HeatIntegratorName::explicit_euler, 50, false},
                    Case{"rkl2 every 50", HeatIntegratorName::rkl2, 50, false},
                    Case{"implicit every 50", HeatIntegratorName::implicit, 50, false},
                    Case{"explicit, capacity", HeatIntegratorName::explicit_euler, 1, true},
                    Case{"implicit, capacity", HeatIntegratorName::implicit, 7, true}));

TEST(PlasticHeat, heats_both_ends_of_a_bond_by_half) {
  auto setup = flowing();
  setup.materials[0].conductivity = 1e-12;
  Specimen pair = row_of(2);
  pair.radius[1] *= 1.3;
  Simulation simulation(setup, pair);
  set_velocity(simulation, 1, {50, 0, 0});
  simulation.advance(200);
  const double* inverse_capacity = simulation.model().data(columns::inverse_heat_capacity);
  const double first = (temperature_of(simulation, 0) - 300) / inverse_capacity[0];
  const double second = (temperature_of(simulation, 1) - 300) / inverse_capacity[1];
  EXPECT_GT(first, 0);
  EXPECT_NE(inverse_capacity[0], inverse_capacity[1]);
  EXPECT_NEAR(first, second, 1e-9 * first);
  const HistoryRow row = simulation.observe();
  EXPECT_NEAR(first + second + value_of(row, "waiting_heat"), 0.9 * value_of(row, "plastic_work"),
              1e-9 * first);
}

TEST(PlasticHeat, of_no_fraction_changes_no_bit) {
  auto without = flowing();
  without.get<PlasticHeatParameters>().reset();
  const auto none = struck(without, bar(), 60), zero = struck(flowing(0), bar(), 60);
  none->advance(400);
  zero->advance(400);
  EXPECT_GT(seen(*none, "plastic_work"), 0);
  const auto expected = none->save(), found = zero->save();
  for (const auto& [name, values] : expected) EXPECT_EQ(found.at(name), values) << name;
}

TEST(PlasticHeat, into_an_element_of_imposed_temperature_is_taken_out_there) {
  auto setup = flowing();
  setup.all<ImposedTemperatureParameters>().push_back(
      {"cold", face(0, true, 4), TimeFunction::constant(300)});
  for (const auto integrator : {HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2}) {
    setup.get<ConductionParameters>()->integrator = integrator;
    setup.get<ConductionParameters>()->every = 20;
    const auto simulation = struck(setup, bar(), 60);
    simulation->advance(400);
    const HistoryRow row = simulation->observe();
    EXPECT_LT(value_of(row, "temperature.cold.heat"), 0);
    EXPECT_LE(std::fabs(value_of(row, "heat_balance")), 1e-12 * value_of(row, "plastic_work"));
  }
}

/// Temperatures after so many steps of the motion.
std::vector<double> temperatures(const Setup& setup, int steps) {
  const auto simulation = struck(setup, bar(), 60);
  simulation->advance(steps);
  const double* t = simulation->model().data(columns::temperature);
  return {t, t + simulation->model().elements()};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

TEST(HeatClock, gives_the_temperatures_of_every_step_within_the_change_it_allows) {
  constexpr int steps = 1200;
  auto setup = flowing();
  setup.materials[0].conductivity = 2e4;  // heat spreads while sound passes
  setup.run.steps = steps;
  const auto every_step = temperatures(setup, steps);
  const auto [low, high] = std::minmax_element(every_step.begin(), every_step.end());
  EXPECT_GT(*high - *low, 0.5);
  for (const auto integrator : {HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2})
    for (const double change : {0.5, 0.05}) {
      setup.get<ConductionParameters>()->integrator = integrator;
      setup.get<ConductionParameters>()->largest_change = change;
      const double difference = largest_difference(temperatures(setup, steps), every_step);
      std::printf("  %s, %g K: %.2g K\n", label(integrator), change, difference);
      EXPECT_LT(difference, change);
    }
}

TEST(HeatClock, waits_longer_where_little_changes_and_as_long_as_is_stable) {
  auto setup = flowing();
  setup.get<ConductionParameters>()->largest_change = 0.2;
  setup.run.steps = 4000;
  const auto simulation = struck(setup, bar(), 60);
  simulation->advance(30);
  const double at_first = seen(*simulation, "heat_every");
  simulation->advance(3970);
  const double in_the_end = seen(*simulation, "heat_every");
  std::printf("  every %g, then every %g steps\n", at_first, in_the_end);
  EXPECT_GT(in_the_end, at_first);
  EXPECT_LE(in_the_end * simulation->time_step().value, simulation->heat()->criterion().value);
}

TEST(HeatClock, lets_heat_catch_up_at_the_end_of_the_run) {
  auto setup = flowing();
  setup.get<ConductionParameters>()->every = 64;
  setup.run.steps = 100;
  const auto simulation = struck(setup, bar(), 60);
  simulation->advance(99);
  const double waits = seen(*simulation, "waiting_heat");
  simulation->advance(1);
  // What is left is that of the pose of now, which flows in the next step.
  EXPECT_LT(seen(*simulation, "waiting_heat"), 0.2 * waits);
}

TEST(HeatClock, bounds_the_step_of_the_motion_by_all_the_steps_that_explicit_heat_waits_for) {
  auto setup = flowing();
  setup.materials[0].conductivity = 1.3e6;  // heat steps are shorter than those of sound
  setup.run.time_step_ratio.reset();
  const Simulation alone(setup, bar());
  setup.run.time_step = 0.5 * alone.heat()->limit();
  setup.get<ConductionParameters>()->every = 2;
  EXPECT_LT(*setup.run.time_step, alone.time_step().limit);
  EXPECT_NO_THROW(Simulation(setup, bar()));
  setup.get<ConductionParameters>()->every = 3;
  EXPECT_THROW(Simulation(setup, bar()), InputError);
}

TEST(HeatClock, may_be_ten_thousand_times_slower_than_motion) {
  auto setup = warm(beam_setup());
  setup.get<ConductionParameters>()->integrator = HeatIntegratorName::implicit;
  setup.get<ConductionParameters>()->every = 10000;
  setup.all<HeatSourceParameters>().push_back(heated_everywhere(1e12));
  Simulation simulation(setup, row_of(4));
  simulation.advance(25000);
  const HistoryRow row = simulation.observe();
  // Two of the two and a half steps of heat have been made.
  const double rise = 1e12 * 20000 * simulation.time_step().value / (2790 * 880);
  EXPECT_NEAR(temperature_of(simulation, 0) - 300, rise, 1e-9 * rise);
  EXPECT_LE(std::fabs(value_of(row, "heat_balance")), 1e-12 * value_of(row, "heat_input"));
}

}  // namespace solidem::plastic_heat_test
