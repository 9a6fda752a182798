// SPDX-License-Identifier: GPL-2.0-or-later
//
// A thousand cycles far beyond yield: plastic work never falls, the stress stays on or below the
// yield surface, and without hardening each cycle is like the one before it.
#include <gtest/gtest.h>

#include "effects/grip_parameters.hpp"
#include "laws/constants.hpp"
#include "support/beams.hpp"

namespace solidem::thousand_plastic_cycles_test {

constexpr int cycles = 1000;
constexpr double yield_strain = 2e-3;
const double section = pi * std::pow(0.27 * hand_radius, 2);
constexpr double E = 3.5e12;

/// Two elements, the second moved to and fro along a direction; its amplitude in lengths.
Setup cyclic_setup(double hardening, FlowLaw flow, const Vector& amplitude, int steps_per_cycle) {
  auto setup = yielding_setup(yield_strain, hardening, flow);
  setup.run.time_step = 1e-9;
  const double frequency = 1e9 / steps_per_cycle;
  const auto wave = [&](double a) {
    return TimeFunction{{0.0}, {0.0}, 2 * hand_radius * a, frequency, 0};
  };
  setup.all<GripParameters>() = {
      hold("left", face(0, false)),
      hold("right", face(0, true), {wave(amplitude.x), wave(amplitude.y), wave(amplitude.z)})};
  return setup;
}

TEST(ThousandPlasticCycles, of_a_bond_in_tension_are_all_alike) {
  constexpr int steps = 200;
  Simulation simulation(cyclic_setup(0, FlowLaw::radial_return, {4 * yield_strain, 0, 0}, steps),
                        row_of(2));
  double work = 0, highest = 0;
  std::vector<double> second(steps / 20), last(steps / 20);
  double work_of_second = 0, work_of_last = 0;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const double before = work;
    for (std::size_t n = 0; n < second.size(); ++n) {
      simulation.advance(20);
      const HistoryRow row = simulation.observe();
      const double now = value_of(row, "plastic_work"), force = value_of(row, "grip.right.force_x");
      ASSERT_GE(now, work * (1 - 1e-12));
      work = now;
      highest = std::max(highest, std::fabs(force));
      if (cycle == 1) second[n] = force;
      if (cycle == cycles - 1) last[n] = force;
    }
    if (cycle == 1) work_of_second = work - before;
    if (cycle == cycles - 1) work_of_last = work - before;
  }
  double drift = 0;
  for (std::size_t n = 0; n < last.size(); ++n)
    drift = std::max(drift, std::fabs(last[n] - second[n]));
  const double limit = E * section * yield_strain;
  // A rectangle, twice as high as the yield force and as wide as the plastic part of the motion.
  const double exact = 2 * limit * 2 * (4 - 1) * yield_strain * 2 * hand_radius;
  std::printf(
      "  drift of the force %.1e, of the work %.1e; work of a cycle %.4f of the rectangle\n",
      drift / limit, work_of_last / work_of_second - 1, work_of_last / exact);
  EXPECT_LT(highest, limit * (1 + 1e-12));
  EXPECT_LT(drift, 1e-9 * limit);
  EXPECT_NEAR(work_of_last / work_of_second, 1, 1e-9);
  EXPECT_NEAR(work_of_last / exact, 1, 1e-3);
}

