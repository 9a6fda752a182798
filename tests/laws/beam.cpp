// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/beam.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "laws/dual.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem::beam_test {

using Vector = Vector3<double>;
using State = std::array<double, 12>;  // displacement of i, of j (m), rotation of i, of j (rad)

constexpr double E = 70e9, G = 27e9, r = 3e-5, l = 1.1e-4;

template <class Real>
struct Loads {
  Vector3<Real> force_i, force_j, moment_i, moment_j;
};

/// The beam along x under a motion of its ends; Real carries the derivatives.
template <class Real>
BeamPose<Real> pose_of(const std::array<Real, 12>& u) {
  const auto orientation = [&](int k) {
    return turn(Quaternion<Real>{}, {u[k], u[k + 1], u[k + 2]}, Real{1.0});
  };
  return beam_pose<Real>({Real{l} + u[3] - u[0], u[4] - u[1], u[5] - u[2]},
                         {Real{1.0}, Real{0.0}, Real{0.0}}, orientation(6), orientation(9));
}

template <class Real>
BeamRigidity<Real> rigidity() {
  return euler_bernoulli_rigidity<Real>({Real{E}, Real{G}, Real{r}});
}

template <class Real>
Loads<Real> loads_of(const std::array<Real, 12>& u) {
  const BeamLoad<Real> load = beam_load<Real>(rigidity<Real>(), l, pose_of(u));
  return {load.force, -load.force, load.moment_i, load.moment_j};
}

template <class Real>
std::array<Real, 12> as_array(const Loads<Real>& p) {
  return {p.force_i.x,  p.force_i.y,  p.force_i.z,  p.force_j.x,  p.force_j.y,  p.force_j.z,
          p.moment_i.x, p.moment_i.y, p.moment_i.z, p.moment_j.x, p.moment_j.y, p.moment_j.z};
}

/// End loads of the linear beam (Terreros 2013, section 3.2, signs put right), from rotations
/// against the chord.
State linear_loads(const State& u) {
  const double S = pi * r * r, I = pi * r * r * r * r / 4, I0 = 2 * I;
  const double stretch = u[3] - u[0];
  const double chord_y = -(u[5] - u[2]) / l, chord_z = (u[4] - u[1]) / l;  // turn of the chord
  const double iy = u[7] - chord_y, iz = u[8] - chord_z, jy = u[10] - chord_y, jz = u[11] - chord_z;
  const double twist = u[9] - u[6];
  const double fx = E * S * stretch / l, k = 6 * E * I / (l * l), m = 2 * E * I / l;
  const double fy = -k * (iz + jz), fz = k * (iy + jy), mx = G * I0 / l * twist;
  return {fx,
          fy,
          fz,
          -fx,
          -fy,
          -fz,
          mx,
          -m * (2 * iy + jy),
          -m * (2 * iz + jz),
          -mx,
          -m * (iy + 2 * jy),
          -m * (iz + 2 * jz)};
}

/// A typical load for a unit of motion k: what errors are measured against.
double scale_of(int k) {
  State unit{};
  unit[static_cast<std::size_t>(k)] = 1;
  double largest = 0;
  for (const double x : linear_loads(unit)) largest = std::max(largest, std::fabs(x));
  return largest;
}

State arbitrary(double size) {
  return {.1 * size * l,  -.3 * size * l, .2 * size * l, -.2 * size * l,
          .15 * size * l, .4 * size * l,  .3 * size,     -.2 * size,
          .5 * size,      -.4 * size,     .3 * size,     .1 * size};
}

TEST(EulerBernoulliBeam, tangent_at_rest_is_the_stiffness_matrix) {
  for (int k = 0; k < 12; ++k) {
    std::array<Dual, 12> u{};
    State unit{};
    unit[static_cast<std::size_t>(k)] = 1;
    u[static_cast<std::size_t>(k)] = {0, 1};
    const auto loads = as_array(loads_of(u));
    const State expected = linear_loads(unit);
    for (std::size_t n = 0; n < 12; ++n)
      EXPECT_NEAR(loads[n].derivative, expected[n], 1e-12 * scale_of(k)) << k << " " << n;
  }
}

