// SPDX-License-Identifier: GPL-2.0-or-later
//
// A run that is stopped and resumed while bonds flow, break, touch and are made anew ends in the
// same bits as one that was not: from memory and through files, whatever the moment.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "engine/run.hpp"
#include "support/beams.hpp"

namespace solidem::restart_of_broken_beams_test {

/// A bar that is drawn until it tears, then pushed back together.
Setup torn_and_pushed(FlowLaw flow, bool rebonds, std::int64_t steps, double step) {
  auto setup = yielding_setup(2e-3, 0.01, flow);
  setup.get<RuptureParameters>() = breaking_at_strain(0.02);
  setup.get<ContactParameters>() = ContactParameters{};
  if (rebonds) setup.get<ContactParameters>()->rebonding_pressure = 1e9;
  const double end = static_cast<double>(steps) * step;
  auto right = hold("right", face(0, true, 1.5));
  right.axis[0].function = {{0, 0.5 * end, end}, {0, 1.2e-4, -6e-5}};
  setup.all<GripParameters>() = {hold("left", face(0, false, 1.5)), right};
  setup.run.steps = steps;
  setup.run.time_step = step;
  return setup;
}

constexpr std::int64_t steps = 2000;

struct Case {
  const char* name;
  FlowLaw flow;
  bool rebonds;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class RestartOfBrokenBeams : public testing::TestWithParam<Case> {
 protected:
  Specimen body = random_bar(200);
  solidem::Setup setup = torn_and_pushed(GetParam().flow, GetParam().rebonds, steps,
                                         0.3 * Simulation(beam_setup(), body).time_step().bound);
};

TEST_P(RestartOfBrokenBeams, gives_the_same_bits_at_any_moment) {
  Simulation whole(setup, body);
  whole.advance(steps);
  const auto end = whole.save();
  const auto told = whole.observe().values;
  ASSERT_GT(seen(whole, "broken_bonds"), 10);
  ASSERT_GT(seen(whole, "plastic_work"), 0);
  double broken_before = 0;
  for (const std::int64_t moment : {1, 150, 600, 1000, 1400, 1900}) {
    Simulation first(setup, body);
    first.advance(moment);
    const HistoryRow then = first.observe();
    std::printf("  step %4lld: %.0f bonds broken, plastic work %.2e J, contact energy %.2e J\n",
                static_cast<long long>(moment), value_of(then, "broken_bonds"),
                value_of(then, "plastic_work"), value_of(then, "contact_energy"));
    broken_before = std::max(broken_before, value_of(then, "broken_bonds"));
    Simulation second(setup, body);
    second.restore(moment, first.save());
    // What was restored is seen as it was, before and after it goes on.
    EXPECT_EQ(second.observe().values, then.values) << moment;
    second.advance(steps - moment);
    EXPECT_EQ(second.save(), end) << moment;
    EXPECT_EQ(second.observe().values, told) << moment;
  }
  EXPECT_GT(broken_before, 10);
}

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_P(RestartOfBrokenBeams, gives_the_same_files) {
  setup.run.observe_every = 10;
  setup.output.frames = 0;
  const std::string own =
      testing::TempDir() + "restart_" + std::to_string(getpid());  // tests run side by side
  const std::string whole_folder = own + "_whole", folder = own + "_parts";
  RunOptions options;
  options.quiet = true;
  options.fingerprint = "the same";
  {
    options.directory = whole_folder;
    Simulation simulation(setup, body);
    ASSERT_TRUE(run(simulation, options).completed);
  }
  std::map<std::string, std::vector<double>> end;
  options.directory = folder;
  for (const std::int64_t until : {300, 1100, 2000}) {
    auto part = setup;
    part.run.steps = until;
    Simulation simulation(part, body);
    ASSERT_TRUE(run(simulation, options).completed);
    options.resume = true;
    end = simulation.save();
  }
  Simulation whole(setup, body);
  whole.advance(steps);
  EXPECT_EQ(end, whole.save());
  EXPECT_EQ(contents(folder + "/history.csv"), contents(whole_folder + "/history.csv"));
  std::filesystem::remove_all(folder);
  std::filesystem::remove_all(whole_folder);
}

INSTANTIATE_TEST_SUITE_P(Laws, RestartOfBrokenBeams,
                         testing::Values(Case{"radial return", FlowLaw::radial_return, false},
                                         Case{"radial return, bonded anew", FlowLaw::radial_return,
                                              true},
                                         Case{"scaled offset", FlowLaw::scaled_offset, false}));

}  // namespace solidem::restart_of_broken_beams_test
