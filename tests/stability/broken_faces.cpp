// SPDX-License-Identifier: GPL-2.0-or-later
//
// After rupture: broken faces that meet push each other back, pairs that overlapped from the start
// are not thrown apart, and faces pressed together hard enough are bonded anew, free of load.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "laws/constants.hpp"
#include "support/beams.hpp"

namespace solidem::broken_faces_test {

constexpr double stiffness = 3.5e12;

/// Two elements, a distance of so many radii apart, the second led along x by a table of
/// displacements at thousands of steps.
Setup led(const std::vector<double>& places, bool touches = true) {
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(0.01);
  if (touches) setup.get<ContactParameters>() = ContactParameters{};
  setup.run.time_step = 1e-9;
  auto right = hold("right", face(0, true));
  right.axis[0].function = {{}, {}};
  for (std::size_t k = 0; k < places.size(); ++k) {
    right.axis[0].function.time.push_back(1e-6 * static_cast<double>(k));
    right.axis[0].function.value.push_back(places[k]);
  }
  setup.all<GripParameters>() = {hold("left", face(0, false)), right};
  return setup;
}

const double section = pi * std::pow(0.27 * hand_radius, 2);

/// The force that the second grip pulls with after so many thousand steps.
double pulled_with(Simulation& simulation, int thousands) {
  simulation.advance(1000 * thousands - simulation.step());
  return seen(simulation, "grip.right.force_x");
}

TEST(BrokenLips, push_where_they_meet_and_never_pull) {
  const double l = 2 * hand_radius;
  Simulation simulation(led({0, 0.02 * l, 0.02 * l, 0, -0.001 * l, 0.005 * l}), row_of(2));
  EXPECT_EQ(pulled_with(simulation, 1), 0);  // broken on the way
  EXPECT_EQ(seen(simulation, "broken_bonds"), 1);
  EXPECT_EQ(pulled_with(simulation, 2), 0);
  const double closed = pulled_with(simulation, 3);
  const double pushed = pulled_with(simulation, 4);
  const double expected = -stiffness * section * 0.001;
  EXPECT_NEAR(closed, 0, 1e-9 * std::fabs(expected));
  EXPECT_NEAR(pushed, expected, 1e-6 * std::fabs(expected));
  EXPECT_EQ(pulled_with(simulation, 5), 0);
}

TEST(BrokenLips, that_overlapped_at_the_start_touch_at_their_first_distance) {
  // 20 % of overlap: pushed apart from the radii's sum they would hold the energy of .2 l.
  const double distance = 1.8, l = distance * hand_radius;
  Simulation simulation(led({0, 0.02 * l, 0.02 * l, 0, -0.001 * l}), row_of(2, distance));
  EXPECT_EQ(pulled_with(simulation, 1), 0);
  EXPECT_EQ(seen(simulation, "broken_bonds"), 1);
  EXPECT_EQ(seen(simulation, "contact_energy"), 0);
  const double pushed = pulled_with(simulation, 4);
  const double expected = -stiffness * section * 0.001;
  EXPECT_NEAR(pushed, expected, 1e-6 * std::fabs(expected));
}

TEST(BrokenLips, that_stood_apart_touch_where_the_spheres_meet) {
  const double distance = 2.2, l = distance * hand_radius, gap = 0.2 * hand_radius;
  Simulation simulation(led({0, 0.02 * l, 0, -gap, -gap - 0.001 * l}), row_of(2, distance));
  EXPECT_EQ(pulled_with(simulation, 2), 0);
  EXPECT_EQ(seen(simulation, "broken_bonds"), 1);
  const double pushed = pulled_with(simulation, 4);
  const double expected = -stiffness * section * 0.001;
  EXPECT_NEAR(pushed, expected, 1e-5 * std::fabs(expected));
}

TEST(BrokenLips, without_contact_pass_through_each_other) {
  const double l = 2 * hand_radius;
  Simulation simulation(led({0, 0.02 * l, 0, -0.5 * l}, false), row_of(2));
  for (const int thousands : {1, 2, 3}) EXPECT_EQ(pulled_with(simulation, thousands), 0);
}

TEST(BrokenLips, of_an_overlapping_body_are_not_ejected) {
  // A random body whose elements overlap, cracked in the middle at a walking pace: nothing may be
  // faster afterwards than the energy of the broken bonds allows, and nothing may be thrown out.
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {3e-3, 1e-3, 1e-3};
  recipe.elements = 250;
  Specimen body = make_specimen(recipe);
  for (double& radius : body.radius) radius *= 1.05;  // bonds stay those of the packing
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(0.004);
  setup.get<ContactParameters>() = ContactParameters{};
  setup.all<GripParameters>() = {hold("left", face(0, false, 1.5)),
                                 pull("right", face(0, true, 1.5), 5)};
  Simulation simulation(setup, body);
  double contact = 0;
  while (simulation.time() < 1.2e-5) {
    simulation.advance(50);
    const HistoryRow row = simulation.observe();
    contact = std::max(contact, value_of(row, "contact_energy"));
    ASSERT_LT(value_of(row, "kinetic_energy"), value_of(row, "external_work"));
    ASSERT_LT(std::fabs(value_of(row, "energy_balance")), 0.02 * value_of(row, "external_work"));
  }
  const HistoryRow row = simulation.observe();
  double farthest = 0;
  for (std::size_t i = 0; i < body.size(); ++i)
    farthest = std::max(farthest, norm(centre_of(simulation, i) - body.position[i]));
  std::printf("  %.0f bonds broken; contact energy up to %.1e of the work; moved by %.2f mm\n",
              value_of(row, "broken_bonds"), contact / value_of(row, "external_work"),
              1e3 * farthest);
  EXPECT_GT(value_of(row, "broken_bonds"), 10);
  // The grip itself moves by .06 mm; splinters, which lost all bonds, fly off with what neighbours
  // that they pressed had stored. An ejected element would have left by 7 mm.
  EXPECT_LT(farthest, 6e-4);
}

/// Tears a bar in two, then pushes the parts together by a tenth of its length.
double overlap_after_closing(bool touches) {
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(0.004);
  if (touches) setup.get<ContactParameters>() = ContactParameters{};
  const Specimen body = crystal("simple_cubic", {8, 3, 3});
  const double R = hand_radius;
  // A layer in the middle is led away by itself: the crack runs along it, flat.
  auto right = hold("right", between(8 * R, 100 * R));
  right.axis[0].function = {{0, 1e-6, 3e-6}, {0, 0.3 * R, -1 * R}};
  setup.all<GripParameters>() = {hold("left", face(0, false, 1)), right};
  Simulation simulation(setup, body);
  while (simulation.time() < 3e-6) simulation.advance(10);
  EXPECT_GT(seen(simulation, "broken_bonds"), 5) << touches;
  double furthest = 0;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body.position[i].x < 8 * R)
      for (std::size_t j = 0; j < body.size(); ++j)
        if (body.position[j].x > 8 * R)
          furthest = std::max(
              furthest, 1 - norm(centre_of(simulation, j) - centre_of(simulation, i)) / (2 * R));
  return furthest;
}

