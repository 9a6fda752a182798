// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/energy_gained.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/initial_velocities.hpp"
#include "support/central_forces.hpp"

namespace solidem::energy_gained_test {

/// The note on a crystal of elements that attract each other, through which some of them were shot.
std::optional<std::string> note_on_a_shot(double speed, double ratio) {
  auto setup = central_setup(usual<LennardJones>());
  setup.run.time_step_ratio = ratio;
  InitialVelocity shot;
  shot.region.kind = Region::Kind::box;
  shot.region.lower = {1.5e-4, 1.5e-4, 1.5e-4};
  shot.region.upper = {4e-4, 4e-4, 4e-4};
  shot.velocity = {speed, 0.1 * speed, 0};
  setup.all<InitialVelocity>().push_back(shot);
  Simulation simulation(setup, crystal("fcc", {3, 3, 3}));
  simulation.advance(std::lround(12 / ratio));
  return note_on_gained_energy(simulation.observe(), simulation.round_off_energy());
}

TEST(EnergyGained, is_told_where_steps_were_too_long) {
  EXPECT_FALSE(note_on_a_shot(0, 0.5));
  EXPECT_FALSE(note_on_a_shot(1e3, 0.5));
  const auto note = note_on_a_shot(4.4e3, 0.5);
  ASSERT_TRUE(note);
  EXPECT_NE(note->find("came from nothing (energy_balance)"), std::string::npos) << *note;
  EXPECT_FALSE(note_on_a_shot(4.4e3, 0.05));
}

TEST(EnergyGained, looks_at_gains_above_round_off_alone) {
  const auto row = [](double balance) {
    return HistoryRow{1,
                      1e-6,
                      {{"kinetic_energy", 2},
                       {"elastic_energy", -4},
                       {"energy_balance", balance},
                       {"broken_bonds", 1e9}}};
  };
  EXPECT_TRUE(note_on_gained_energy(row(0.09), 0));
  EXPECT_FALSE(note_on_gained_energy(row(0.07), 0));
  EXPECT_FALSE(note_on_gained_energy(row(-3), 0));
  EXPECT_FALSE(note_on_gained_energy(row(0.09), 1));
  EXPECT_FALSE(note_on_gained_energy({1, 1e-6, {{"thermal_energy", 2}}}, 0));
}

}  // namespace solidem::energy_gained_test
