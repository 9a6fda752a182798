// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies under central forces: energy, what is remembered of the start, drag, cracks, removal,
// measures and checkpoints.
#include <gtest/gtest.h>

#include <map>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::central_forces_test {

using Saved = std::map<std::string, std::vector<double>>;

/// Nearest neighbours only, which never leave the range.
Setup smooth_setup() {
  auto setup = fixed_setup(usual<Mie>(), 5);
  setup.get<CentralForceParameters>()->bond_tolerance = 0.1;
  return setup;
}

/// The largest error of the energy's balance of a shaken lattice at a time step, J.
double worst_balance(Setup setup, double time_step, double time) {
  setup.run.time_step = time_step;
  Simulation simulation(setup, elements_at(lattice({4, 3, 3}, 2, 0.05)));
  shake(simulation, 20);
  double worst = 0;
  while (simulation.time() < time) {
    simulation.advance(1);
    worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")));
  }
  return worst;
}

TEST(CentralForces, conserve_energy_to_second_order_of_the_step) {
  const auto setup = smooth_setup();
  const double step =
      0.1 * Simulation(setup, elements_at(lattice({4, 3, 3}, 2, 0.05))).time_step().bound;
  double last = 0;
  for (const double fraction : {1.0, 0.5, 0.25}) {
    const double error = worst_balance(setup, fraction * step, 300 * step);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.1) << fraction;
    }
    last = error;
  }
}

TEST(CentralForces, dissipate_what_motion_loses) {
  auto setup = smooth_setup();
  setup.get<CentralForceParameters>()->dissipation = 0.02;
  const Specimen body = elements_at(lattice({4, 3, 3}, 2, 0.05));
  const double step = 0.1 * Simulation(setup, body).time_step().bound;
  double last = 0;
  for (const double fraction : {1.0, 0.5, 0.25}) {
    // Drag sees the velocities of half a step before: first order at least.
    const double error = worst_balance(setup, fraction * step, 300 * step);
    if (last > 0) {
      EXPECT_GT(std::log2(last / error), 0.95) << fraction;
    }
    last = error;
  }
  setup.run.time_step = 0.25 * step;
  Simulation simulation(setup, body);
  shake(simulation, 20);
  const double start = seen(simulation, "kinetic_energy");
  double dissipated = 0;
  for (int n = 0; n < 40; ++n) {
    simulation.advance(50);
    const double now = seen(simulation, "dissipated_energy");
    EXPECT_GE(now, dissipated);
    dissipated = now;
  }
  // A lattice of springs drags no shear, so that some goes on moving.
  EXPECT_GT(dissipated, 0.3 * start);
  EXPECT_LT(dissipated, start);
}

/// A lattice that is torn and shaken until it falls apart, with all that acts on it.
Setup everything() {
  auto setup = central_setup(usual<Piecewise>(), 1.3);
  setup.get<CentralForceParameters>()->bond_tolerance = 0.1;
  setup.get<CentralForceParameters>()->dissipation = 0.03;
  setup.get<DamageParameters>() = DamageParameters{0.3, 3, 5, 25};
  GripParameters pushed;
  pushed.name = "pushed";
  pushed.region = between(7e-4, 9e-4);
  pushed.axis[1] = {AxisControl::Kind::force, TimeFunction::constant(20)};
  setup.all<GripParameters>() = {hold("left", between(-1, 1e-4)),
                                 pull("right", between(13e-4, 1), 300), pushed};
  return setup;
}

Specimen body_of(bool periodic) {
  Specimen body = elements_at(lattice({8, 5, 5}, 2, 0.1));
  body.domain.periodic = {false, periodic, periodic};
  return body;
}

class TornBody : public testing::TestWithParam<bool> {};

