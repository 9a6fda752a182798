// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonds that flow, break, touch and are made anew give the same bits on any number of threads; and
// both ends of each bond, which keep their
// memories apart, remember the same to round-off.
#include <gtest/gtest.h>
#include <omp.h>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "support/beams.hpp"

namespace solidem::any_number_of_threads_test {

/// A bar hit at both ends so that it flows and breaks in many places at once, and closes again.
Setup shattered(FlowLaw flow, BeamLaw law) {
  auto setup = yielding_setup(2e-3, 0.01, flow, law);
  setup.get<RuptureParameters>() = breaking_at_strain(0.02);
  setup.get<RuptureParameters>()->minimal_bonds = 2;
  setup.get<ContactParameters>() = ContactParameters{};
  setup.get<ContactParameters>()->rebonding_pressure = 2e10;
  setup.all<GripParameters>() = {hold("left", face(0, false, 1))};
  setup.all<InitialVelocity>().push_back({between(1.5e-3, 2.2e-3), {150, 20, 0}});
  setup.all<InitialVelocity>().push_back({between(2.2e-3, 3e-3), {-200, 0, 30}});
  return setup;
}

class AnyNumberOfThreads : public testing::TestWithParam<std::tuple<FlowLaw, BeamLaw>> {};

TEST_P(AnyNumberOfThreads, gives_the_same_bits) {
  const auto [flow, law] = GetParam();
  const int before = omp_get_max_threads();
  const Specimen body = random_bar(1200);  // enough blocks for threads to share
  std::map<std::string, std::vector<double>> first;
  for (const int threads : {1, 2, 3, 4, 7}) {
    omp_set_num_threads(threads);
    Simulation simulation(shattered(flow, law), body);
    simulation.advance(250);
    auto state = simulation.save();
    for (const auto& [name, value] : simulation.observe().values) state["seen"].push_back(value);
    if (threads == 1) {
      first = state;
      std::printf("  %.0f bonds broken\n", seen(simulation, "broken_bonds"));
      EXPECT_GT(seen(simulation, "broken_bonds"), 50);
      EXPECT_GT(seen(simulation, "plastic_work"), 0);
    }
    ASSERT_EQ(state.size(), first.size());
    for (const auto& [name, values] : state)
      EXPECT_TRUE(values == first.at(name)) << name << " on " << threads << " threads";
  }
  omp_set_num_threads(before);
}

INSTANTIATE_TEST_SUITE_P(Laws, AnyNumberOfThreads,
                         testing::Values(std::tuple{FlowLaw::radial_return,
                                                    BeamLaw::euler_bernoulli},
                                         std::tuple{FlowLaw::scaled_offset, BeamLaw::timoshenko}));

class BothEnds : public testing::TestWithParam<FlowLaw> {};

TEST_P(BothEnds, of_a_bond_remember_the_same) {
  auto setup = shattered(GetParam(), BeamLaw::euler_bernoulli);
  Simulation simulation(setup, random_bar(300));
  double apart = 0;
  for (int n = 0; n < 10; ++n) {
    simulation.advance(100);
    const Model& model = simulation.model();
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<double>> low, high;
    model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
      std::vector<double> memory;
      for (const Column* column :
           {&columns::plastic_strain, &columns::plastic_extension, &columns::plastic_twist})
        memory.push_back(model.data(*column)[Model::at_slot(*column, row, lane)]);
      (i < j ? low : high)[{std::min(i, j), std::max(i, j)}] = memory;
    });
    ASSERT_EQ(low.size(), high.size());
    std::size_t flowed = 0;
    for (const auto& [pair, memory] : low) {
      const std::vector<double>& other = high.at(pair);
      for (std::size_t k = 0; k < memory.size(); ++k) {
        const double scale = k == 1 ? hand_radius : 1;
        apart = std::max(apart, std::fabs(memory[k] - other[k]) / scale);
      }
      if (memory[0] > 0) ++flowed;
    }
    EXPECT_GT(flowed, 10u);
    EXPECT_LT(imbalance_of_loads(simulation), 1e-12);
  }
  std::printf("  apart by %.1e\n", apart);
  EXPECT_LT(apart, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Laws, BothEnds,
                         testing::Values(FlowLaw::radial_return, FlowLaw::scaled_offset));

}  // namespace solidem::any_number_of_threads_test