TEST(BrokenLips, keep_the_parts_of_a_bar_out_of_each_other) {
  const double with = overlap_after_closing(true), without = overlap_after_closing(false);
  std::printf("  overlap %.3f of a diameter with contact, %.3f without\n", with, without);
  EXPECT_LT(with, 0.3);
  EXPECT_GT(without, 0.45);
}

TEST(BrokenLips, that_meet_at_speed_bounce_and_keep_their_energy) {
  // A pair flies at each other; its bond breaks at once, and a contact of the same stiffness takes
  // the blow and gives it back.
  auto setup = beam_setup();
  setup.get<RuptureParameters>() = breaking_at_elastic_strain(1e-7);
  setup.get<ContactParameters>() = ContactParameters{};
  setup.run.time_step_ratio = 0.02;
  Simulation simulation(setup, row_of(2));
  set_velocity(simulation, 0, {10, 0, 0});
  set_velocity(simulation, 1, {-10, 0, 0});
  const double energy = seen(simulation, "kinetic_energy");
  simulation.advance(2);
  ASSERT_EQ(seen(simulation, "broken_bonds"), 1);
  double contact = 0;
  for (int n = 0; n < 3000; ++n) {
    simulation.advance(1);
    contact = std::max(contact, seen(simulation, "contact_energy"));
  }
  EXPECT_NEAR(contact, energy, 0.01 * energy);
  EXPECT_NEAR(seen(simulation, "kinetic_energy"), energy, 1e-3 * energy);
  EXPECT_EQ(seen(simulation, "contact_energy"), 0);
  EXPECT_LT(std::fabs(seen(simulation, "energy_balance")), 1e-3 * energy);
  const double* v = simulation.model().data(columns::velocity);
  EXPECT_NEAR(v[Model::at(columns::velocity, 0, 0)], -10, 0.01);
  EXPECT_NEAR(v[Model::at(columns::velocity, 1, 0)], 10, 0.01);
}

