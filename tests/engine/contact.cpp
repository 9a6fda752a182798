// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elements that no bond joins: exact collisions, what is conserved, what is dissipated.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>

#include "effects/beam_parameters.hpp"
#include "effects/contact.hpp"
#include "model/error.hpp"
#include "model/lane_vectors.hpp"
#include "support/beams.hpp"

namespace solidem::contact_test {

constexpr double stiffness = 1e5;  // N/m

/// Spheres with nothing between them.
Specimen spheres(const std::vector<Vector>& places, const std::vector<double>& radii = {}) {
  Specimen specimen = string_of(places);
  specimen.bonds.clear();
  if (!radii.empty()) specimen.radius = radii;
  return specimen;
}

solidem::Setup loose_setup(double friction, double restitution, double ratio = 0.1) {
  Setup setup;
  setup.materials.push_back(material_of(2790, 880, 134));
  setup.get<ContactParameters>() = ContactParameters{};
  ContactLaw& law = setup.get<ContactLaw>().emplace();
  law.normal_stiffness = stiffness;
  law.friction = friction;
  law.restitution = restitution;
  setup.run.steps = 0;
  setup.run.time_step_ratio = ratio;
  return setup;
}

Vector column_velocity(const Simulation& simulation, std::size_t element) {
  return lanes_vector(simulation.model().data(columns::velocity),
                      Model::at(columns::velocity, element));
}

double mass_of(const Simulation& simulation, std::size_t element) {
  return 1 / simulation.model().data(columns::inverse_mass)[element];
}

/// Steps until nothing has touched for a while.
void run_until_apart(Simulation& simulation, int most = 200000) {
  bool touched = false;
  for (int n = 0; n < most; n += 20) {
    simulation.advance(20);
    const bool touches = seen(simulation, "contacts") > 0;
    if (touched && !touches) return;
    touched = touched || touches;
  }
  FAIL() << "they are in contact still, or never met";
}

TEST(LooseElements, part_with_the_restitution_of_the_scene_whatever_their_sizes) {
  for (const double restitution : {0.3, 0.8, 1.0})
    for (const double ratio : {1.0, 20.0}) {
      const double r = hand_radius;
      Simulation simulation(loose_setup(0, restitution, 0.02),
                            spheres({{0, 0, 0}, {r * (1 + ratio) + 1e-8, 0, 0}}, {r, r * ratio}));
      set_velocity(simulation, 0, {1.3, 0, 0});
      set_velocity(simulation, 1, {0.3, 0, 0});
      run_until_apart(simulation);
      const double parts = column_velocity(simulation, 1).x - column_velocity(simulation, 0).x;
      const double rate =
          std::sqrt(stiffness * (1 / mass_of(simulation, 0) + 1 / mass_of(simulation, 1)));
      const double step = simulation.time_step().value * rate;
      EXPECT_NEAR(parts, restitution, 0.3 * step * step) << ratio;
      EXPECT_LT(0.3 * step * step, 3e-4);
    }
}

TEST(LooseElements, of_equal_size_hand_their_velocity_on_like_a_cradle) {
  std::vector<Vector> places;
  for (int k = 0; k < 5; ++k) places.push_back({k * 2.02 * hand_radius, 0, 0});
  Simulation simulation(loose_setup(0, 1, 0.02), spheres(places));
  set_velocity(simulation, 0, {1, 0, 0});
  for (int k = 0; k < 4; ++k) run_until_apart(simulation);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(norm(column_velocity(simulation, k)), 0, 2e-4) << k;
  EXPECT_NEAR(column_velocity(simulation, 4).x, 1, 2e-4);
}

/// A cloud of spheres that falls together, all turning.
Specimen cloud(int per_side) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vector> places;
  std::vector<double> radii;
  for (int x = 0; x < per_side; ++x)
    for (int y = 0; y < per_side; ++y)
      for (int z = 0; z < per_side; ++z) {
        places.push_back(
            2.2 * hand_radius *
            Vector{x + 0.01 * any(random), y + 0.01 * any(random), z + 0.01 * any(random)});
        radii.push_back(hand_radius * (1 + 0.05 * any(random)));
      }
  return spheres(places, radii);
}

void stir(Simulation& simulation, double speed) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(-1, 1);
  const Specimen& body = simulation.model().specimen();
  const Vector middle = 0.5 * (body.domain.lower + body.domain.upper);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Vector inwards = middle - body.position[i];
    set_velocity(simulation, i,
                 speed * (5e2 * inwards + 0.3 * Vector{any(random), any(random), any(random)}));
    if (simulation.model().has(columns::angular_velocity))
      set_spin(simulation, i, speed / hand_radius * Vector{any(random), any(random), any(random)});
  }
}

