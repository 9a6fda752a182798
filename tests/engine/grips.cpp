// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "effects/grip_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "model/error.hpp"
#include "support/axis_controls.hpp"
#include "support/specimens.hpp"

namespace solidem::grips_test {

AxisControl pulled(double f) {
  return {AxisControl::Kind::force, TimeFunction::constant(f)};
}

GripParameters grip(const std::string& name, Region region, std::array<AxisControl, 3> axis) {
  return {name, std::move(region), std::move(axis), true};
}

TEST(Grips, work_is_the_energy_that_the_bar_gains) {
  std::vector<double> error;
  for (const double ratio : {0.2, 0.1}) {
    auto setup = elastic_setup();
    setup.run.time_step_ratio = ratio;
    setup.all<GripParameters>() = {grip("left", face(0, false), {held(), held(), held()}),
                                   grip("right", face(0, true), {moving(2), moving(0.3), held()})};
    Simulation simulation(setup, jittered("bcc", {8, 3, 3}));
    double worst = 0;
    for (int n = 0; n < 40; ++n) {
      simulation.advance(ratio == 0.2 ? 5 : 10);
      const HistoryRow row = simulation.observe();
      worst = std::max(worst, std::fabs(value_of(row, "energy_balance")));
    }
    error.push_back(worst / value_of(simulation.observe(), "external_work"));
  }
  std::printf("energy balance / work: %.2e, %.2e at half the step\n", error[0], error[1]);
  EXPECT_LT(error[0], 1e-3);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.2);
}

TEST(Grips, work_of_a_jump_at_the_start_is_the_energy_that_the_bar_gains) {
  auto setup = elastic_setup();
  setup.run.time_step_ratio = 0.2;
  constexpr double jump_length = 1e-7, strain = jump_length / 2e-4;
  const AxisControl jump{AxisControl::Kind::displacement, TimeFunction::constant(jump_length)};
  setup.all<GripParameters>() = {grip("left", face(0, false), {held(), held(), held()}),
                                 grip("right", face(0, true), {jump, held(), held()})};
  Simulation simulation(setup, jittered("bcc", {8, 3, 3}));
  simulation.advance(1);
  const double work = value_of(simulation.observe(), "external_work");
  EXPECT_GT(work, 0);
  for (int n = 0; n < 40; ++n) {
    simulation.advance(7);
    const HistoryRow row = simulation.observe();
    // Half by the force at either end of the jump is right to the strain that it brings to a bond.
    EXPECT_NEAR(value_of(row, "energy_balance"), 0, strain * work);
    EXPECT_NEAR(value_of(row, "external_work"), work, 1e-12 * work);  // it stands still since
  }
}

TEST(Grips, work_of_a_force_is_the_energy_that_the_bar_gains) {
  std::vector<double> error;
  for (const double ratio : {0.2, 0.1}) {
    auto setup = elastic_setup();
    setup.run.time_step_ratio = ratio;
    AxisControl swing{AxisControl::Kind::force, {{0.0}, {3.0}, 2.0, 3e5, 0.4}};
    setup.all<GripParameters>() = {grip("left", face(0, false), {held(), held(), held()}),
                                   grip("right", face(0, true), {swing, {}, pulled(0.1)})};
    Simulation simulation(setup, jittered("bcc", {8, 3, 3}));
    double worst = 0;
    for (int n = 0; n < 40; ++n) {
      simulation.advance(ratio == 0.2 ? 5 : 10);
      worst = std::max(worst, std::fabs(value_of(simulation.observe(), "energy_balance")));
    }
    error.push_back(worst / std::fabs(value_of(simulation.observe(), "external_work")));
  }
  std::printf("energy balance / work: %.2e, %.2e at half the step\n", error[0], error[1]);
  EXPECT_LT(error[0], 1e-2);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.3);
}

TEST(Grips, a_force_gives_a_free_bar_its_momentum) {
  auto setup = elastic_setup();
  setup.all<GripParameters>() = {grip("pull", face(0, true), {pulled(5), {}, {}})};
  setup.all<GripParameters>()[0].rotation_fixed = false;
  Simulation simulation(setup, jittered("bcc", {6, 3, 3}));
  simulation.advance(777);
  Observation seen;
  simulation.observe(seen);
  double momentum = 0;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    momentum += seen.motion.velocity[i].x / simulation.model().data(columns::inverse_mass)[i];
  EXPECT_NEAR(momentum / (5 * simulation.time()), 1, 1e-12);
}

TEST(Grips, moving_a_whole_bar_strains_nothing) {
  auto setup = elastic_setup();
  setup.all<InitialVelocity>().push_back({{}, {1, 2, 3}});
  setup.all<GripParameters>() = {grip("left", face(0, false), {moving(1), moving(2), moving(3)}),
                                 grip("right", face(0, true), {moving(1), moving(2), moving(3)})};
  Simulation simulation(setup, jittered("bcc", {6, 3, 3}));
  simulation.advance(500);
  const HistoryRow row = simulation.observe();
  EXPECT_LT(value_of(row, "elastic_energy") / value_of(row, "kinetic_energy"), 1e-20);
  EXPECT_NEAR(value_of(row, "grip.left.displacement_y"), 2 * simulation.time(), 1e-18);
}

TEST(Grips, free_axes_follow_the_bar) {
  auto setup = elastic_setup();
  setup.all<GripParameters>() = {grip("left", face(0, false), {held(), held(), held()}),
                                 grip("right", face(0, true), {moving(5), {}, {}})};
  Simulation simulation(setup, crystal("bcc", {6, 3, 3}));
  simulation.advance(300);
  EXPECT_EQ(value_of(simulation.observe(), "grip.right.force_y"), 0);
  // The cross-section of the gripped end narrows: a lattice bar under tension contracts sideways.
  const Model& model = simulation.model();
  double narrowing = 0;
  for (const std::int32_t e : simulation.selections().at("grip.right")) {
    const auto i = static_cast<std::size_t>(e);
    const Vector& rest = model.specimen().position[i];
    narrowing += (rest.y - model.specimen().domain.upper.y / 2) *
                 (rest.y - model.data(columns::pose)[8 * i + 1]);
  }
  EXPECT_GT(narrowing, 0);
}

TEST(Grips, that_share_elements_are_refused) {
  auto setup = elastic_setup();
  setup.all<GripParameters>() = {grip("left", face(0, false, 3), {held(), held(), held()}),
                                 grip("all", {}, {held(), held(), held()})};
  try {
    Simulation(setup, crystal("bcc", {4, 3, 3}));
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("\"all\" and \"left\" share elements"), std::string::npos) << text;
  }
}

TEST(Grips, without_elements_are_refused) {
  auto setup = elastic_setup();
  Region nowhere;
  nowhere.kind = Region::Kind::box;
  nowhere.lower = {1, 1, 1};
  setup.all<GripParameters>() = {grip("lost", nowhere, {held(), held(), held()})};
  EXPECT_THROW(Simulation(setup, crystal("bcc", {4, 3, 3})), InputError);
}

TEST(Materials, an_element_outside_every_region_is_named) {
  auto setup = elastic_setup();
  setup.materials[0].region = face(0, false, 2);
  try {
    Simulation(setup, crystal("bcc", {4, 3, 3}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("lies in the region of no material"),
              std::string::npos);
  }
}

}  // namespace solidem::grips_test
