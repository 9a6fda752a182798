// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/beam_plasticity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "laws/contact.hpp"
#include "laws/dual.hpp"
#include "laws/linear_hardening.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem {
namespace {

using Vector = Vector3<double>;
using Turn = Quaternion<double>;

constexpr double E = 70e9, G = 27e9, r = 3e-5, l = 1.1e-4;
constexpr double yield_strain = 2e-3, hardening = 0.02;

YieldingBeam<double> beam() {
  return {euler_bernoulli_rigidity<double>({E, G, r}), l, r, G / E};
}

constexpr LinearHardening law{yield_strain, hardening};
constexpr YieldCurve<LinearHardening, double> yield{law};

const Vector rest_direction{0.6, 0.64, 0.48};

Turn turned(const Vector& rotation) {
  Turn q;
  for (int n = 0; n < 16; ++n) q = turn(q, rotation, 1.0 / 16);
  return q;
}

/// Both ends of a bond.
struct Ends {
  Vector chord = l * rest_direction;
  Turn i, j;
};

/// A motion in all modes, far beyond yield for a size of 1.
Ends moved(double size) {
  return {l * rest_direction + (size * l) * Vector{.11, -.06, .08},
          turned({.3 * size, -.2 * size, .25 * size}), turned({-.1 * size, .3 * size, -.2 * size})};
}

BeamResponse<double> respond(const BeamHistory<double>& history, const Ends& ends) {
  return radial_return_response(yield, beam(), history, ends.chord, ends.i, ends.j);
}

/// A bond that has flowed in all modes.
BeamHistory<double> flowed_history() {
  BeamHistory<double> history = unyielded(rest_direction);
  for (int n = 1; n <= 200; ++n) history = respond(history, moved(n / 200.0)).history;
  return history;
}

/// Loads of a bond that has flowed, at a pose, without more flow.
BeamLoad<double> load_of(const BeamHistory<double>& history, const Ends& ends) {
  const auto pose = beam_pose(ends.chord, history.normal_i, history.normal_j, ends.i, ends.j);
  return beam_load(beam().rigidity, pose, elastic_deformation(l, pose, history));
}

TEST(BeamPlasticity, below_yield_it_is_the_elastic_beam) {
  const Ends ends = moved(1e-3);
  const auto response = respond(unyielded(rest_direction), ends);
  const auto elastic =
      beam_load<double>(beam().rigidity, l, beam_pose(ends.chord, rest_direction, ends.i, ends.j));
  EXPECT_EQ(norm(response.load.force - elastic.force), 0);
  EXPECT_EQ(norm(response.load.moment_i - elastic.moment_i), 0);
  EXPECT_EQ(response.history.strain, 0);
  EXPECT_EQ(response.plastic_work, 0);
}

TEST(BeamPlasticity, stress_is_that_of_the_end_loads) {
  const Ends ends = moved(1e-6);
  const auto pose = beam_pose(ends.chord, rest_direction, ends.i, ends.j);
  const auto load = beam_load(beam().rigidity, l, pose);
  const double pi = 3.14159265358979323846, S = pi * r * r, I = pi * r * r * r * r / 4;
  const Vector x = (1 / norm(ends.chord)) * ends.chord;
  const Vector difference = 0.5 * (load.moment_i - load.moment_j);
  const double torque = dot(difference, x);
  const Vector bending = difference - torque * x;
  const double sigma = std::fabs(dot(load.force, x)) / S + norm(bending) * r / I;
  const double tau = torque * r / (2 * I);
  const double expected = std::sqrt(sigma * sigma + 3 * tau * tau);
  const double strain = equivalent_strain(r, G / E, pose, beam_deformation(l, pose));
  EXPECT_NEAR(strain * E, expected, 1e-7 * expected);
}

TEST(BeamPlasticity, uniaxial_curve_is_bilinear_and_unloads_with_the_elastic_slope) {
  const double area = 3.14159265358979323846 * r * r;
  const auto stress_at = [&](double strain, const BeamHistory<double>& history) {
    return respond(history, {(l * (1 + strain)) * rest_direction, {}, {}});
  };
  BeamHistory<double> history = unyielded(rest_direction);
  for (int n = 1; n <= 100; ++n) {
    const double strain = 1e-2 * n / 100;
    const auto response = stress_at(strain, history);
    const double over = std::max(0.0, strain - yield_strain);
    const double expected = strain - over + over * hardening / (1 + hardening);
    EXPECT_NEAR(dot(response.load.force, rest_direction) / area, E * expected, 1e-10 * E) << strain;
    history = response.history;
  }
  const double top = dot(stress_at(1e-2, history).load.force, rest_direction) / area;
  const double lower = dot(stress_at(9e-3, history).load.force, rest_direction) / area;
  EXPECT_NEAR((top - lower) / 1e-3, E, 1e-9 * E);
}

TEST(BeamPlasticity, radial_return_yields_in_reverse_at_the_stress_it_left) {
  BeamHistory<double> history = unyielded(rest_direction);
  double forward = 0, reverse = 0;
  for (int n = 1; n <= 100; ++n) {
    const auto response = respond(history, {(l * (1 + 1e-4 * n)) * rest_direction, {}, {}});
    history = response.history;
    forward = response.strain;
  }
  for (int n = 100; n >= -100; --n) {
    const auto response = respond(history, {(l * (1 + 1e-4 * n)) * rest_direction, {}, {}});
    if (response.history.strain > history.strain) {
      reverse = response.strain;
      break;
    }
    history = response.history;
  }
  EXPECT_NEAR(reverse, forward, 1e-4 * 2);  // a step of strain
}

TEST(BeamPlasticity, scaled_offset_yields_in_reverse_only_at_the_opposite_strain) {
  BeamHistory<double> history = unyielded(rest_direction);
  const auto at = [&](double strain) {
    return scaled_offset_response(yield, beam(), history, rest_direction,
                                  (l * (1 + strain)) * rest_direction, Turn{}, Turn{});
  };
  for (int n = 1; n <= 100; ++n) history = at(1e-4 * n).history;
  const double plastic = history.strain;
  EXPECT_GT(plastic, 7e-3);
  EXPECT_EQ(at(-0.99e-2).history.strain, plastic);
  EXPECT_GT(at(-1.01e-2).history.strain, plastic);
  // Until then the stress is that of the elastic beam about its plastic length.
  EXPECT_NEAR(at(-0.99e-2).strain, 0.99e-2 + plastic, 1e-12);
}

TEST(BeamPlasticity, both_laws_give_the_same_monotonic_curve) {
  BeamHistory<double> radial = unyielded(rest_direction), offset = radial;
  const double scale = E * r * r;
  for (int n = 1; n <= 100; ++n) {
    const Ends ends{(l * (1 + 1e-4 * n)) * rest_direction, {}, {}};
    const auto a = respond(radial, ends);
    const auto b =
        scaled_offset_response(yield, beam(), offset, rest_direction, ends.chord, ends.i, ends.j);
    EXPECT_NEAR(norm(a.load.force - b.load.force), 0, 1e-12 * scale);
    radial = a.history;
    offset = b.history;
  }
}

TEST(BeamPlasticity, after_flow_the_stress_is_on_the_yield_surface) {
  BeamHistory<double> history = unyielded(rest_direction);
  for (int n = 1; n <= 500; ++n) {
    const auto response = respond(history, moved(n / 500.0));
    if (response.history.strain > history.strain) {
      const double limit = yield_strain + hardening * response.history.strain;
      EXPECT_NEAR(response.strain, limit, 1e-5 * limit) << n;
    }
    history = response.history;
  }
  EXPECT_GT(history.strain, 0.1);
}

TEST(BeamPlasticity, answering_changes_nothing_and_a_kept_answer_stays) {
  const BeamHistory<double> history = flowed_history();
  const Ends ends = moved(1.001);
  const auto once = respond(history, ends), twice = respond(history, ends);
  EXPECT_EQ(once.history.strain, twice.history.strain);
  const auto kept = respond(once.history, ends);
  EXPECT_GT(once.history.strain, history.strain);
  // What remains to be returned is of the third order in the turn of this step.
  EXPECT_NEAR(norm(kept.load.force - once.load.force), 0, 1e-5 * norm(once.load.force));
  EXPECT_LT(kept.history.strain - once.history.strain,
            1e-4 * (once.history.strain - history.strain));
}

TEST(BeamPlasticity, rigid_motion_changes_no_load_however_much_has_flowed) {
  const BeamHistory<double> history = flowed_history();
  const Ends ends = moved(0.999);
  const BeamLoad<double> load = load_of(history, ends);
  const Turn q = turned({1.1, -2.2, 0.7});
  const BeamLoad<double> far = load_of(history, {rotate(q, ends.chord), q * ends.i, q * ends.j});
  const double force = norm(load.force), moment = norm(load.moment_i);
  EXPECT_GT(force, 0);
  EXPECT_NEAR(norm(far.force - rotate(q, load.force)), 0, 1e-10 * force);
  EXPECT_NEAR(norm(far.moment_i - rotate(q, load.moment_i)), 0, 1e-10 * moment);
}

TEST(BeamPlasticity, action_is_reaction_however_much_has_flowed) {
  const BeamHistory<double> history = flowed_history();
  const Ends ends = moved(0.9);
  const BeamLoad<double> load = load_of(history, ends);
  const Vector sum = load.moment_i + load.moment_j + cross(ends.chord, -load.force);
  EXPECT_NEAR(norm(sum), 0, 1e-12 * norm(load.moment_i));
}

TEST(BeamPlasticity, order_of_the_ends_does_not_matter) {
  BeamHistory<double> forward = unyielded(rest_direction), backward = unyielded(-rest_direction);
  for (int n = 1; n <= 50; ++n) {
    const Ends ends = moved(n / 50.0);
    const auto a = respond(forward, ends);
    const auto b = radial_return_response(yield, beam(), backward, -ends.chord, ends.j, ends.i);
    const double force = norm(a.load.force), moment = norm(a.load.moment_i);
    EXPECT_NEAR(norm(a.load.force + b.load.force), 0, 1e-11 * force);
    EXPECT_NEAR(norm(a.load.moment_i - b.load.moment_j), 0, 1e-11 * moment);
    EXPECT_NEAR(a.history.strain, b.history.strain, 1e-12);
    forward = a.history;
    backward = b.history;
  }
}

TEST(BeamPlasticity, loads_of_a_flowed_bond_are_the_gradient_of_its_energy) {
  const BeamHistory<double> history = flowed_history();
  const Ends ends = moved(1.02);
  const auto pose = beam_pose(ends.chord, history.normal_i, history.normal_j, ends.i, ends.j);
  const BeamLoad<double> load = load_of(history, ends);
  const auto dual = [](const Vector& v) { return Vector3<Dual>{Dual{v.x}, Dual{v.y}, Dual{v.z}}; };
  const std::array<double, 9> expected{load.force.x,    load.force.y,    load.force.z,
                                       load.moment_i.x, load.moment_i.y, load.moment_i.z,
                                       load.moment_j.x, load.moment_j.y, load.moment_j.z};
  const auto base = beam().rigidity;
  const BeamRigidity<Dual> rigidity{base.axial, base.bending, base.shear, base.torsion};
  for (std::size_t k = 0; k < 9; ++k) {
    std::array<Dual, 9> du{};
    du[k] = {0, 1};
    const auto turn_of = [&](std::size_t n) {
      const Dual h{0.5};
      return Quaternion<Dual>{Dual{1.0}, {h * du[n], h * du[n + 1], h * du[n + 2]}};
    };
    const auto rotated = [&](const Vector& v, std::size_t n) {
      return dual(v) + cross(Vector3<Dual>{du[n], du[n + 1], du[n + 2]}, dual(v));
    };
    const Quaternion<Dual> relative{Dual{pose.relative_turn.w}, dual(pose.relative_turn.v)};
    const BeamPose<Dual> p{dual(pose.chord) - Vector3<Dual>{du[0], du[1], du[2]},
                           rotated(pose.normal_i, 3), rotated(pose.normal_j, 6),
                           turn_of(6) * relative * conjugate(turn_of(3))};
    const BeamHistory<Dual> h{dual(history.normal_i), dual(history.normal_j),
                              Dual{history.extension}, Dual{history.twist}, Dual{history.strain}};
    const Dual energy = beam_energy<Dual>(rigidity, p, elastic_deformation<Dual>(Dual{l}, p, h));
    const double scale = k < 3 ? norm(load.force) : norm(load.moment_i);
    EXPECT_NEAR(-energy.derivative, expected[k], 1e-9 * scale) << k;
  }
}

/// Work of the loads of a bond along a path of both ends, by the trapezoidal rule.
struct Path {
  double work = 0, plastic = 0, energy = 0;
};

TEST(BeamPlasticity, work_is_energy_and_plastic_work) {
  // Chord and end i move along a straight path; end j is held.
  for (const int steps : {1000, 4000}) {
    BeamHistory<double> history = unyielded(rest_direction);
    BeamLoad<double> before{};
    Path path;
    const Vector pull = l * Vector{.05, -.03, .04};
    const Vector spin{.1, .2, -.15};
    Turn q;
    for (int n = 0; n <= steps; ++n) {
      const double s = static_cast<double>(n) / steps;
      if (n > 0) q = turn(q, spin, 1.0 / steps);
      const auto response = respond(history, {l * rest_direction - s * pull, q, {}});
      if (n > 0)
        path.work -= 0.5 / steps *
                     (dot(before.force + response.load.force, pull) +
                      dot(before.moment_i + response.load.moment_i, spin));
      EXPECT_GE(response.plastic_work, 0);
      path.plastic += response.plastic_work;
      path.energy = response.energy;
      history = response.history;
      before = response.load;
    }
    const double error = std::fabs(path.work - path.energy - path.plastic) / path.work;
    EXPECT_GT(path.plastic, 0.5 * path.work);
    // Down to the square of the elastic turn, by which bending is not quite linear.
    EXPECT_LT(error, 4e-5) << steps;
  }
}

TEST(Contact, spheres_that_overlapped_at_rest_touch_where_they_were) {
  EXPECT_EQ(contact_distance(1.9, 2.0), 1.9);
  EXPECT_EQ(contact_distance(2.1, 2.0), 2.0);
  const Vector pushed = contact_force(10.0, 2.0, Vector{1.5, 0, 0});
  EXPECT_DOUBLE_EQ(pushed.x, -5);
  EXPECT_EQ(norm(contact_force(10.0, 2.0, Vector{2.5, 0, 0})), 0);
  EXPECT_DOUBLE_EQ(contact_energy(10.0, 2.0, Vector{1.5, 0, 0}), 1.25);
}

}  // namespace
}  // namespace solidem
