// SPDX-License-Identifier: GPL-2.0-or-later
//
// The step limit that solidem tells (power iteration on the kernels) against the true one, found by
// bisection on runs: for every law of beams, and where they may flow or break. Looking for the
// limit must leave no trace, however little a bond needs to flow or break.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "model/error.hpp"
#include "support/beams.hpp"

namespace solidem::step_limit_of_beams_test {

/// Sets every element in a motion too small for any limit, which has a part of every mode.
void disturb(Simulation& simulation) {
  constexpr double speed = 1e-9;  // m/s
  Model& model = simulation.model();
  double* velocity = model.data(columns::velocity);
  for (std::size_t k = 0; k < model.elements(); ++k)
    velocity[Model::at(columns::velocity, k, static_cast<int>(k % 3))] =
        speed * std::sin(static_cast<double>(k * k));
}

/// Whether a tiny disturbance grows at a step.
bool grows(Setup setup, const Specimen& body, double time_step) {
  setup.run.time_step = time_step;
  Simulation simulation(setup, body, true);
  disturb(simulation);
  const double start = seen(simulation, "kinetic_energy");
  try {
    for (int n = 0; n < 15; ++n) {
      simulation.advance(100);
      if (seen(simulation, "kinetic_energy") > 1e4 * start) return true;
    }
  } catch (const RunError&) {
    return true;
  }
  return false;
}

struct Case {
  const char* name;
  BeamLaw law = BeamLaw::euler_bernoulli;
  double radius_ratio = 0.27;
  BeamParameters::RadiusFrom radius_from = BeamParameters::RadiusFrom::mean;
  bool limited = false;
  FlowLaw flow = FlowLaw::radial_return;

  Setup setup() const {
    auto setup = beam_setup(law);
    setup.get<BeamParameters>()->radius_ratio = radius_ratio;
    setup.get<BeamParameters>()->radius_from = radius_from;
    if (limited) {
      setup.get<PlasticityParameters>() = PlasticityParameters{flow, LinearHardening{2e-3, 0.01}};
      setup.get<RuptureParameters>() = breaking_at_strain(0.1);
      setup.get<ContactParameters>() = ContactParameters{};
    }
    return setup;
  }
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class StepLimitOfBeams : public testing::TestWithParam<Case> {};

TEST_P(StepLimitOfBeams, is_met_by_the_estimate) {
  const auto setup = GetParam().setup();
  const Specimen body = random_bar(200);
  const TimeStepChoice choice = Simulation(setup, body).time_step();
  const double estimate = choice.limit;
  double low = 0.8 * estimate, high = 1.3 * estimate;
  ASSERT_FALSE(grows(setup, body, low));
  ASSERT_TRUE(grows(setup, body, high));
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (grows(setup, body, middle) ? high : low) = middle;
  }
  std::printf("  %s: estimate / true limit %.3f; true limit / criterion %.3f (%s)\n",
              GetParam().name, estimate / low, low / choice.bound, choice.criterion.c_str());
  EXPECT_NEAR(estimate / low, 1, 0.03);
}

constexpr auto mean_radius_of_body = BeamParameters::RadiusFrom::mean;
constexpr auto pair_radius = BeamParameters::RadiusFrom::pair;

INSTANTIATE_TEST_SUITE_P(
    Laws, StepLimitOfBeams,
    testing::Values(
        Case{"Euler-Bernoulli"}, Case{"thick", BeamLaw::euler_bernoulli, 0.8},
        Case{"Timoshenko", BeamLaw::timoshenko}, Case{"thick Timoshenko", BeamLaw::timoshenko, 0.8},
        Case{"spring", BeamLaw::spring},
        Case{"radius of the pair", BeamLaw::euler_bernoulli, 0.27, pair_radius},
        Case{"Timoshenko, radius of the pair", BeamLaw::timoshenko, 0.5, pair_radius},
        Case{"radial return", BeamLaw::euler_bernoulli, 0.27, mean_radius_of_body, true},
        Case{"scaled offset", BeamLaw::euler_bernoulli, 0.27, mean_radius_of_body, true,
             FlowLaw::scaled_offset},
        Case{"Timoshenko, radial return", BeamLaw::timoshenko, 0.27, mean_radius_of_body, true},
        Case{"spring, radial return", BeamLaw::spring, 0.27, mean_radius_of_body, true}));

TEST(StepLimitOfBeams, is_found_without_a_trace) {
  auto setup = yielding_setup(1e-9);
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(2e-9);
  const Simulation simulation(setup, random_bar(100));
  EXPECT_GT(simulation.time_step().limit, 0);
  EXPECT_EQ(seen(simulation, "plastic_work"), 0);
  EXPECT_LT(seen(simulation, "elastic_energy"), 1e-28);  // round-off of directions
  EXPECT_EQ(seen(simulation, "broken_bonds"), 0);
  const auto saved = simulation.save();
  for (const double strain : saved.at("column.plastic_strain")) EXPECT_EQ(strain, 0);
}

TEST(StepLimitOfBeams, is_that_of_the_elastic_body_whatever_may_flow) {
  const Specimen body = random_bar(150);
  const double elastic = Simulation(beam_setup(), body).time_step().limit;
  EXPECT_NEAR(Simulation(yielding_setup(), body).time_step().limit / elastic, 1, 1e-9);
  EXPECT_NEAR(Simulation(yielding_setup(1e-12), body).time_step().limit / elastic, 1, 1e-3);
}

TEST(StepLimitOfBeams, holds_while_the_body_flows) {
  // At .97 of the limit a bar is drawn far beyond yield: flow takes energy and must bring none.
  for (const FlowLaw flow : {FlowLaw::radial_return, FlowLaw::scaled_offset}) {
    auto setup = yielding_setup(2e-3, 0.01, flow);
    const Specimen body = random_bar(150);
    setup.run.time_step = 0.97 * Simulation(setup, body).time_step().limit;
    setup.all<GripParameters>() = {hold("left", face(0, false)), pull("right", face(0, true), 20)};
    Simulation simulation(setup, body);
    double highest = 0;
    while (simulation.time() < 5e-6) {
      simulation.advance(20);
      const HistoryRow row = simulation.observe();
      const double work = value_of(row, "external_work");
      highest = std::max(highest, std::fabs(value_of(row, "energy_balance")) / work);
      ASSERT_LT(value_of(row, "kinetic_energy") + value_of(row, "elastic_energy"), 1.1 * work);
    }
    std::printf("  %s: plastic work %.2f of the work, balance within %.1e\n",
                flow == FlowLaw::radial_return ? "radial return" : "scaled offset",
                seen(simulation, "plastic_work") / seen(simulation, "external_work"), highest);
    EXPECT_GT(seen(simulation, "plastic_work"), 0.3 * seen(simulation, "external_work"));
  }
}

TEST(StepLimitOfBeams, counts_stiff_contacts) {
  // Two elements whose bond is broken and that meet: the contact is 25 times as stiff as the bond.
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(1e-3);
  setup.get<ContactParameters>() = ContactParameters{};
  setup.get<ContactParameters>()->stiffness_ratio = 25;
  const Specimen two = row_of(2);
  setup.run.time_step_ratio = 1e-3;
  const double limit = Simulation(setup, two).time_step().limit;
  setup.get<ContactParameters>().reset();
  const double of_bonds = Simulation(setup, two).time_step().limit;
  EXPECT_LT(limit, 0.21 * of_bonds);
}

}  // namespace solidem::step_limit_of_beams_test
