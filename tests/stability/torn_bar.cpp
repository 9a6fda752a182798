// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bar torn at 1 and at 100 m/s: it ends in two pieces, everything stays finite, no bond and no
// contact makes momentum, and the energy is accounted for.
#include <gtest/gtest.h>

#include <memory>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "support/beams.hpp"

namespace solidem::torn_bar_test {

struct Case {
  const char* name;
  double speed;  ///< m/s
  bool flows;
  bool touches;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

Setup breaking_setup(const Case& c) {
  auto setup = c.flows ? yielding_setup(2e-3, 0.007) : beam_setup();
  setup.get<RuptureParameters>() = breaking_at_strain(c.flows ? 0.03 : 0.01);
  if (c.touches) setup.get<ContactParameters>() = ContactParameters{};
  return setup;
}

class TornBar : public testing::TestWithParam<Case> {};

TEST_P(TornBar, ends_in_two_pieces_with_its_energy_accounted_for) {
  const Case& c = GetParam();
  auto setup = breaking_setup(c);
  setup.all<GripParameters>() = {hold("left", face(0, false, 1.5)),
                                 pull("right", face(0, true, 1.5), c.speed)};
  const Specimen body = random_bar(250);
  Simulation simulation(setup, body);
  const double time = (c.flows ? 0.06 : 0.03) * 3e-3 / c.speed;
  const auto steps = static_cast<std::int64_t>(time / simulation.time_step().value);
  double worst_balance = 0, worst_imbalance = 0, last_plastic = 0, last_fracture = 0;
  const std::int64_t every = std::max<std::int64_t>(1, steps / 400);
  const std::size_t pieces_before = pieces_of(simulation).size();
  while (simulation.step() < steps ||
         (pieces_of(simulation)[1] < 20 && simulation.step() < 4 * steps)) {
    simulation.advance(every);
    const HistoryRow row = simulation.observe();  // throws if anything is not finite
    const double work = value_of(row, "external_work");
    worst_balance = std::max(worst_balance, std::fabs(value_of(row, "energy_balance")));
    worst_imbalance = std::max(worst_imbalance, imbalance_of_loads(simulation));
    const double fracture = value_of(row, "fracture_energy");
    EXPECT_GE(fracture, last_fracture);
    last_fracture = fracture;
    if (c.flows) {
      EXPECT_GE(value_of(row, "plastic_work"), last_plastic * (1 - 1e-12));
      last_plastic = value_of(row, "plastic_work");
    }
    ASSERT_GT(work, 0);
  }
  const HistoryRow row = simulation.observe();
  const std::vector<std::size_t> pieces = pieces_of(simulation);
  std::printf(
      "  %s: %zu pieces, the largest of %zu and %zu of %zu elements, %.0f bonds broken in %lld "
      "steps; balance %.1e of the work, loads %.1e\n",
      c.name, pieces.size(), pieces[0], pieces[1], body.size(), value_of(row, "broken_bonds"),
      static_cast<long long>(simulation.step()), worst_balance / value_of(row, "external_work"),
      worst_imbalance);
  EXPECT_GT(pieces.size(), pieces_before);
  EXPECT_GE(pieces[1], 20u);
  EXPECT_GT(pieces[0] + pieces[1], body.size() / 2);
  // Bonds break within steps: a balance of first order in the step.
  EXPECT_LT(worst_balance, 0.02 * value_of(row, "external_work"));
  EXPECT_LT(worst_imbalance, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Speeds, TornBar,
    testing::Values(Case{"brittle, 1 m/s", 1, false, false},
                    Case{"brittle, 100 m/s", 100, false, false},
                    Case{"ductile, 1 m/s", 1, true, false},
                    Case{"ductile, 100 m/s", 100, true, false},
                    Case{"ductile, 1 m/s, crack faces in contact", 1, true, true},
                    Case{"ductile, 100 m/s, crack faces in contact", 100, true, true}));

TEST(TornBar, that_tears_itself_keeps_its_momentum) {
  // The bar flies apart by its own motion: nothing from outside, so momentum is kept while bonds
  // flow and break and crack faces meet.
  for (const bool flows : {false, true}) {
    auto setup = breaking_setup({"free", 0, flows, true});
    Simulation simulation(setup, random_bar(250));
    Model& model = simulation.model();
    for (std::size_t i = 0; i < model.elements(); ++i) {
      const Vector p = model.specimen().position[i];
      // Stretching, with some rotation and drift.
      set_velocity(simulation, i, {2e5 * (p.x - 1.5e-3) + 5, 3e4 * p.x, 1e4 * p.y - 2e4 * p.x});
    }
    const Momenta start = momenta_of(simulation);
    const double energy = seen(simulation, "kinetic_energy");
    double balance = 0;
    for (int n = 0; n < 40; ++n) {
      simulation.advance(50);
      balance = std::max(balance, std::fabs(seen(simulation, "energy_balance")));
    }
    const Momenta end = momenta_of(simulation);
    std::printf("  %s: %.0f bonds broken, %zu pieces; momentum %.1e, angular %.1e, energy %.1e\n",
                flows ? "ductile" : "brittle", seen(simulation, "broken_bonds"),
                pieces_of(simulation).size(), norm(end.linear - start.linear) / start.linear_scale,
                norm(end.angular - start.angular) / start.angular_scale, balance / energy);
    EXPECT_GT(seen(simulation, "broken_bonds"), 20);
    EXPECT_LT(norm(end.linear - start.linear), 1e-12 * start.linear_scale);
    EXPECT_LT(norm(end.angular - start.angular), 1e-12 * start.angular_scale);
    EXPECT_LT(balance, 0.02 * energy);
  }
}

}  // namespace solidem::torn_bar_test