struct Case {
  const char* name;
  FlowLaw flow;
  double hardening;
  Vector amplitude;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class ThousandPlasticCycles : public testing::TestWithParam<Case> {};

TEST_P(ThousandPlasticCycles, of_a_bond_in_all_modes_stay_on_the_yield_surface) {
  const Case& c = GetParam();
  constexpr int steps = 200;
  Simulation simulation(cyclic_setup(c.hardening, c.flow, c.amplitude, steps), row_of(2));
  double work = 0, beyond = 0;
  std::vector<double> of_cycle;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const double before = work;
    for (int n = 0; n < steps; n += 20) {
      simulation.advance(20);
      const HistoryRow row = simulation.observe();
      const double now = value_of(row, "plastic_work");
      ASSERT_GE(now, work * (1 - 1e-12));
      work = now;
      // |F_x|/S alone is a lower bound of the equivalent stress.
      const double kappa = simulation.save().at("column.plastic_strain")[0];
      const double limit = yield_strain + c.hardening * kappa;
      beyond =
          std::max(beyond, std::fabs(value_of(row, "grip.right.force_x")) / (E * section) / limit);
    }
    of_cycle.push_back(work - before);
  }
  std::printf(
      "  %s: plastic work of cycle 2 %.3g J, of cycle %d %.3g J; |F|/S up to %.3f of the "
      "yield stress\n",
      c.name, of_cycle[1], cycles, of_cycle.back(), beyond);
  EXPECT_GT(of_cycle[0], 0);
  if (c.flow == FlowLaw::scaled_offset) {
    // The thesis' law flows no more once the largest strain is behind it.
    EXPECT_EQ(of_cycle[2], 0);
    EXPECT_EQ(of_cycle.back(), 0);
    return;
  }
  // The chord turns against the axis of the grips by the amplitude at most.
  EXPECT_LT(beyond, 1 + norm(c.amplitude));
  if (c.hardening == 0) {
    EXPECT_NEAR(of_cycle.back() / of_cycle[100], 1, 1e-6);
  } else {
    // Isotropic hardening widens the surface until all is elastic.
    EXPECT_LT(of_cycle.back(), 1e-12 * of_cycle[0]);
  }
}

constexpr double a = 4 * yield_strain;
INSTANTIATE_TEST_SUITE_P(
    Laws, ThousandPlasticCycles,
    testing::Values(Case{"tension, hardening", FlowLaw::radial_return, 0.05, {a, 0, 0}},
                    Case{"all modes", FlowLaw::radial_return, 0, {a, 6 * a, 3 * a}},
                    Case{"all modes, hardening", FlowLaw::radial_return, 0.05, {a, 6 * a, 3 * a}},
                    Case{"scaled offset", FlowLaw::scaled_offset, 0.01, {a, 6 * a, 3 * a}}));

TEST(ThousandPlasticCycles, of_a_body_flow_on_and_keep_their_books) {
  // Elements between the grips are free: flow never gives energy back, and all of it is counted.
  auto setup = yielding_setup(yield_strain, 0);
  setup.run.time_step_ratio = 0.5;
  const Specimen body = jittered("simple_cubic", {4, 2, 2}, 0.05);
  const double step = Simulation(setup, body).time_step().value;
  constexpr int steps = 500;
  const double length = body.domain.upper.x - body.domain.lower.x;
  const TimeFunction wave{{0.0}, {0.0}, 0.01 * length, 1 / (steps * step), 0};
  const TimeFunction still = TimeFunction::constant(0);
  setup.all<GripParameters>() = {hold("left", face(0, false)),
                                 hold("right", face(0, true), {wave, still, still})};
  Simulation simulation(setup, body);
  double work = 0, balance = 0;
  std::vector<double> of_cycle;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const double before = work;
    for (int n = 0; n < steps; n += 50) {
      simulation.advance(50);
      const HistoryRow row = simulation.observe();
      ASSERT_GE(value_of(row, "plastic_work"), work * (1 - 1e-12));
      work = value_of(row, "plastic_work");
      balance = std::max(balance, std::fabs(value_of(row, "energy_balance")));
    }
    of_cycle.push_back(work - before);
  }
  const auto mean = [&](int from) {
    double sum = 0;
    for (int n = from; n < from + 100; ++n) sum += of_cycle[static_cast<std::size_t>(n)] / 100;
    return sum;
  };
  std::printf(
      "  plastic work of a cycle %.4g J, then %.4g J, at last %.4g J; balance %.1e of all\n",
      of_cycle[0], mean(100), mean(cycles - 100), balance / work);
  EXPECT_GT(of_cycle[0], 0);
  EXPECT_GT(mean(cycles - 100), 0);
  EXPECT_LT(balance, 0.01 * work);
}

}  // namespace solidem::thousand_plastic_cycles_test