TEST_P(TornBody, moves_by_the_same_bits_whatever_the_skin) {
  Saved first;
  std::map<double, std::size_t> searches;  // with a skin that is given
  for (const std::optional<double> skin : {std::optional<double>(), std::optional<double>(0.02),
                                           std::optional<double>(0.1), std::optional<double>(2)}) {
    auto setup = everything();
    setup.get<CentralForceParameters>()->skin = skin;
    Simulation simulation(setup, body_of(GetParam()));
    shake(simulation, 250);
    simulation.advance(400);
    Saved state = simulation.save();
    for (const auto& [name, value] : simulation.observe().values) state["seen"].push_back(value);
    if (first.empty()) {
      EXPECT_GT(simulation.find<Damage>()->removed(), 3u);
      first = state;
    }
    if (skin) searches[*skin] = simulation.find<CentralForces>()->searches();
    for (const char* column : {"position_and_velocity", "velocity", "barycentre"})
      EXPECT_TRUE(state.at(std::string("column.") + column) ==
                  first.at(std::string("column.") + column))
          << column << " with a skin of " << skin.value_or(0);
    EXPECT_TRUE(state.at("effect.damage") == first.at("effect.damage"));
    EXPECT_EQ(state.at("seen"), first.at("seen"));
    EXPECT_EQ(state.at("effect.central forces")[0], first.at("effect.central forces")[0]);
  }
  EXPECT_LT(searches[2], searches[0.02] / 2);
}

TEST_P(TornBody, goes_on_by_the_same_bits_from_a_checkpoint) {
  const auto setup = everything();
  const Specimen body = body_of(GetParam());
  Simulation whole(setup, body);
  shake(whole, 250);
  whole.advance(400);
  std::size_t removed = 0;
  for (const std::int64_t moment : {1, 99, 200, 213, 301, 399}) {
    Simulation first(setup, body);
    shake(first, 250);
    first.advance(moment);
    const HistoryRow then = first.observe();
    Simulation second(setup, body);
    second.restore(moment, first.save());
    EXPECT_EQ(second.save(), first.save()) << moment;
    EXPECT_EQ(second.observe().values, then.values) << moment;
    second.advance(400 - moment);
    EXPECT_TRUE(second.save() == whole.save()) << moment;
    EXPECT_EQ(second.observe().values, whole.observe().values) << moment;
    if (moment < 399) removed = std::max(removed, first.find<Damage>()->removed());
  }
  EXPECT_GT(removed, 0u);
  EXPECT_GT(seen(whole, "crack_faces"), 10);
}

INSTANTIATE_TEST_SUITE_P(Periodic, TornBody, testing::Bool());

/// A displacement along x that holds each value, radii, for a while.
TimeFunction visits(const std::vector<double>& radii, double stay) {
  TimeFunction function;
  function.time.clear();
  function.value.clear();
  for (std::size_t k = 0; k < radii.size(); ++k)
    for (const double part : {0.25, 1.0}) {
      function.time.push_back((static_cast<double>(k) + part) * stay);
      function.value.push_back(radii[k] * hand_radius);
    }
  return function;
}

TEST(CentralForces, keep_the_initial_distance_when_a_pair_parts_and_meets_again) {
  const auto law = usual<Mie>();
  for (const CentralEquilibrium equilibrium :
       {CentralEquilibrium::initial, CentralEquilibrium::radii}) {
    auto setup = central_setup(law, 1.5);
    setup.get<CentralForceParameters>()->equilibrium = equilibrium;
    setup.get<CentralForceParameters>()->bond_tolerance = 0;
    setup.run.time_step = 1e-9;
    const double stay = 1e-7;
    // The first two overlap at the start; the third stands out of reach of both.
    const Specimen body =
        elements_at({{0, 0, 0}, {1.9 * hand_radius, 0, 0}, {8 * hand_radius, 0, 0}});
    const auto still = TimeFunction::constant(0);
    const std::vector<double> stays = {0, 2, 4.2, 4.15, 0.05, 0, -0.05};
    const double r = hand_radius,
                 known = equilibrium == CentralEquilibrium::initial ? 1.9 * r : 2 * r;
    setup.all<GripParameters>() = {
        hold("low", between(-r, r)),
        hold("middle", between(r, 3 * r), {visits(stays, stay), still, still}),
        hold("high", between(7 * r, 9 * r))};
    Simulation simulation(setup, body);
    const auto push = [&](double distance, double rest) {
      return distance < 1.5 * 2 * r ? central_force(law, 0.1, distance, rest).force : 0.0;
    };
    for (std::size_t k = 0; k < stays.size(); ++k) {
      simulation.advance(static_cast<std::int64_t>((static_cast<double>(k) + 0.9) * stay / 1e-9) -
                         simulation.step());
      const double x = (1.9 + stays[k]) * r;
      // The grip holds against what its neighbours do.
      const double expected = push(8 * r - x, 2 * r) - push(x, known);
      EXPECT_NEAR(seen(simulation, "grip.middle.force_x"), expected, 1e-9) << stays[k];
    }
    EXPECT_GT(simulation.find<CentralForces>()->searches(), 3u);
  }
}

