// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/linear_contact.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "laws/dual.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem::linear_contact_test {

using Vector = Vector3<double>;

constexpr double stiffness = 1e6;                         // N/m
constexpr double mass = 1e-5;                             // kg, of each sphere
constexpr double inverse_mass = 2 / mass;                 // of a pair
const double rate = std::sqrt(stiffness * inverse_mass);  // of its vibrations, rad/s

LinearContact<double> contact_of(double restitution, double friction = 0.3) {
  return {stiffness, 0.8 * stiffness, friction,
          damping_coefficient(restitution_damping_ratio(restitution), stiffness, inverse_mass),
          inverse_mass};
}

/// Velocities and ledger of two spheres that met head-on.
struct Bounce {
  double ratio = 0;    ///< of the velocities after and before
  double balance = 0;  ///< energy that is left or missing, of what there was
};

/// Meets at a fraction of a step after a pose.
Bounce bounce(double restitution, double step_of_rate, double fraction) {
  const LinearContact<double> contact = contact_of(restitution);
  const double dt = step_of_rate / rate, start = 1;
  double closing = start, overlap = (fraction - 1) * start * dt, damped = 0;
  ContactHistory<double> history;
  do {
    const ContactResponse<double> now =
        linear_contact(contact, {{1, 0, 0}, overlap, {-closing, 0, 0}, 0, dt}, history);
    history = now.history;
    damped += now.damping_work;
    closing += now.force.x * inverse_mass * dt;
    overlap += closing * dt;
  } while (overlap > 0 || closing > 0);
  const ContactResponse<double> last =
      linear_contact(contact, {{1, 0, 0}, overlap, {-closing, 0, 0}, 0, dt}, history);
  damped += last.damping_work;
  const double energy = 0.5 / inverse_mass * start * start;
  return {-closing / start, (0.5 / inverse_mass * closing * closing + damped - energy) / energy};
}

/// The largest error of the restitution wherever in a step the two meet.
double restitution_error(double restitution, double step_of_rate) {
  double worst = 0;
  for (int n = 0; n < 40; ++n)
    worst = std::max(
        worst, std::fabs(bounce(restitution, step_of_rate, (n + 0.5) / 40).ratio - restitution));
  return worst;
}

TEST(LinearContact, two_spheres_part_with_the_restitution_of_the_scene_to_second_order) {
  EXPECT_DOUBLE_EQ(restitution_damping_ratio(1), 0);
  for (const double restitution : {0.1, 0.3, 0.5, 0.8, 0.95, 1.0})
    for (const double step_of_rate : {0.16, 0.04, 0.01, 1e-3})
      EXPECT_LT(restitution_error(restitution, step_of_rate), 0.3 * step_of_rate * step_of_rate)
          << restitution;
}

TEST(LinearContact, what_the_dashpot_takes_is_what_motion_loses) {
  for (const double restitution : {0.1, 0.5, 0.9})
    for (const double fraction : {0.1, 0.5, 0.9}) {
      const double coarse = std::fabs(bounce(restitution, 0.08, fraction).balance);
      const double fine = std::fabs(bounce(restitution, 0.01, fraction).balance);
      EXPECT_LT(coarse, 2e-3) << restitution << ' ' << fraction;
      EXPECT_LT(fine, 4e-5) << restitution << ' ' << fraction;
    }
}

TEST(LinearContact, the_damping_ratio_of_a_restitution_is_above_that_of_a_dashpot_that_pulls) {
  for (const double e : {0.01, 0.2, 0.6, 0.99}) {
    const double pulls = -std::log(e) / std::hypot(pi, std::log(e));
    EXPECT_GT(restitution_damping_ratio(e), pulls) << e;
  }
  EXPECT_NEAR(restitution_damping_ratio(std::exp(-2.0)), 1, 1e-7);
}

