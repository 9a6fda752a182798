// SPDX-License-Identifier: GPL-2.0-or-later
//
// Energy of bodies that flow, break and touch: kinetic + elastic + contact energy, plastic work and
// fracture energy add up to what was put in, the better the finer the step.
#include <gtest/gtest.h>

#include <memory>

#include "support/beams.hpp"

namespace solidem {
namespace {

/// A free bar that stretches, bends and twists at once, beyond yield.
std::unique_ptr<Simulation> struck_bar(Setup setup, double ratio, double speed) {
  setup.run.time_step_ratio = ratio;
  auto simulation = std::make_unique<Simulation>(setup, jittered("bcc", {8, 2, 2}));
  const Model& model = simulation->model();
  const Vector size = model.specimen().domain.upper;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector p = model.specimen().position[i] - 0.5 * size;
    const double wave = std::sin(3.14159265358979323846 * p.x / size.x);
    set_velocity(
        *simulation, i,
        speed * Vector{wave, wave * wave - 0.5 * wave * p.z / size.z, 0.5 * wave * p.y / size.y});
    if (setup.get<BeamParameters>()->law != BeamLaw::spring)
      set_spin(*simulation, i, {0.5 * speed * wave / size.y, 0, 0});
  }
  return simulation;
}

/// Slope of log(error) against log(step).
double fitted_order(const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double x = -static_cast<double>(k) * std::log(2.0), y = std::log(error[k]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto n = static_cast<double>(error.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct Case {
  const char* name;
  FlowLaw flow;
  BeamLaw law;
  double hardening;
  double speed = 60;  ///< m/s
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class EnergyOfFlow : public testing::TestWithParam<Case> {};

TEST_P(EnergyOfFlow, is_accounted_for_the_better_the_finer_the_step) {
  const Case& c = GetParam();
  std::vector<double> errors;
  double fraction = 0;
  for (const int halvings : {0, 1, 2, 3}) {
    const auto owner = struck_bar(yielding_setup(2e-3, c.hardening, c.flow, c.law),
                                  0.4 / (1 << halvings), c.speed);
    Simulation& simulation = *owner;
    const double start = seen(simulation, "kinetic_energy");
    double error = 0, work = 0;
    for (int n = 0; n < 300; ++n) {
      simulation.advance(1 << halvings);
      const HistoryRow row = simulation.observe();
      error = std::max(error, std::fabs(value_of(row, "energy_balance")) / start);
      if (c.flow == FlowLaw::radial_return) {
        ASSERT_GE(value_of(row, "plastic_work"), work - 1e-12 * start);
      }
      work = value_of(row, "plastic_work");
    }
    fraction = work / start;
    errors.push_back(error);
  }
  const double order = fitted_order(errors);
  std::printf("  %s: plastic work %.2f of the energy; balance %.1e, %.1e, %.1e, %.1e; order %.2f\n",
              c.name, fraction, errors[0], errors[1], errors[2], errors[3], order);
  EXPECT_GT(fraction, 0.1);
  EXPECT_LT(errors[3], 2e-3);
  // Each flow is counted with the load after it: of first order in the step.
  EXPECT_GT(order, 0.8);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, EnergyOfFlow,
    testing::Values(
        Case{"radial return", FlowLaw::radial_return, BeamLaw::euler_bernoulli, 0},
        Case{"radial return, hardening", FlowLaw::radial_return, BeamLaw::euler_bernoulli, 0.1},
        Case{"radial return, Timoshenko", FlowLaw::radial_return, BeamLaw::timoshenko, 0.01},
        Case{"radial return, springs", FlowLaw::radial_return, BeamLaw::spring, 0.01, 250},
        Case{"scaled offset", FlowLaw::scaled_offset, BeamLaw::euler_bernoulli, 0.01}));

TEST(EnergyOfFlow, is_that_of_the_elastic_body_where_nothing_yields) {
  // A yield strain that is never reached changes no bit of the motion.
  const auto flowing = struck_bar(yielding_setup(10, 0.1), 0.3, 20);
  const auto elastic = struck_bar(beam_setup(), 0.3, 20);
  flowing->advance(500);
  elastic->advance(500);
  EXPECT_EQ(seen(*flowing, "plastic_work"), 0);
  EXPECT_EQ(flowing->save().at("column.pose"), elastic->save().at("column.pose"));
  EXPECT_EQ(flowing->save().at("column.velocity"), elastic->save().at("column.velocity"));
}

class EnergyOfRupture : public testing::TestWithParam<bool> {};

TEST_P(EnergyOfRupture, is_accounted_for_the_better_the_finer_the_step) {
  const bool flows = GetParam();
  std::vector<double> errors;
  double fraction = 0, broken = 0;
  for (const int halvings : {0, 1, 2, 3, 4}) {
    auto setup = flows ? yielding_setup(2e-3, 0.01) : beam_setup();
    setup.get<RuptureParameters>() = breaking_at_strain(flows ? 0.01 : 0.004);
    setup.get<ContactParameters>() = ContactParameters{};
    const auto owner = struck_bar(setup, 0.4 / (1 << halvings), 100);
    Simulation& simulation = *owner;
    const double start = seen(simulation, "kinetic_energy");
    double error = 0, fracture = 0;
    for (int n = 0; n < 200; ++n) {
      simulation.advance(1 << halvings);
      const HistoryRow row = simulation.observe();
      error = std::max(error, std::fabs(value_of(row, "energy_balance")) / start);
      ASSERT_GE(value_of(row, "fracture_energy"), fracture);
      fracture = value_of(row, "fracture_energy");
    }
    fraction = fracture / start;
    broken = seen(simulation, "broken_bonds");
    errors.push_back(error);
  }
  std::printf("  %s: %.0f bonds broken, fracture energy %.3f; balance %.1e … %.1e\n",
              flows ? "ductile" : "brittle", broken, fraction, errors.front(), errors.back());
  EXPECT_GT(broken, 10);
  EXPECT_GT(fraction, 0.001);
  // Which bonds break depends on the step, so there is no order to be seen from run to run.
  EXPECT_LT(errors.back(), 0.3 * errors.front());
}

INSTANTIATE_TEST_SUITE_P(Bodies, EnergyOfRupture, testing::Bool());

TEST(EnergyOfRupture, of_one_bond_is_what_it_stored) {
  // Drawn slowly to its limit, a bond of length l holds ½ E S l ε² when it breaks.
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(0.01);
  setup.run.time_step = 1e-9;
  setup.all<GripParameters>() = {hold("left", face(0, false)), pull("right", face(0, true), 0.5)};
  Simulation simulation(setup, row_of(2));
  simulation.advance(6000);
  ASSERT_EQ(seen(simulation, "broken_bonds"), 1);
  const double l = 2 * hand_radius, section = 3.14159265358979 * std::pow(0.27 * hand_radius, 2);
  const double expected = 0.5 * 3.5e12 * section * l * 1e-4;
  EXPECT_NEAR(seen(simulation, "fracture_energy"), expected, 1e-3 * expected);
  EXPECT_NEAR(seen(simulation, "external_work"), expected, 1e-3 * expected);
}

}  // namespace
}  // namespace solidem