TEST(CentralForces, drag_feels_the_velocity_that_a_grip_imposes) {
  auto setup = central_setup(usual<Piecewise>(), 1.5);
  setup.get<CentralForceParameters>()->dissipation = 0.08;
  setup.run.time_step = 1e-9;
  const double r = hand_radius;
  setup.all<GripParameters>() = {hold("left", between(-r, r)), pull("right", between(r, 3 * r), 5)};
  Simulation simulation(setup, row_of(2));
  for (const int steps : {0, 1, 1, 10}) {
    simulation.advance(steps);
    const double stretch = 5 * simulation.time();
    EXPECT_NEAR(seen(simulation, "grip.right.force_x"), 1.5e6 * stretch + 0.08 * 5, 1e-9);
    EXPECT_NEAR(seen(simulation, "grip.left.force_x"), -1.5e6 * stretch - 0.08 * 5, 1e-9);
  }
  EXPECT_NEAR(seen(simulation, "dissipated_energy"), 0.08 * 25 * simulation.time(),
              1e-12 * 0.08 * 25);
}

TEST(CentralForces, reach_no_farther_than_the_range) {
  // Two elements whose attraction ends: what they do to each other a little before and after.
  for (const CentralLaw& law : usual_laws()) {
    auto setup = central_setup(law, 1.2);
    setup.get<CentralForceParameters>()->equilibrium = CentralEquilibrium::radii;
    setup.get<CentralForceParameters>()->bond_tolerance = 1;
    for (const double fraction : {1 - 1e-9, 1 + 1e-9}) {
      const Simulation simulation(setup, row_of(2, 2 * 1.2 * fraction), true);
      EXPECT_EQ(seen(simulation, "interactions"), fraction < 1 ? 1 : 0) << name_of(law);
      Observation observation;
      simulation.observe(observation);
      EXPECT_EQ(observation.motion.force[0].x > 0, fraction < 1) << name_of(law);
      // The potential is counted from the range.
      EXPECT_NEAR(seen(simulation, "potential_energy"), 0, 1e-10) << name_of(law);
    }
  }
}

/// Two blocks that stand apart, the right one moved to a gap that follows a function.
Setup blocks(const TimeFunction& gap, bool cracks) {
  auto setup = central_setup(usual<Piecewise>(), 1.3);
  setup.get<CentralForceParameters>()->equilibrium = CentralEquilibrium::radii;
  if (cracks) setup.get<DamageParameters>() = DamageParameters{0.3, 1000000, 0, 100};
  const auto still = TimeFunction::constant(0);
  setup.all<GripParameters>() = {hold("left", between(-1, 5e-4)),
                                 hold("right", between(5e-4, 1), {gap, still, still})};
  setup.run.time_step = 1e-9;
  return setup;
}

TEST(Damage, takes_the_attraction_across_a_crack_and_leaves_what_resists_closing) {
  std::vector<Vector> places = lattice({3, 3, 3});
  for (const Vector& place : lattice({3, 3, 3}, 2, 0, {7 * hand_radius, 0, 0}))
    places.push_back(place);
  // The gap closes from 3 radii to 2.2, where there is attraction, and to 1.9.
  const double stay = 1e-7;
  const auto gap = visits({0, -0.8, -1.1}, stay);
  for (const bool cracks : {false, true}) {
    Simulation simulation(blocks(gap, cracks), elements_at(places));
    // Every element but that in the middle of each block stands on a crack face.
    if (cracks) {
      EXPECT_EQ(seen(simulation, "crack_faces"), 52);
    }
    simulation.advance(90);
    EXPECT_NEAR(seen(simulation, "grip.left.force_x"), 0, 1e-9);
    simulation.advance(100);
    EXPECT_NEAR(seen(simulation, "grip.left.force_x"), cracks ? 0 : -9 * 25, 1e-9);
    EXPECT_NEAR(seen(simulation, "grip.right.force_x"), cracks ? 0 : 9 * 25, 1e-9);
    simulation.advance(100);
    EXPECT_NEAR(seen(simulation, "grip.left.force_x"), 9 * 1.5e6 * 0.1 * hand_radius, 1e-6);
  }
}

