// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bond without stiffness is no bond: as the stiffness goes to zero, elements move as if there
// were none, and nothing is divided by it.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "laws/beam_flow.hpp"
#include "laws/rigid_sphere.hpp"
#include "support/beams.hpp"

namespace solidem::bond_without_stiffness_test {

TEST(BondWithoutStiffness, has_no_load_and_no_energy) {
  const BeamRigidity<double> none{0, 0, 0, 0};
  const Vector direction{0.6, 0.64, 0.48};
  const auto a = turn<double>({}, {0.3, -0.2, 0.5}, 1), b = turn<double>({}, {-0.1, 0.4, 0.2}, 1);
  const YieldingBeam<double> beam{none, 2e-4, 3e-5, 0.4};
  const LinearHardening law{2e-3, 0};
  const YieldCurve<LinearHardening, double> yield{law};
  const auto respond = [&](FlowRule rule) {
    return flow_response(rule, yield, beam, unyielded(direction), direction,
                         {{3e-4, 1e-4, 0}, a, b});
  };
  const auto flowing = respond(FlowRule::radial_return), offset = respond(FlowRule::scaled_offset);
  const auto elastic = beam_load<double>(none, 2e-4, beam_pose({3e-4, 1e-4, 0}, direction, a, b));
  for (const BeamLoad<double>& load : {flowing.load, offset.load, elastic}) {
    EXPECT_EQ(norm(load.force), 0);
    EXPECT_EQ(norm(load.moment_i), 0);
    EXPECT_EQ(norm(load.moment_j), 0);
  }
  EXPECT_EQ(flowing.energy, 0);
  EXPECT_EQ(flowing.plastic_work, 0);
  EXPECT_EQ(offset.plastic_work, 0);
}

/// Three elements that drift apart and spin.
Simulation* drifting(const Setup& setup, const Specimen& body) {
  auto* simulation = new Simulation(setup, body);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<double>(i);
    set_velocity(*simulation, i, {3 * k, 1 - k, 0.5 * k * k});
    if (simulation->model().has(columns::angular_velocity))
      set_spin(*simulation, i, {1e4 * k, -2e4, 3e4 * (1 - k)});
  }
  return simulation;
}

class BondWithoutStiffness : public testing::TestWithParam<std::pair<BeamLaw, bool>> {};

TEST_P(BondWithoutStiffness, moves_nothing) {
  const auto [law, limited] = GetParam();
  auto setup = limited ? yielding_setup(2e-3, 0.01, FlowLaw::radial_return, law) : beam_setup(law);
  setup.run.time_step = 1e-9;
  setup.get<BeamParameters>()->young_modulus = 1e-250;
  setup.get<BeamParameters>()->shear_modulus = law == BeamLaw::spring ? 0 : 4e-251;
  const std::unique_ptr<Simulation> bonded(drifting(setup, row_of(3)));
  Specimen apart = row_of(3);
  apart.bonds.clear();
  const std::unique_ptr<Simulation> free(drifting(setup, apart));
  bonded->advance(5000);
  free->advance(5000);
  const auto with = bonded->save(), without = free->save();
  for (const char* column : {"column.pose", "column.velocity"})
    for (std::size_t k = 0; k < with.at(column).size(); ++k)
      ASSERT_NEAR(with.at(column)[k], without.at(column)[k], 1e-200) << column;
}

INSTANTIATE_TEST_SUITE_P(Laws, BondWithoutStiffness,
                         testing::Values(std::pair{BeamLaw::euler_bernoulli, false},
                                         std::pair{BeamLaw::timoshenko, false},
                                         std::pair{BeamLaw::spring, false},
                                         std::pair{BeamLaw::euler_bernoulli, true},
                                         std::pair{BeamLaw::timoshenko, true}));

TEST(BondWithoutStiffness, that_is_broken_is_no_bond) {
  // Broken in the first step, a bond leaves its elements to fly on.
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(1e-9);
  setup.run.time_step_ratio = 0.01;
  const std::unique_ptr<Simulation> simulation(drifting(setup, row_of(3)));
  simulation->advance(2);
  ASSERT_EQ(seen(*simulation, "broken_bonds"), 2);
  const auto velocity = simulation->save().at("column.velocity");
  simulation->advance(1000);
  EXPECT_EQ(simulation->save().at("column.velocity"), velocity);
  EXPECT_EQ(seen(*simulation, "elastic_energy"), 0);
}

}  // namespace solidem::bond_without_stiffness_test
