// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "model/error.hpp"
#include "support/specimens.hpp"

namespace solidem::time_step_test {

/// Does a tiny disturbance stay tiny?
bool stable(Setup setup, const Specimen& specimen, double time_step) {
  setup.run.time_step = time_step;
  Simulation simulation(setup, specimen, true);
  Model& model = simulation.model();
  const bool moving = setup.get<BeamParameters>().has_value();
  double* start = model.data(moving ? columns::velocity : columns::temperature);
  for (std::size_t i = 0; i < model.elements(); ++i)
    start[moving ? Model::at(columns::velocity, i, static_cast<int>(i % 3)) : i] +=
        1e-9 * std::sin(static_cast<double>(i * i));
  const std::string energy = moving ? "elastic_energy" : "thermal_energy";
  try {
    simulation.advance(200);
    const double early = moving ? value_of(simulation.observe(), energy) : 1;
    simulation.advance(moving ? 1500 : 3000);
    if (moving) return value_of(simulation.observe(), energy) < 100 * early;
    double range = 0;
    for (std::size_t i = 0; i < model.elements(); ++i)
      range = std::max(range, std::fabs(model.data(columns::temperature)[i] - 298));
    return range < 1e-6;
  } catch (const RunError&) {
    return false;
  }
}

struct Case {
  const char* name;
  double radius_ratio;
  BeamParameters::RadiusFrom radius_from;
  const char* lattice;
};

class BeamLimit : public testing::TestWithParam<Case> {};

TEST_P(BeamLimit, lies_between_runs_that_hold_and_runs_that_diverge) {
  auto setup = elastic_setup();
  setup.get<BeamParameters>()->radius_ratio = GetParam().radius_ratio;
  setup.get<BeamParameters>()->radius_from = GetParam().radius_from;
  const Specimen specimen = jittered(GetParam().lattice, {4, 4, 4});
  const TimeStepChoice choice = Simulation(setup, specimen).time_step();
  std::printf("%s: limit %.3f of the criterion (%s)\n", GetParam().name,
              choice.limit / choice.bound, choice.criterion.c_str());
  EXPECT_TRUE(stable(setup, specimen, 0.97 * choice.limit));
  EXPECT_FALSE(stable(setup, specimen, 1.03 * choice.limit));
}

INSTANTIATE_TEST_SUITE_P(
    Specimens, BeamLimit,
    testing::Values(Case{"thin", 0.1, BeamParameters::RadiusFrom::mean, "bcc"},
                    Case{"thesis", 0.5, BeamParameters::RadiusFrom::mean, "bcc"},
                    Case{"thick", 0.9, BeamParameters::RadiusFrom::pair, "bcc"},
                    Case{"cubic", 0.27, BeamParameters::RadiusFrom::mean, "simple_cubic"},
                    Case{"close", 0.27, BeamParameters::RadiusFrom::mean, "fcc"}));

TEST(ConductionLimit, lies_between_runs_that_hold_and_runs_that_diverge) {
  const auto setup = thermal_setup();
  const Specimen specimen = jittered("bcc", {4, 4, 4});
  const TimeStepChoice choice = Simulation(setup, specimen).time_step();
  std::printf("conduction: limit %.3f of the criterion\n", choice.limit / choice.bound);
  EXPECT_GT(choice.limit, choice.bound);
  EXPECT_TRUE(stable(setup, specimen, 0.97 * choice.limit));
  EXPECT_FALSE(stable(setup, specimen, 1.03 * choice.limit));
}

TEST(TimeStep, beyond_the_limit_is_refused_unless_forced) {
  auto setup = elastic_setup();
  const Specimen specimen = crystal("bcc", {3, 3, 3});
  setup.run.time_step_ratio = 2.0;
  EXPECT_THROW(Simulation(setup, specimen), InputError);
  EXPECT_NO_THROW(Simulation(setup, specimen, true));
}

TEST(TimeStep, divergence_is_reported) {
  auto setup = elastic_setup();
  setup.run.time_step_ratio = 3.0;
  setup.all<InitialVelocity>().push_back({face(0, true), {1, 0, 0}});
  Simulation simulation(setup, crystal("bcc", {3, 3, 3}), true);
  EXPECT_THROW(
      {
        for (int n = 0; n < 100; ++n) {
          simulation.advance(10);
          simulation.observe();
        }
      },
      RunError);
}

}  // namespace solidem::time_step_test
