// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/beam_flow.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "laws/bond_limit.hpp"
#include "laws/contact.hpp"
#include "laws/dual.hpp"
#include "laws/linear_hardening.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem::beam_plasticity_test {

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

BeamResponse<double> respond(FlowRule rule, const BeamHistory<double>& history, const Ends& ends,
                             const YieldingBeam<double>& judged = beam()) {
  return flow_response(rule, yield, judged, history, rest_direction, {ends.chord, ends.i, ends.j});
}

BeamResponse<double> respond(const BeamHistory<double>& history, const Ends& ends) {
  return respond(FlowRule::radial_return, history, ends);
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
  const double S = pi * r * r, I = pi * r * r * r * r / 4;
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
  const double area = pi * r * r;
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
    return respond(FlowRule::scaled_offset, history, {(l * (1 + strain)) * rest_direction, {}, {}});
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
    const auto b = respond(FlowRule::scaled_offset, offset, ends);
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
    const auto b = respond(backward, {-ends.chord, ends.j, ends.i});
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
    const BeamHistory<Dual> h{dual(history.normal_i),  dual(history.normal_j),
                              Dual{history.extension}, Dual{history.twist},
                              Dual{history.strain},    {}};
    const Dual energy = beam_energy<Dual>(rigidity, p, elastic_deformation<Dual>(Dual{l}, p, h));
    const double scale = k < 3 ? norm(load.force) : norm(load.moment_i);
    EXPECT_NEAR(-energy.derivative, expected[k], 1e-9 * scale) << k;
  }
}

/// A rule of flow and where the beam is judged.
struct Flow {
  const char* name;
  FlowRule rule;
  JudgedSection section = JudgedSection::middle;
};

void PrintTo(const Flow& flow, std::ostream* out) {
  *out << flow.name;
}

class FlowOfBeams : public testing::TestWithParam<Flow> {
 protected:
  static YieldingBeam<double> judged() {
    YieldingBeam<double> b = beam();
    b.yield_section = GetParam().section;
    return b;
  }
  static BeamResponse<double> answer(const BeamHistory<double>& history, const Ends& ends) {
    return respond(GetParam().rule, history, ends, judged());
  }
};

/// A motion whose modes come one after the other: the path turns in the space of loads.
struct TurningPath {
  int steps;
  Vector way_j;             ///< by which end j turns in all
  Turn turned_i, turned_j;  ///< so far
  Ends at(int n) const {
    const double s = static_cast<double>(n) / steps;
    return {l * rest_direction - (s * (1 - 0.7 * s) * l) * Vector{.012, -.006, .01}, turned_i,
            turned_j};
  }
  /// Rotation of end i in a step.
  Vector spin(int n) const {
    const double middle = (n - 0.5) / steps;
    return (1.0 / steps) * Vector{.04 * (1 - 2 * middle), .06 * middle, -.05 * middle * middle};
  }
};

/// What is missing of the work of the loads, by the trapezoidal rule, over that work.
template <class Answer>
double missing_work(int steps, const Answer& answer, const Vector& way_j = {}) {
  BeamHistory<double> history = unyielded(rest_direction);
  BeamResponse<double> before{};
  TurningPath path{steps, way_j, {}, {}};
  const Vector spin_j = (1.0 / steps) * way_j;
  double work = 0, plastic = 0;
  for (int n = 0; n <= steps; ++n) {
    const Vector spin = path.spin(n);
    if (n > 0) {
      path.turned_i = turn(path.turned_i, spin, 1.0);
      path.turned_j = turn(path.turned_j, spin_j, 1.0);
    }
    const BeamResponse<double> now = answer(history, path.at(n));
    if (n > 0) {
      const Vector moved = path.at(n).chord - path.at(n - 1).chord;
      work += 0.5 * (dot(before.load.force + now.load.force, moved) -
                     dot(before.load.moment_i + now.load.moment_i, spin) -
                     dot(before.load.moment_j + now.load.moment_j, spin_j));
    }
    plastic += now.plastic_work;
    history = now.history;
    before = now;
  }
  EXPECT_GT(plastic, 0.1 * work);
  return std::fabs(work - before.energy - plastic) / work;
}

TEST_P(FlowOfBeams, takes_the_work_that_is_not_stored_to_second_order) {
  // What is left is of the square of the turn, by which bending is not quite linear.
  EXPECT_LT(missing_work(100, answer), 5e-4);
  EXPECT_LT(missing_work(400, answer), 2e-5);
}