TEST(Damage, heals_where_crack_faces_have_come_within_range_again) {
  std::vector<Vector> places = lattice({3, 3, 3});
  for (const Vector& place : lattice({3, 3, 3}, 2, 0, {7 * hand_radius, 0, 0}))
    places.push_back(place);
  auto setup = blocks(visits({0, -0.8}, 1e-7), true);
  setup.get<DamageParameters>()->every = 10;
  Simulation simulation(setup, elements_at(places));
  simulation.advance(190);
  // Neighbours across the gap bring the barycentre back.
  EXPECT_EQ(seen(simulation, "crack_faces"), 52 - 2);
  EXPECT_NEAR(seen(simulation, "grip.right.force_x"), 9 * 25, 1e-9);
}

TEST(Damage, removes_what_has_lost_its_hold_and_nothing_else) {
  auto setup = central_setup(usual<Piecewise>(), 1.3);
  setup.get<DamageParameters>() = DamageParameters{{}, 1, 1, 100};
  setup.run.time_step = 5e-9;
  const double r = hand_radius, speed = 2000;
  // A pair of which one flies off, one that was always alone and comes by later, and a pair that
  // holds.
  Simulation simulation(
      setup,
      elements_at(
          {{0, 0, 0}, {2 * r, 0, 0}, {-20 * r, 10 * r, 0}, {0, 0, 40 * r}, {2 * r, 0, 40 * r}}));
  launch(simulation, 0, {0, speed, 0});
  launch(simulation, 2, {speed, 0, 0});
  simulation.advance(99);
  EXPECT_EQ(simulation.find<Damage>()->removed(), 0u);
  simulation.advance(1);
  EXPECT_EQ(simulation.find<Damage>()->removed(), 2u);
  EXPECT_TRUE(simulation.find<Damage>()->is_removed(0));
  EXPECT_TRUE(simulation.find<Damage>()->is_removed(1));
  const Vector left = place_of(simulation, 0);
  double nearest = 1;
  for (int n = 0; n < 300; ++n) {
    simulation.advance(1);
    nearest = std::min(nearest, norm(place_of(simulation, 2) - left));
  }
  // It passes close by what was removed, and feels nothing.
  EXPECT_LT(nearest, r);
  EXPECT_EQ(velocity_of(simulation, 2).x, speed);
  EXPECT_EQ(velocity_of(simulation, 2).y, 0);
  EXPECT_EQ(norm(place_of(simulation, 0) - left), 0);
  EXPECT_EQ(norm(velocity_of(simulation, 0)), 0);
  EXPECT_EQ(seen(simulation, "removed"), 2);
  EXPECT_EQ(seen(simulation, "interactions"), 1);
}

TEST(Damage, leaves_removed_elements_where_they_are_whatever_pulls_at_them) {
  // A grip shares its force among what is still there, and moves nothing that is gone.
  auto setup = central_setup(usual<Piecewise>(), 1.3);
  setup.get<DamageParameters>() = DamageParameters{{}, 1, 1, 100};
  setup.run.time_step = 5e-9;
  const double r = hand_radius;
  GripParameters grip = hold("pulled", between(-r, 3 * r));
  for (auto& axis : grip.axis) axis = {};
  grip.axis[0] = {AxisControl::Kind::force, TimeFunction::constant(1e-3)};
  setup.all<GripParameters>() = {grip};
  Simulation simulation(setup, elements_at({{0, 0, 0}, {2 * r, 0, 0}, {40 * r, 0, 0}}));
  launch(simulation, 0, {0, 2000, 0});
  simulation.advance(101);
  ASSERT_EQ(simulation.find<Damage>()->removed(), 2u);
  const Vector left = place_of(simulation, 0);
  simulation.advance(100);
  EXPECT_EQ(norm(place_of(simulation, 0) - left), 0);
  EXPECT_EQ(seen(simulation, "kinetic_energy"), 0);
}