TEST(BrokenLips, that_break_while_pressed_go_on_pushing_without_new_energy) {
  // A bond that breaks in compression hands what it bears on to the contact: not a second time the
  // energy that it held.
  for (const double ratio : {0.1, 0.02}) {
    auto setup = beam_setup();
    setup.get<RuptureParameters>() = breaking_at_elastic_strain(0.01);
    setup.get<ContactParameters>() = ContactParameters{};
    setup.run.time_step_ratio = ratio;
    Simulation simulation(setup, row_of(2));
    set_velocity(simulation, 0, {400, 0, 0});
    set_velocity(simulation, 1, {-400, 0, 0});
    const double energy = seen(simulation, "kinetic_energy");
    double balance = 0, total = 0;
    for (int n = 0; n < static_cast<int>(60 / ratio); ++n) {
      simulation.advance(1);
      const HistoryRow row = simulation.observe();
      balance = std::max(balance, std::fabs(value_of(row, "energy_balance")));
      total = std::max(total, value_of(row, "kinetic_energy") + value_of(row, "contact_energy") +
                                  value_of(row, "elastic_energy"));
    }
    ASSERT_EQ(seen(simulation, "broken_bonds"), 1);
    std::printf("  ratio %.2f: balance %.1e, most energy %.4f, at the end %.4f of the first\n",
                ratio, balance / energy, total / energy,
                seen(simulation, "kinetic_energy") / energy);
    EXPECT_LT(total, (1 + 0.5 * ratio) * energy);
    EXPECT_LT(balance, ratio * energy);
  }
}

TEST(Rebonding, ends_before_two_elements_are_ground_down_to_one_point) {
  // Each bond breaks when pressed by a hundredth, and the next one begins there free of load.
  const double l = 2 * hand_radius;
  auto setup = led({0, -0.49 * l, -0.52 * l, -0.6 * l, -0.9 * l});
  setup.get<ContactParameters>()->rebonding_pressure = stiffness * 0.002;
  Simulation simulation(setup, row_of(2));
  EXPECT_GT(pulled_with(simulation, 1), -0.02 * stiffness * section);
  EXPECT_GT(seen(simulation, "bonds_formed"), 20);
  pulled_with(simulation, 2);
  const double formed = seen(simulation, "bonds_formed");
  const double at_two_fifths = pulled_with(simulation, 3), at_a_tenth = pulled_with(simulation, 4);
  EXPECT_EQ(seen(simulation, "bonds_formed"), formed);
  EXPECT_EQ(seen(simulation, "contacts"), 1);
  EXPECT_LT(at_two_fifths, -0.05 * stiffness * section);
  // A spring from about half of the length on: four times as far is four times as hard.
  EXPECT_NEAR(at_a_tenth / at_two_fifths, 4, 0.2);
  // Two that only touch store what presses them.
  EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 1e-3 * seen(simulation, "external_work"));
}

TEST(Rebonding, needs_its_pressure_and_makes_a_bond_free_of_load) {
  const double l = 2 * hand_radius, depth = 0.002 * l;
  for (const double fraction : {0.9, 1.1}) {
    auto setup = led({0, 0.02 * l, 0, -depth, -depth, 0});
    setup.get<ContactParameters>()->rebonding_pressure = stiffness * 0.002 / fraction;
    Simulation simulation(setup, row_of(2));
    simulation.advance(1500);
    EXPECT_EQ(seen(simulation, "broken_bonds"), 1);
    const double held = pulled_with(simulation, 4);
    const double drawn_back = pulled_with(simulation, 5);
    if (fraction < 1) {  // too little pressure: a contact, nothing more
      EXPECT_NEAR(held, -stiffness * section * 0.002, 1e-6 * stiffness * section * 0.002);
      EXPECT_NEAR(drawn_back, 0, 1e-9 * stiffness * section);
      EXPECT_EQ(simulation.model().slots().pairs().size(), 0u);
    } else {
      // Bonded on the way in at 1/1.1 of the depth: what follows is elastic from there.
      const double bonded_at = 0.002 / fraction;
      EXPECT_NEAR(held, -stiffness * section * (0.002 - bonded_at) / (1 - bonded_at),
                  2e-5 * stiffness * section);
      EXPECT_NEAR(drawn_back, stiffness * section * bonded_at / (1 - bonded_at),
                  2e-5 * stiffness * section);
      EXPECT_EQ(simulation.model().slots().pairs().size(), 1u);
    }
    EXPECT_LT(imbalance_of_loads(simulation), 1e-12);
  }
}

}  // namespace solidem::broken_faces_test