TEST_P(FlowOfBeams, takes_it_to_second_order_where_one_end_turns_against_the_other) {
  // The load of the last pose works along what the flow means there. Did it work along what it
  // means in this pose, the error would be of first order.
  const Vector way_j{.12, .13, .1};
  const double coarse = missing_work(1000, answer, way_j), fine = missing_work(2000, answer, way_j);
  EXPECT_LT(fine, 1e-8);
  EXPECT_GT(coarse / fine, 3.5);
}

TEST_P(FlowOfBeams, stays_on_the_yield_surface) {
  if (GetParam().rule == FlowRule::scaled_offset) return;  // which has none
  BeamHistory<double> history = unyielded(rest_direction);
  int flowed = 0;
  for (int n = 1; n <= 300; ++n) {
    const Ends ends = moved(n / 3000.0);
    const BeamResponse<double> now = answer(history, ends);
    if (now.history.strain > history.strain) {
      ++flowed;
      const BeamPose<double> pose =
          beam_pose(ends.chord, now.history.normal_i, now.history.normal_j, ends.i, ends.j);
      const double strain = equivalent_strain(GetParam().section, judged(), pose,
                                              elastic_deformation(l, pose, now.history));
      const double limit = yield.limit(now.history.strain);
      EXPECT_NEAR(strain, limit, 1e-5 * limit) << n;
    }
    history = now.history;
  }
  EXPECT_GT(flowed, 100);
}

INSTANTIATE_TEST_SUITE_P(Rules, FlowOfBeams,
                         testing::Values(Flow{"radial return", FlowRule::radial_return},
                                         Flow{"scaled offset", FlowRule::scaled_offset},
                                         Flow{"associated", FlowRule::associated},
                                         Flow{"radial return at the ends", FlowRule::radial_return,
                                              JudgedSection::ends},
                                         Flow{"radial return at the worst", FlowRule::radial_return,
                                              JudgedSection::worst}));

/// A pose in small motion.
Ends strained(const Vector& pull, const Vector& at_i, const Vector& at_j) {
  return {l * (rest_direction + pull), turned(at_i), turned(at_j)};
}

TEST(AssociatedFlow, is_normal_to_the_surface_of_the_resultants) {
  // Beyond the surface by tension, bending and twist, with something left of each.
  const Vector x = rest_direction;
  const Vector across = (1 / norm(cross(x, Vector{0, 0, 1}))) * cross(x, Vector{0, 0, 1});
  const double area = pi * r * r, inertia = area * r * r / 4;
  for (const double bent : {0.011, 0.012}) {
    const Ends ends = strained(2e-3 * x, bent * across + 4e-3 * x, -bent * across - 4e-3 * x);
    const auto before = beam_pose(ends.chord, x, x, ends.i, ends.j);
    const auto elastic = beam_deformation(l, before);
    const auto now = respond(FlowRule::associated, unyielded(x), ends);
    const auto pose =
        beam_pose(ends.chord, now.history.normal_i, now.history.normal_j, ends.i, ends.j);
    const auto left = elastic_deformation(l, pose, now.history);
    const double extension = elastic.extension - left.extension;
    const double bending =
        norm(before.normal_j - before.normal_i) - norm(pose.normal_j - pose.normal_i);
    const double twist = elastic.twist - left.twist;
    // ∂σ_e/∂N, ∂σ_e/∂M and ∂σ_e/∂T where the stress came to rest.
    const double sigma = E / l * (left.extension + r * norm(pose.normal_j - pose.normal_i));
    const double tau = G * r / l * left.twist;
    const double equivalent = std::sqrt(sigma * sigma + 3 * tau * tau);
    const double by_tension = sigma / equivalent / area;
    const double by_bending = sigma / equivalent * r / inertia;
    const double by_twist = 3 * tau / equivalent * r / (2 * inertia);
    EXPECT_GT(extension, 0);
    EXPECT_NEAR(bending / extension, by_bending / by_tension, 2e-3 * by_bending / by_tension);
    EXPECT_NEAR(twist / extension, by_twist / by_tension, 2e-3 * std::fabs(by_twist / by_tension));
  }
}