TEST(LinearContact, forces_follow_from_the_energy) {
  // By dual numbers, where neither friction nor a dashpot takes anything.
  const LinearContact<Dual> contact{stiffness, 0.8 * stiffness, 1e9, 0.0, inverse_mass};
  ContactHistory<Dual> history;
  history.normal = {0.0, 0.0, 1.0};
  history.spring = {2e-6, -1e-6, 0.0};
  const double dt = 1e-6;
  const auto pressed = linear_contact<Dual>(
      contact, {{0.0, 0.0, 1.0}, {3e-6, 1}, {0.1, 0.0, 0.0}, 0.0, dt}, history);
  EXPECT_DOUBLE_EQ(pressed.normal_energy.derivative, -pressed.force.z.value);
  const auto sheared = linear_contact<Dual>(
      contact, {{0.0, 0.0, 1.0}, 3e-6, {{0.1, 1 / dt}, 0.0, 0.0}, 0.0, dt}, history);
  EXPECT_NEAR(sheared.tangential_energy.derivative / sheared.force.x.value, 1, 1e-14);
  EXPECT_EQ(sheared.friction_work.value, 0);
}

/// A contact in any pose and motion, that touched before or not.
struct Sample {
  LinearContact<double> contact;
  ContactMotion<double> motion;
  ContactHistory<double> history;
};

Sample any_sample(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const auto direction = [&] {
    const Vector v{any(random), any(random), any(random)};
    return 1 / norm(v) * v;
  };
  Sample sample{contact_of(0.6), {}, {}};
  sample.history.normal = direction();
  sample.motion.normal = direction();
  sample.history.spring =
      4e-6 * (direction() - dot(sample.history.normal, direction()) * sample.history.normal);
  sample.history.spring = sample.history.spring -
                          dot(sample.history.spring, sample.history.normal) * sample.history.normal;
  sample.history.dashpot = 5 * any(random);
  sample.motion.overlap = 1e-5 * (any(random) + 0.5);
  sample.motion.velocity = 5.0 * direction();
  sample.motion.spin = 1e4 * any(random);
  sample.motion.time_step = 1e-6;
  return sample;
}

TEST(LinearContact, never_pulls_and_never_exceeds_coulombs_limit) {
  std::mt19937 random(1);
  int sliding = 0;
  for (int n = 0; n < 2000; ++n) {
    const Sample s = any_sample(random);
    const auto now = linear_contact(s.contact, s.motion, s.history);
    const double push = -dot(now.force, s.motion.normal);
    const double tangential = norm(now.force + push * s.motion.normal);
    EXPECT_GE(push, -1e-12);
    EXPECT_LE(tangential, s.contact.friction * push * (1 + 1e-12) + 1e-12);
    // Turning onto the plane of an almost opposite normal is ill-conditioned.
    const double way = norm(s.history.spring) + s.motion.time_step * norm(s.motion.velocity);
    EXPECT_NEAR(dot(now.history.spring, s.motion.normal), 0,
                1e-15 * way / (1 + dot(s.history.normal, s.motion.normal)));
    if (now.friction_work != 0) ++sliding;
  }
  EXPECT_GT(sliding, 500);
}

TEST(LinearContact, is_the_same_to_the_last_bit_seen_from_the_other_side) {
  std::mt19937 random(2);
  for (int n = 0; n < 500; ++n) {
    const Sample s = any_sample(random);
    Sample t = s;
    t.motion.normal = -s.motion.normal;
    t.motion.velocity = -s.motion.velocity;
    t.motion.spin = -s.motion.spin;
    t.history.normal = -s.history.normal;
    t.history.spring = -s.history.spring;
    const auto from_i = linear_contact(s.contact, s.motion, s.history);
    const auto from_j = linear_contact(t.contact, t.motion, t.history);
    EXPECT_EQ(from_i.force.x, -from_j.force.x);
    EXPECT_EQ(from_i.force.y, -from_j.force.y);
    EXPECT_EQ(from_i.force.z, -from_j.force.z);
    EXPECT_EQ(from_i.history.spring.x, -from_j.history.spring.x);
    EXPECT_EQ(from_i.friction_work, from_j.friction_work);
    EXPECT_EQ(from_i.damping_work, from_j.damping_work);
  }
}