/// sqrt(K m) of touching elements at rest, N·s/m.
double root_of_stiffness_and_mass(const Setup& setup, const Specimen& body) {
  const double stiffness = std::visit(
      [](const auto& law) { return bare_force(law, 2 * hand_radius, 2 * hand_radius).stiffness; },
      setup.get<CentralForceParameters>()->law);
  return std::sqrt(stiffness * represented_mass(body, {setup.materials.at(0).density}).front());
}

TEST(Gauge, tells_the_force_of_the_grips_over_the_section) {
  for (const CentralLaw& law : usual_laws()) {
    auto setup = fixed_setup(law, 1.35);
    const Specimen bar = crystal("fcc", {8, 3, 3});
    setup.get<CentralForceParameters>()->dissipation = 0.6 * root_of_stiffness_and_mass(setup, bar);
    const double length = bar.domain.upper.x - bar.domain.lower.x;
    setup.gauge = Gauge{0, bar.domain.lower.x + 0.3 * length, bar.domain.lower.x + 0.7 * length};
    const double step = 0.2 * Simulation(setup, bar).time_step().bound;
    setup.run.time_step = step;
    // Pulled by a strain that all laws take, then left to come to rest.
    auto right = hold("right", face(0, true));
    right.axis[0].function = {{0, 3000 * step}, {0, 2e-6}};
    setup.all<GripParameters>() = {hold("left", face(0, false)), right};
    Simulation simulation(setup, bar);
    simulation.advance(20000);
    const double section = bar.domain.cross_section(0);
    const double force = seen(simulation, "grip.right.force_x");
    EXPECT_GT(force, 1e-3);
    EXPECT_NEAR(seen(simulation, "grip.left.force_x"), -force, 1e-6 * force) << name_of(law);
    EXPECT_NEAR(seen(simulation, "gauge.stress") * section, force, 1e-6 * force) << name_of(law);
    EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 0.02 * seen(simulation, "external_work"));
  }
}

/// Whether a disturbance far too small for any law to change grows at a step.
bool grows(Setup setup, const Specimen& body, double time_step) {
  setup.run.time_step = time_step;
  Simulation simulation(setup, body, true);
  shake(simulation, 1e-9);
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

TEST(StepLimitOfCentralForces, is_met_by_the_estimate) {
  for (const CentralLaw& law : usual_laws())
    for (const double drag : {0.0, 0.3}) {
      SCOPED_TRACE(std::string(name_of(law)) + ", drag " + std::to_string(drag));
      auto setup = central_setup(law, 1.3);
      // As stiff at rest as the step allows for.
      setup.get<CentralForceParameters>()->interpenetration = 0;
      const Specimen body = crystal("fcc", {3, 3, 3});
      if (drag > 0)
        setup.get<CentralForceParameters>()->dissipation =
            drag * root_of_stiffness_and_mass(setup, body);
      const double estimate = Simulation(setup, body).time_step().limit;
      double low = 0.9 * estimate, high = 1.15 * estimate;
      ASSERT_FALSE(grows(setup, body, low));
      ASSERT_TRUE(grows(setup, body, high));
      while (high / low > 1.01) {
        const double middle = std::sqrt(low * high);
        (grows(setup, body, middle) ? high : low) = middle;
      }
      EXPECT_NEAR(estimate / low, 1, 0.03);
    }
}

TEST(StepLimitOfCentralForces, allows_for_the_deepest_overlap) {
  const Specimen body = crystal("fcc", {3, 3, 3});
  const auto law = usual<Mie>();
  const auto limit = [&](double interpenetration) {
    auto setup = central_setup(law);
    setup.get<CentralForceParameters>()->interpenetration = interpenetration;
    return Simulation(setup, body).time_step().limit;
  };
  const auto stiffness = [&](double depth) { return bare_force(law, 1 - depth, 1).stiffness; };
  const double shallow = limit(0.05);
  for (const double depth : {0.1, 0.2, 0.3}) {
    const double expected = std::sqrt(stiffness(depth) / stiffness(0.05));
    EXPECT_NEAR(shallow / limit(depth), expected, 1e-6 * expected);
  }
}

}  // namespace solidem::central_forces_test