TEST(AssociatedFlow, differs_from_radial_return_where_a_beam_is_twisted_after_tension) {
  BeamHistory<double> radial = unyielded(rest_direction), associated = radial;
  const auto both_at = [&](const Ends& ends) {
    const auto a = respond(radial, ends);
    const auto b = respond(FlowRule::associated, associated, ends);
    radial = a.history;
    associated = b.history;
    return std::pair{a, b};
  };
  for (int n = 1; n <= 50; ++n) {
    const auto [a, b] = both_at(strained((4e-3 * n / 50) * rest_direction, {}, {}));
    EXPECT_NEAR(norm(a.load.force - b.load.force), 0, 1e-12 * norm(a.load.force));
  }
  std::pair<BeamResponse<double>, BeamResponse<double>> end;
  for (int n = 1; n <= 50; ++n)
    end = both_at(strained(4e-3 * rest_direction, {}, (2e-3 * l / r * n / 50) * rest_direction));
  const double departs = norm(end.first.load.force - end.second.load.force);
  EXPECT_GT(departs, 0.02 * norm(end.first.load.force));
  EXPECT_LT(departs, 0.5 * norm(end.first.load.force));
}

TEST(JudgedSections, see_the_bending_of_a_beam_that_is_sheared_with_its_rotations_held) {
  // M_i = M_j = 6 E I δ/l²: nothing at mid-length, 6 r δ/l² of strain at either end.
  const Vector across = cross(rest_direction, Vector{0.8, -0.6, 0});
  const double delta = 1e-4 / norm(across);
  const Ends ends = strained(delta * across, {}, {});
  const auto pose = beam_pose(ends.chord, rest_direction, ends.i, ends.j);
  const auto deformation = beam_deformation(l, pose);
  const auto strain = [&](JudgedSection section) {
    return bending_strain(section, beam(), pose, deformation);
  };
  const double expected = 6 * r / l * 1e-4;
  EXPECT_LT(strain(JudgedSection::middle), 1e-12);
  EXPECT_NEAR(strain(JudgedSection::ends), expected, 1e-4 * expected);
  EXPECT_EQ(strain(JudgedSection::worst), strain(JudgedSection::ends));
}

TEST(JudgedSections, agree_in_pure_bending) {
  const Vector across = cross(rest_direction, Vector{0.8, -0.6, 0});
  const Ends ends = strained({}, 1e-3 * across, -1e-3 * across);
  const auto pose = beam_pose(ends.chord, rest_direction, ends.i, ends.j);
  const auto deformation = beam_deformation(l, pose);
  const double middle = bending_strain(JudgedSection::middle, beam(), pose, deformation);
  EXPECT_GT(middle, 0);
  EXPECT_NEAR(bending_strain(JudgedSection::ends, beam(), pose, deformation), middle,
              1e-5 * middle);
}

TEST(Contact, of_a_bond_that_breaks_while_it_pushes_takes_over_its_push) {
  // A bond of 10 N/m, pressed by .2 m: the contact pushes as hard, if it is stiffer.
  const double free_distance = 2.0, length = 1.8, push = 2.0;
  EXPECT_EQ(contact_distance(free_distance, length, push, 10.0), 2.0);
  EXPECT_EQ(contact_distance(free_distance, length, push, 5.0), 2.0);
  const double nearer = contact_distance(free_distance, length, push, 40.0);
  EXPECT_DOUBLE_EQ(norm(contact_force(40.0, nearer, Vector{length, 0, 0})), push);
  EXPECT_LT(contact_energy(40.0, nearer, Vector{length, 0, 0}), 0.5 * 10.0 * 0.2 * 0.2);
}

TEST(Contact, spheres_that_overlapped_at_rest_touch_where_they_were) {
  EXPECT_EQ(contact_distance(1.9, 2.0), 1.9);
  EXPECT_EQ(contact_distance(2.1, 2.0), 2.0);
  const Vector pushed = contact_force(10.0, 2.0, Vector{1.5, 0, 0});
  EXPECT_DOUBLE_EQ(pushed.x, -5);
  EXPECT_EQ(norm(contact_force(10.0, 2.0, Vector{2.5, 0, 0})), 0);
  EXPECT_DOUBLE_EQ(contact_energy(10.0, 2.0, Vector{1.5, 0, 0}), 1.25);
}

}  // namespace solidem::beam_plasticity_test
