// SPDX-License-Identifier: GPL-2.0-or-later
//
// An element that moves further than its radius in a step passes others unseen, at whatever energy.
// It is told before the first such step, or within 256 steps; a body that flies as a whole may fly
// as fast as it likes, and so may what meets nobody.
#include <gtest/gtest.h>

#include "model/error.hpp"
#include "scene/scene_text.hpp"
#include "support/central_forces.hpp"

namespace solidem::test::elements_that_leap_test {

constexpr double time_step = 2e-9;                         // s
constexpr double radius_a_step = hand_radius / time_step;  // m/s

/// What stops a run of 256 steps, with one element of a lattice at a speed among others at another;
/// nothing: it goes on.
std::string stopped(Setup setup, double of_one, double of_others) {
  setup.run.time_step = time_step;
  Simulation simulation(setup, elements_at(lattice({4, 4, 4})), true);
  for (std::size_t i = 0; i < 64; ++i) launch(simulation, i, {i == 21 ? of_one : of_others, 0, 0});
  try {
    simulation.advance(256);
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

TEST(ElementsThatLeap, are_told_before_they_pass_through_a_crystal) {
  for (const CentralLaw& law : usual_laws()) {
    const std::string told = stopped(central_setup(law), 2 * radius_a_step, 0);
    EXPECT_NE(told.find("at step 0 "), std::string::npos) << name_of(law) << told;
    EXPECT_NE(told.find("element 21 moves 1.9"), std::string::npos) << told;
    EXPECT_NE(told.find("expected one of at most 1.0"), std::string::npos) << told;
  }
}

TEST(ElementsThatLeap, are_told_where_a_push_makes_them_so_fast) {
  auto setup = central_setup();
  setup.run.time_step = time_step;
  Simulation simulation(setup, elements_at(lattice({4, 4, 4})), true);
  simulation.advance(10);
  launch(simulation, 21, {0, 30 * radius_a_step, 0});
  EXPECT_THROW(simulation.advance(256), RunError);
}

TEST(ElementsThatLeap, do_not_when_all_fly_alike) {
  EXPECT_EQ(stopped(central_setup(), 20 * radius_a_step, 20 * radius_a_step), "");
}

TEST(ElementsThatLeap, are_told_where_they_would_touch) {
  const auto grains =
      read_text_scene(
          "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [1, 1, 1]\n"
          "element_radius = \"0.1 mm\"\n[material]\ndensity = \"2790 kg/m^3\"\n"
          "[contact]\nnormal_stiffness = \"100 kN/m\"\n[run]\nsteps = 1\n")
          .setup;
  EXPECT_NE(stopped(grains, 2 * radius_a_step, 0).find("element 21 moves"), std::string::npos);
  EXPECT_EQ(stopped(grains, 0.9 * radius_a_step / 64, 0), "");
}

}  // namespace solidem::test::elements_that_leap_test
