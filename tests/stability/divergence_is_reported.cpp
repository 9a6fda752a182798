// SPDX-License-Identifier: GPL-2.0-or-later
//
// A run beyond its stable step is stopped within a thousand steps of the moment it goes astray,
// says so, and keeps what it computed before; it is never run on. Plastic flow must not hide it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "engine/run.hpp"
#include "model/error.hpp"
#include "support/central_forces.hpp"

namespace solidem::divergence_is_reported_test {

struct Case {
  const char* name;
  double over;  ///< step in shares of the stable limit
  bool flows = false;
  bool breaks = false;
  std::int64_t observe_every = 1;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

Setup setup_of(const Case& c) {
  auto setup = c.flows ? yielding_setup() : beam_setup();
  if (c.breaks) {
    setup.get<RuptureParameters>() = breaking_at_strain(0.2);
  }
  setup.all<GripParameters>() = {hold("left", face(0, false))};
  setup.all<InitialVelocity>().push_back({face(0, true), {0.1, 0.05, 0}});
  return setup;
}

class Divergence : public testing::TestWithParam<Case> {};

/// The step by which the energy that nobody put in is beyond doubt: ten times what there was.
std::int64_t first_astray(const Setup& setup, const Specimen& body) {
  Simulation simulation(setup, body, true);
  const double start = seen(simulation, "kinetic_energy");
  for (int n = 0; n < 20000; ++n) {
    try {
      simulation.advance(1);
      const HistoryRow row = simulation.observe();
      if (value_of(row, "energy_balance") > 10 * start) return simulation.step();
    } catch (const RunError&) {
      return simulation.step();
    }
  }
  return -1;
}

TEST_P(Divergence, stops_the_run_within_a_thousand_steps) {
  auto setup = setup_of(GetParam());
  const Specimen body = jittered("bcc", {4, 2, 2});
  setup.run.time_step = GetParam().over * Simulation(setup, body).time_step().limit;
  setup.run.steps = 100000;
  setup.run.observe_every = GetParam().observe_every;
  setup.output.frames = 0;
  const std::int64_t astray = first_astray(setup, body);
  ASSERT_GT(astray, 0);

  const std::string folder = testing::TempDir() + "divergence_" + std::to_string(getpid());
  std::filesystem::remove_all(folder);
  Simulation simulation(setup, body, true);
  RunOptions options;
  options.directory = folder;
  options.quiet = true;
  std::string said;
  try {
    run(simulation, options);
  } catch (const RunError& error) {
    said = error.what();
  }
  EXPECT_NE(said, "");
  std::printf("  %s: astray at step %lld, stopped at %lld: %s\n", GetParam().name,
              static_cast<long long>(astray), static_cast<long long>(simulation.step()),
              said.c_str());
  EXPECT_LE(simulation.step(), astray + 1000);
  EXPECT_NE(said.find("diverged"), std::string::npos) << said;

  const auto summary = nlohmann::json::parse(std::ifstream(folder + "/summary.json"));
  EXPECT_FALSE(summary.at("completed").get<bool>());
  EXPECT_EQ(summary.at("stopped").get<std::string>(), said);
  // Every row that was written is finite and comes before the end.
  std::ifstream history(folder + "/history.csv");
  std::string line;
  std::getline(history, line);
  int rows = 0;
  for (; std::getline(history, line); ++rows) {
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      EXPECT_TRUE(std::isfinite(std::stod(cell))) << line;
  }
  EXPECT_GE(rows, 1);
  std::filesystem::remove_all(folder);
}

constexpr std::int64_t seldom = 1000000;

INSTANTIATE_TEST_SUITE_P(
    Runs, Divergence,
    testing::Values(Case{"just beyond", 1.03}, Case{"far beyond", 2},
                    Case{"just beyond, looked at seldom", 1.03, false, false, seldom},
                    Case{"far beyond, looked at seldom", 2, false, false, seldom},
                    Case{"flowing", 1.1, true},
                    Case{"flowing, looked at seldom", 1.1, true, false, seldom},
                    Case{"breaking, looked at seldom", 1.1, true, true, seldom}));

TEST(Divergence, is_not_reported_of_a_sound_run) {
  // Near the limit the energy swings widely and comes back: that is no divergence.
  for (const bool flows : {false, true}) {
    auto setup = setup_of(Case{"sound", 0.97, flows});
    const Specimen body = jittered("bcc", {4, 2, 2});
    setup.run.time_step = 0.97 * Simulation(setup, body).time_step().limit;
    setup.run.steps = 20000;
    setup.run.observe_every = 50;
    setup.output.frames = 0;
    const std::string folder = testing::TempDir() + "sound_" + std::to_string(getpid());
    Simulation simulation(setup, body);
    RunOptions options;
    options.directory = folder;
    options.quiet = true;
    EXPECT_TRUE(run(simulation, options).completed);
    std::filesystem::remove_all(folder);
  }
}

TEST(Divergence, of_a_short_run_is_reported_by_its_end) {
  // Fifty steps at three times the limit: fewer than there are between two looks at the energy.
  auto setup = setup_of(Case{"short", 3});
  const Specimen body = jittered("bcc", {4, 2, 2});
  setup.run.time_step = 3 * Simulation(setup, body).time_step().limit;
  Simulation simulation(setup, body, true);
  EXPECT_THROW(simulation.advance(50), RunError);
}

TEST(Divergence, of_one_element_among_many_is_reported_under_central_forces) {
  // An element that comes to stand deep in another in a single step takes energy from nowhere.
  LennardJones law;
  law.energy = 0.04;
  auto setup = central_setup(law);
  setup.run.time_step_ratio = 0.6;
  Simulation simulation(setup, crystal("fcc", {6, 6, 6}, {true, true, true}));
  set_velocity(simulation, 0, {1e5, 9e4, 3e4});
  EXPECT_THROW(simulation.advance(256), RunError);
}

}  // namespace solidem::divergence_is_reported_test
