// SPDX-License-Identifier: GPL-2.0-or-later
//
// The same bits, whatever the number of threads, and through a checkpoint.
#include <gtest/gtest.h>
#include <omp.h>

#include "effects/conduction_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "support/specimens.hpp"

namespace solidem::repeatable_test {

/// Beams, conduction, grips and an imposed temperature at once.
Setup everything() {
  auto setup = elastic_setup();
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->initial_temperature = 298;
  AxisControl held{AxisControl::Kind::displacement, TimeFunction::constant(0)};
  AxisControl wave{AxisControl::Kind::displacement, {{0.0}, {0.0}, 1e-6, 1e5, 0}};
  AxisControl force{AxisControl::Kind::force, TimeFunction::constant(3)};
  setup.all<GripParameters>() = {{"left", face(0, false), {held, held, held}, true},
                                 {"right", face(0, true), {wave, force, {}}, false}};
  setup.all<ImposedTemperatureParameters>().push_back(
      {"hot", face(0, true), TimeFunction::constant(798)});
  return setup;
}

using Saved = std::map<std::string, std::vector<double>>;

TEST(Repeatable, on_any_number_of_threads) {
  const int before = omp_get_max_threads();
  const Specimen specimen = jittered("bcc", {24, 12, 10});
  std::vector<Saved> states;
  for (const int threads : {1, 2, 3, 4}) {
    omp_set_num_threads(threads);
    Simulation simulation(everything(), specimen);
    simulation.advance(30);
    Saved state = simulation.save();
    for (const auto& [name, value] : simulation.observe().values) state["seen"].push_back(value);
    states.push_back(std::move(state));
  }
  omp_set_num_threads(before);
  for (const Saved& state : states) EXPECT_EQ(state, states[0]);
}

TEST(Repeatable, through_a_checkpoint) {
  const Specimen specimen = jittered("bcc", {6, 3, 3});
  Simulation whole(everything(), specimen);
  whole.advance(100);
  Simulation first(everything(), specimen);
  first.advance(37);
  Simulation second(everything(), specimen);
  second.restore(first.step(), first.save());
  second.advance(63);
  EXPECT_EQ(second.save(), whole.save());
  EXPECT_EQ(second.observe().values, whole.observe().values);
}

}  // namespace solidem::repeatable_test