TEST(LooseElements, conserve_momentum_and_angular_momentum_while_they_rub) {
  Simulation simulation(loose_setup(0.5, 0.7), cloud(4));
  stir(simulation, 1);
  const Momenta before = momenta_of(simulation);
  simulation.advance(3000);
  EXPECT_GT(seen(simulation, "friction"), 0.01 * seen(simulation, "kinetic_energy"));
  const Momenta after = momenta_of(simulation);
  EXPECT_LT(norm(after.linear - before.linear), 1e-12 * before.linear_scale);
  EXPECT_LT(norm(after.angular - before.angular), 1e-11 * before.angular_scale);
}

TEST(LooseElements, account_for_their_energy_the_better_the_finer_the_step) {
  std::vector<double> errors;
  for (const int halvings : {0, 1, 2, 3}) {
    Simulation simulation(loose_setup(0.4, 0.8, 0.1 / (1 << halvings)), cloud(4));
    stir(simulation, 1);
    const double start = seen(simulation, "kinetic_energy");
    double worst = 0;
    for (int n = 0; n < 60; ++n) {
      simulation.advance(50 << halvings);
      worst = std::max(worst, std::fabs(seen(simulation, "energy_balance")) / start);
    }
    EXPECT_GT(seen(simulation, "friction"), 0.02 * start);
    EXPECT_GT(seen(simulation, "contact_damping"), 0.02 * start);
    errors.push_back(worst);
  }
  std::printf("  balance %.1e, %.1e, %.1e, %.1e\n", errors[0], errors[1], errors[2], errors[3]);
  EXPECT_LT(errors[0], 1e-4);
  EXPECT_LT(errors[3], 1e-5);
  EXPECT_GT(errors[0] / errors[2], 8);  // 16 of second order
}

TEST(LooseElements, are_the_same_to_the_last_bit_in_any_order) {
  const double r = hand_radius;
  const std::vector<Vector> places{{0, 0, 0}, {2.01 * r, 0.7 * r, -0.2 * r}};
  const std::vector<Vector> speeds{{1, 0.3, 0}, {-0.5, -0.2, 0.4}};
  const std::vector<Vector> spins{{100, 2000, -800}, {300, -500, 900}};
  std::vector<Vector> ends[2];
  for (const int first : {0, 1}) {
    const auto a = static_cast<std::size_t>(first), b = 1 - a;
    Simulation simulation(loose_setup(0.3, 0.9), spheres({places[a], places[b]}));
    set_velocity(simulation, 0, speeds[a]);
    set_velocity(simulation, 1, speeds[b]);
    set_spin(simulation, 0, spins[a]);
    set_spin(simulation, 1, spins[b]);
    run_until_apart(simulation);
    ends[a] = {centre_of(simulation, a), centre_of(simulation, b), column_velocity(simulation, a)};
  }
  for (std::size_t k = 0; k < ends[0].size(); ++k) {
    EXPECT_EQ(ends[0][k].x, ends[1][k].x);
    EXPECT_EQ(ends[0][k].y, ends[1][k].y);
    EXPECT_EQ(ends[0][k].z, ends[1][k].z);
  }
}

TEST(LooseElements, meet_across_a_periodic_face_as_anywhere_else) {
  const double r = hand_radius, period = 10 * r;
  Vector ends[2];
  for (const int across : {0, 1}) {
    Specimen body = spheres({{4 * r, 5 * r, 5 * r}, {6.1 * r, 5.5 * r, 5 * r}});
    body.domain.lower = {};
    body.domain.upper = {period, period, period};
    body.domain.periodic = {true, true, true};
    if (across == 1) body.position = {{9 * r, 5 * r, 5 * r}, {1.1 * r, 5.5 * r, 5 * r}};
    Simulation simulation(loose_setup(0.3, 0.9), body);
    set_velocity(simulation, 0, {1, 0, 0});
    set_spin(simulation, 1, {0, 0, 3000});
    run_until_apart(simulation);
    ends[across] = column_velocity(simulation, 1);
  }
  EXPECT_GT(ends[0].x, 0.3);
  EXPECT_LT(norm(ends[1] - ends[0]), 1e-9);
}

TEST(LooseElements, go_on_from_any_moment_and_on_any_number_of_threads_in_the_same_bits) {
  const auto made = [] {
    auto simulation = std::make_unique<Simulation>(loose_setup(0.4, 0.8), cloud(12));
    return simulation;
  };
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(1);
  auto whole = made();
  stir(*whole, 40);
  whole->advance(150);
  EXPECT_GT(seen(*whole, "contacts"), 300);
  const auto middle = whole->save();
  whole->advance(100);
  const auto end = whole->save();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    auto resumed = made();
    resumed->restore(150, middle);
    EXPECT_EQ(resumed->observe().values, [&] {
      auto again = made();
      again->restore(150, middle);
      return again->observe().values;
    }());
    resumed->advance(100);
    EXPECT_EQ(resumed->save(), end) << threads;
  }
  omp_set_num_threads(threads_before);
}

