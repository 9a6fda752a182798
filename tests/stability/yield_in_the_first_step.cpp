// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bond that goes from rest to a hundred times its yield strain within the first step: the state
// after it is that of the law, both ends agree, and nothing is created.
#include <gtest/gtest.h>

#include "laws/beam_flow.hpp"
#include "support/beams.hpp"

namespace solidem::yield_in_the_first_step_test {

class YieldInTheFirstStep : public testing::TestWithParam<std::tuple<FlowLaw, BeamLaw>> {};

/// Velocities that strain the bond of two elements by so much of its length (and turn) in a step.
void strike(Simulation& simulation, double size) {
  const double l = 2 * hand_radius, rate = size / simulation.time_step().value;
  set_velocity(simulation, 0, (-rate * l) * Vector{0.2, 0.1, -0.05});
  set_velocity(simulation, 1, (rate * l) * Vector{0.2, 0.1, -0.05});
  set_spin(simulation, 0, rate * Vector{0.1, -0.2, 0.3});
  set_spin(simulation, 1, rate * Vector{-0.3, 0.1, -0.1});
}

TEST_P(YieldInTheFirstStep, is_the_response_of_the_law) {
  const auto [flow, law] = GetParam();
  auto setup = yielding_setup(2e-3, 0.01, flow, law);
  Simulation simulation(setup, row_of(2));
  strike(simulation, 1);
  simulation.advance(1);
  // The pose is now where the velocities led; the next kick is by the load of the law there.
  const double* pose = simulation.model().data(columns::pose);
  const auto orientation = [&](int i) {
    const double* row = pose + std::ptrdiff_t{8} * i;
    return Quaternion<double>{row[4], {row[5], row[6], row[7]}};
  };
  const double l = 2 * hand_radius, r = 0.27 * hand_radius;
  const BeamSection<double> section{3.5e12, 1.35e12, r};
  const YieldingBeam<double> beam{law == BeamLaw::timoshenko ? timoshenko_rigidity(section, l, 0.9)
                                                             : euler_bernoulli_rigidity(section),
                                  l, r, 1.35 / 3.5};
  const LinearHardening hardening{2e-3, 0.01};
  const YieldCurve<LinearHardening, double> yield{hardening};
  const Vector x{1, 0, 0}, chord = centre_of(simulation, 1) - centre_of(simulation, 0);
  const auto expected =
      flow_response(flow, yield, beam, unyielded(x), x, {chord, orientation(0), orientation(1)});
  ASSERT_GT(expected.history.strain, 0.1);

  const Model& model = simulation.model();
  const auto velocity_of = [&](std::size_t i) {
    const double* v = model.data(columns::velocity);
    return Vector{v[Model::at(columns::velocity, i, 0)], v[Model::at(columns::velocity, i, 1)],
                  v[Model::at(columns::velocity, i, 2)]};
  };
  const auto spin_of = [&](std::size_t i) {
    const double* w = model.data(columns::angular_velocity);
    return Vector{w[Model::at(columns::velocity, i, 0)], w[Model::at(columns::velocity, i, 1)],
                  w[Model::at(columns::velocity, i, 2)]};
  };
  const Vector v0 = velocity_of(0), v1 = velocity_of(1), w0 = spin_of(0), w1 = spin_of(1);
  simulation.advance(1);
  const double dt = simulation.time_step().value;
  const double by_force = dt * model.data(columns::inverse_mass)[0];
  const double by_moment = dt * model.data(columns::inverse_inertia)[0];
  const double force = norm(expected.load.force), moment = norm(expected.load.moment_i);
  const auto off = [](const Vector& a, const Vector& b) { return norm(a - b); };
  // What is kicked is small against the velocity itself: round-off of the difference counts.
  const double round_off = 1e-15 * (norm(v0) / by_force), turned = 1e-15 * (norm(w0) / by_moment);
  const double tolerance = 1e-11;
  EXPECT_LT(off((1 / by_force) * (velocity_of(0) - v0), expected.load.force),
            tolerance * force + round_off);
  EXPECT_LT(off((1 / by_force) * (velocity_of(1) - v1), -expected.load.force),
            tolerance * force + round_off);
  EXPECT_LT(off((1 / by_moment) * (spin_of(0) - w0), expected.load.moment_i),
            tolerance * moment + turned);
  EXPECT_LT(off((1 / by_moment) * (spin_of(1) - w1), expected.load.moment_j),
            tolerance * moment + turned);
  EXPECT_NEAR(simulation.save().at("column.plastic_strain")[0], expected.history.strain,
              1e-12 * expected.history.strain);
  EXPECT_GE(seen(simulation, "plastic_work"), expected.plastic_work * (1 - 1e-12));
}

TEST_P(YieldInTheFirstStep, stays_finite_and_takes_the_energy_away) {
  const auto [flow, law] = GetParam();
  Simulation simulation(yielding_setup(2e-3, 0.01, flow, law), row_of(2));
  strike(simulation, 0.1);
  const double energy = seen(simulation, "kinetic_energy");
  double work = 0;
  for (int n = 0; n < 2000; ++n) {
    simulation.advance(1);
    const HistoryRow row = simulation.observe();
    if (flow == FlowLaw::radial_return) {
      ASSERT_GE(value_of(row, "plastic_work"), work * (1 - 1e-12));
    }
    work = value_of(row, "plastic_work");
    ASSERT_LT(value_of(row, "kinetic_energy") + value_of(row, "elastic_energy"), 1.5 * energy);
  }
  std::printf("  plastic work %.3f of the energy, balance %.1e\n", work / energy,
              seen(simulation, "energy_balance") / energy);
  EXPECT_GT(work, 0.1 * energy);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, YieldInTheFirstStep,
    testing::Combine(testing::Values(FlowLaw::radial_return, FlowLaw::scaled_offset),
                     testing::Values(BeamLaw::euler_bernoulli, BeamLaw::timoshenko)));

}  // namespace solidem::yield_in_the_first_step_test