TEST(LinearContact, a_spring_that_turns_keeps_its_length_and_its_plane) {
  std::mt19937 random(3);
  for (int n = 0; n < 500; ++n) {
    const Sample s = any_sample(random);
    const Vector turned = onto_tangent_plane(s.history.spring, s.history.normal, s.motion.normal);
    EXPECT_NEAR(norm(turned) / norm(s.history.spring), 1, 1e-12);
    EXPECT_NEAR(dot(turned, s.motion.normal), 0, 1e-19);
    const Vector spun = about_normal(turned, s.motion.normal, 0.3);
    EXPECT_NEAR(norm(spun) / norm(turned), 1, 1e-14);
    EXPECT_NEAR(dot(spun, turned) / dot(turned, turned), std::cos(0.3), 1e-3);
  }
}

TEST(LinearContact, the_spring_of_two_spheres_that_turn_as_one_body_turns_with_them) {
  const LinearContact<double> contact{stiffness, stiffness, 1e9, 0, inverse_mass};
  const Vector omega{0.3, -0.7, 1.1}, normal{0.6, 0, 0.8}, spring{4e-7, 3e-7, -3e-7};
  const auto error = [&](int steps) {
    const double dt = 2.0 / steps;
    ContactHistory<double> history{normal, spring, 0};
    Quaternion<double> turned;
    for (int n = 0; n < steps; ++n) {
      turned = turn(turned, omega, dt);
      const Vector now = rotate(turned, normal);
      history = linear_contact(contact, {now, 1e-6, {}, dot(omega, now), dt}, history).history;
    }
    return norm(history.spring - rotate(turned, spring)) / norm(spring);
  };
  EXPECT_LT(error(200), 5e-5);
  EXPECT_GT(error(100) / error(200), 3.7);
}

TEST(LinearContact, stick_and_slip_to_and_fro_balance_work_to_round_off) {
  const LinearContact<double> contact{stiffness, 0.5 * stiffness, 0.4, 0, inverse_mass};
  ContactHistory<double> history{{0, 0, 1}, {}, 0};
  Vector before{};
  double work = 0, friction = 0, stored = 0;
  const double dt = 1e-3;
  for (int n = 0; n < 5000; ++n) {
    const double t = n * dt;
    const Vector velocity{1e-4 * std::sin(9 * t), 6e-5 * std::cos(5 * t), 0};
    const auto now =
        linear_contact(contact, {{0, 0, 1}, 1e-5 * (1.2 + std::sin(t)), velocity, 0, dt}, history);
    const Vector force{now.force.x, now.force.y, 0};
    work += 0.5 * dt * dot(before + force, velocity);
    friction += now.friction_work;
    stored = now.tangential_energy;
    before = force;
    history = now.history;
  }
  EXPECT_GT(friction, 10 * stored);
  EXPECT_NEAR(friction + stored, work, 1e-12 * work);
}

TEST(LinearContact, two_that_part_leave_nothing_behind) {
  const ContactHistory<double> touched{{1, 0, 0}, {0, 1e-7, 0}, 0.5};
  const auto now =
      linear_contact(contact_of(0.5), {{1, 0, 0}, -1e-8, {0.1, 0, 0}, 0, 1e-6}, touched);
  EXPECT_EQ(norm(now.force), 0);
  EXPECT_EQ(norm(now.history.spring), 0);
  EXPECT_EQ(now.history.dashpot, 0);
  // What the spring held went into friction.
  EXPECT_NEAR(now.friction_work, 0.5 * 0.8 * stiffness * 1e-14, 1e-20);
}

}  // namespace solidem::linear_contact_test
