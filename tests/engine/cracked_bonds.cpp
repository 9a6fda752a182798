// SPDX-License-Identifier: GPL-2.0-or-later
//
// Micro-cracks among bonded elements, and free faces that count as such or do not.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "support/beams.hpp"
#include "support/central_forces.hpp"

namespace solidem::cracked_bonds_test {

constexpr double gap = 2.6;  // radii, between the middles of two blocks: beyond the range of 2.4

/// Two blocks of 3 × 3 × 3 elements, and one bond across the gap, between the middles of the faces.
Specimen bridged_blocks() {
  std::vector<Vector> places = lattice({3, 3, 3});
  const Vector right{(4 + gap) * hand_radius, 0, 0};
  for (const Vector& place : lattice({3, 3, 3}, 2, 0, right)) places.push_back(place);
  Specimen specimen = string_of(places);
  specimen.bonds.clear();
  const auto count = static_cast<std::int32_t>(places.size());
  for (std::int32_t i = 0; i < count; ++i)
    for (std::int32_t j = i + 1; j < count; ++j) {
      const Vector chord =
          places[static_cast<std::size_t>(j)] - places[static_cast<std::size_t>(i)];
      const bool bridges = chord.x > 2.1 * hand_radius && chord.x < 1.01 * gap * hand_radius &&
                           chord.y == 0 && chord.z == 0;
      const Vector& from = places[static_cast<std::size_t>(i)];
      const bool in_the_middle = from.y == 2 * hand_radius && from.z == 2 * hand_radius;
      if (norm(chord) < 2.1 * hand_radius || (bridges && in_the_middle))
        specimen.bonds.push_back({i, j});
    }
  return specimen;
}

/// The right block moves away, or towards the left one, by a strain of the bridge.
Setup moving_apart(double strain, bool leaves_out_free_faces) {
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_strain(10);
  DamageParameters damage;
  damage.crack_threshold = 0.3;
  damage.leaves_out_free_faces = leaves_out_free_faces;
  setup.get<DamageParameters>() = damage;
  const auto still = TimeFunction::constant(0);
  const TimeFunction way = TimeFunction::constant(strain * gap * hand_radius);
  const double middle = (4 + 0.5 * gap) * hand_radius;
  setup.all<GripParameters>() = {hold("left", between(-1, middle)),
                                 hold("right", between(middle, 1), {way, still, still})};
  setup.run.time_step_ratio = 0.1;
  return setup;
}

TEST(CrackedBonds, break_in_tension_between_opposite_faces_and_bear_pressure) {
  for (const double strain : {1e-4, -1e-4}) {
    Simulation simulation(moving_apart(strain, false), bridged_blocks());
    // All elements but the one in the middle of each block stand on faces.
    EXPECT_EQ(seen(simulation, "crack_faces"), 52);
    simulation.advance(3);
    EXPECT_EQ(seen(simulation, "broken_bonds"), strain > 0 ? 1 : 0);
    const double force = seen(simulation, "grip.right.force_x");
    if (strain > 0)
      EXPECT_EQ(force, 0);
    else
      EXPECT_LT(force, 0);
    // What the bridge stored is what its rupture took.
    EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 1e-3 * seen(simulation, "external_work"));
  }
}

TEST(CrackedBonds, of_free_faces_hold_where_these_are_left_out) {
  Simulation simulation(moving_apart(1e-4, true), bridged_blocks());
  simulation.advance(3);
  EXPECT_EQ(seen(simulation, "crack_faces"), 0);
  EXPECT_EQ(seen(simulation, "broken_bonds"), 0);
  EXPECT_GT(seen(simulation, "grip.right.force_x"), 0);
}

TEST(CrackedBonds, are_those_of_a_face_that_opens_where_free_faces_are_left_out) {
  // The blocks touch at the start; once they are apart, the nine elements on either side have lost
  // a neighbour each, and the corners and rims of the other faces have not.
  std::vector<Vector> places = lattice({6, 3, 3});
  auto setup = central_setup(usual<Piecewise>(), 1.3);
  setup.get<CentralForceParameters>()->equilibrium = CentralForceParameters::Equilibrium::radii;
  DamageParameters damage;
  damage.crack_threshold = 0.3;
  damage.leaves_out_free_faces = true;
  setup.get<DamageParameters>() = damage;
  const auto still = TimeFunction::constant(0);
  const double middle = 5 * hand_radius;
  setup.all<GripParameters>() = {
      hold("left", between(-1, middle)),
      hold("right", between(middle, 1), {TimeFunction::constant(2 * hand_radius), still, still})};
  setup.run.time_step = 1e-9;
  Simulation simulation(setup, elements_at(places));
  EXPECT_EQ(seen(simulation, "crack_faces"), 0);
  simulation.advance(2);
  EXPECT_EQ(seen(simulation, "crack_faces"), 18);
}

}  // namespace solidem::cracked_bonds_test