TEST(LooseElements, that_overlap_at_the_start_are_told_how_deep_unless_they_may) {
  const Specimen body = spheres({{0, 0, 0}, {1.9 * hand_radius, 0, 0}, {3.85 * hand_radius, 0, 0}});
  try {
    const Simulation refused(loose_setup(0, 1), body);
    FAIL() << "spheres that overlap were taken";
  } catch (const InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("elements 0 and 1 overlap by 1e-05 m"), std::string::npos) << words;
    EXPECT_NE(words.find("10 % of the smaller radius"), std::string::npos) << words;
    EXPECT_NE(words.find("1 more pair"), std::string::npos) << words;
  }
  auto setup = loose_setup(0, 1);
  setup.get<ContactLaw>()->initial_overlap = ContactLaw::InitialOverlap::kept;
  Simulation kept(setup, body);
  kept.advance(1000);
  EXPECT_EQ(seen(kept, "kinetic_energy"), 0);
}

TEST(LooseElements, bound_the_time_step) {
  auto setup = loose_setup(0.3, 1);
  setup.run.time_step_ratio = 1.6;
  EXPECT_THROW(Simulation(setup, spheres({{0, 0, 0}, {3 * hand_radius, 0, 0}})), InputError);
  setup.run.time_step_ratio = 1.3;
  EXPECT_NO_THROW(Simulation(setup, spheres({{0, 0, 0}, {3 * hand_radius, 0, 0}})));
}

/// Two rows of springs, end to end with a gap, that run at each other.
Specimen two_rows(int elements) {
  const double r = hand_radius;
  std::vector<Vector> places;
  for (int k = 0; k < elements; ++k) places.push_back({2 * r * k, 0, 0});
  for (int k = 0; k < elements; ++k) places.push_back({2 * r * (k + elements) + 0.01 * r, 0, 0});
  Specimen body = string_of(places);
  body.bonds.erase(body.bonds.begin() + (elements - 1));
  return body;
}

TEST(BondedBodies, that_meet_head_on_part_when_the_waves_are_back) {
  constexpr int elements = 60;
  constexpr double speed = 1;
  auto setup = beam_setup(BeamLaw::spring);
  setup.get<ContactParameters>() = ContactParameters{};
  setup.run.time_step_ratio = 0.02;
  Simulation simulation(setup, two_rows(elements));
  for (std::size_t i = 0; i < 2 * elements; ++i)
    set_velocity(simulation, i, {i < elements ? speed : -speed, 0, 0});
  const Beams& beams = *simulation.find<Beams>();
  const auto place = simulation.model().slots().find(0, 1);
  const Beams::Bond bond = beams.bond(simulation.model(), 0, 1, place->row, place->lane);
  const double spring = bond.rigidity().axial / bond.rest_length();
  const double pass =
      std::sqrt(mass_of(simulation, 0) / spring);  // of a wave, from one to the next
  double touched = 0;
  constexpr int steps = 10;
  for (int n = 0; n < 4000; ++n) {
    simulation.advance(steps);
    if (seen(simulation, "contacts") > 0) touched += steps * simulation.time_step().value;
    if (touched > 0 && seen(simulation, "contacts") == 0) break;
  }
  EXPECT_NEAR(touched / (2 * elements * pass), 1, 0.02);
  double momentum = 0;
  for (std::size_t i = 0; i < elements; ++i) momentum += column_velocity(simulation, i).x;
  EXPECT_NEAR(momentum / elements, -speed, 0.02 * speed);
  EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 1e-5 * seen(simulation, "kinetic_energy"));
}

TEST(BondedBodies, bear_contacts_a_million_times_stiffer_than_their_bonds) {
  auto setup = beam_setup();
  setup.get<BeamParameters>()->young_modulus *= 1e-6;
  setup.get<BeamParameters>()->shear_modulus *= 1e-6;
  setup.get<ContactParameters>() = ContactParameters{};
  ContactLaw& law = setup.get<ContactLaw>().emplace();
  law.young_modulus = 3.5e12;
  law.friction = 0.3;
  setup.run.time_step_ratio = 0.03;
  Simulation simulation(setup, two_rows(4));
  for (std::size_t i = 0; i < 8; ++i) set_velocity(simulation, i, {i < 4 ? 1.0 : -1.0, 0.1, 0});
  const double start = seen(simulation, "kinetic_energy");
  double met = 0;
  for (int n = 0; n < 200; ++n) {
    simulation.advance(200);
    met = std::max(met, column_velocity(simulation, 4).x);
  }
  EXPECT_GT(met, 0.9);  // thrown back by the contact alone
  EXPECT_NEAR(seen(simulation, "energy_balance"), 0, 1e-4 * start);
}

}  // namespace solidem::contact_test