TEST(EulerBernoulliBeam, loads_are_the_gradient_of_the_energy) {
  for (const double size : {1e-6, 1e-2, 1.0}) {
    const State at = arbitrary(size);
    const BeamPose<double> pose = pose_of(at);
    const Loads<double> loads = loads_of(at);
    // Virtual motions: displacements, and turns about world axes on top of the present orientation.
    const std::array<double, 12> expected = as_array(loads);
    double largest = 0;
    for (const double x : expected) largest = std::max(largest, std::fabs(x));
    for (std::size_t k = 0; k < 12; ++k) {
      BeamPose<Dual> p;
      const auto dual = [](const Vector& v) {
        return Vector3<Dual>{Dual{v.x}, Dual{v.y}, Dual{v.z}};
      };
      std::array<Dual, 12> du{};
      du[k] = {0, 1};
      p.chord = dual(pose.chord) + Vector3<Dual>{du[3] - du[0], du[4] - du[1], du[5] - du[2]};
      const auto turned = [&](const Vector& v, std::size_t n) {
        return dual(v) + cross(Vector3<Dual>{du[n], du[n + 1], du[n + 2]}, dual(v));
      };
      p.normal_i = turned(pose.normal_i, 6);
      p.normal_j = turned(pose.normal_j, 9);
      const auto half = [&](std::size_t n) {
        const Dual h{0.5};
        return Quaternion<Dual>{Dual{1.0}, {h * du[n], h * du[n + 1], h * du[n + 2]}};
      };
      const Quaternion<Dual> relative{Dual{pose.relative_turn.w}, dual(pose.relative_turn.v)};
      p.relative_turn = half(9) * relative * conjugate(half(6));
      const Dual energy = beam_energy<Dual>(rigidity<Dual>(), Dual{l}, p);
      const double scale = k < 6 ? largest / l : largest;
      EXPECT_NEAR(-energy.derivative, expected[k], 1e-9 * scale) << size << " " << k;
    }
  }
}

TEST(EulerBernoulliBeam, rigid_motion_of_any_size_gives_no_load) {
  const double ES = E * pi * r * r;
  for (const double angle : {0.1, 1.0, 3.0, 40.0}) {
    const Vector axis{0.36 * angle, 0.48 * angle, 0.8 * angle};
    Quaternion<double> q;
    for (int n = 0; n < 100; ++n) q = turn(q, axis, 0.01);
    const Vector chord = rotate(q, Vector{l, 0, 0});
    const auto load =
        beam_load<double>(rigidity<double>(), l, beam_pose<double>(chord, {1, 0, 0}, q, q));
    EXPECT_LT(norm(load.force), 1e-12 * ES) << angle;
    EXPECT_LT(norm(load.moment_i), 1e-12 * ES * l) << angle;
    EXPECT_LT(norm(load.moment_j), 1e-12 * ES * l) << angle;
  }
}

TEST(EulerBernoulliBeam, either_end_sees_the_same_beam) {
  for (const double size : {1e-5, 0.1, 1.0}) {
    const State u = arbitrary(size);
    const BeamPose<double> pose = pose_of(u);
    const Quaternion<double> qi = turn(Quaternion<double>{}, {u[6], u[7], u[8]}, 1.0);
    const Quaternion<double> qj = turn(Quaternion<double>{}, {u[9], u[10], u[11]}, 1.0);
    const auto from_i = beam_load<double>(rigidity<double>(), l, pose);
    const auto from_j = beam_load<double>(rigidity<double>(), l,
                                          beam_pose<double>(-pose.chord, {-1, 0, 0}, qj, qi));
    EXPECT_LT(norm(from_i.force + from_j.force), 1e-14 * norm(from_i.force));
    EXPECT_LT(norm(from_i.moment_i - from_j.moment_j), 1e-13 * norm(from_i.moment_i));
    EXPECT_LT(norm(from_i.moment_j - from_j.moment_i), 1e-13 * norm(from_i.moment_j));
  }
}

TEST(EulerBernoulliBeam, keeps_angular_momentum) {
  for (const double size : {1e-3, 0.5, 1.5}) {
    const State u = arbitrary(size);
    const BeamPose<double> pose = pose_of(u);
    const auto load = beam_load<double>(rigidity<double>(), l, pose);
    const Vector sum = load.moment_i + load.moment_j - cross(pose.chord, load.force);
    EXPECT_LT(norm(sum), 1e-14 * (norm(load.moment_i) + norm(load.moment_j))) << size;
  }
}

TEST(EulerBernoulliBeam, finite_bending_departs_from_linear_with_the_square_of_the_angle) {
  const auto departure = [](double angle) {
    State u{};
    u[11] = angle;
    return std::fabs(as_array(loads_of(u))[8] / linear_loads(u)[8] - 1);
  };
  EXPECT_NEAR(departure(0.1) / departure(0.05), 4, 0.05);
  EXPECT_NEAR(departure(0.1), 0.01 / 6, 1e-5);
}

}  // namespace solidem::beam_test
