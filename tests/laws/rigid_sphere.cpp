// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/rigid_sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace solidem::rigid_sphere_test {

using Vector = Vector3<double>;

TEST(RigidSphere, a_step_turns_by_exactly_the_angle) {
  for (const double angle : {1e-9, 1e-3, 0.3, 0.8}) {
    const Vector v = rotate(turn(Quaternion<double>{}, {0, 0, angle}, 1.0), Vector{1, 0, 0});
    EXPECT_NEAR(v.x, std::cos(angle), 2e-16 + 1e-16 * angle);
    EXPECT_NEAR(v.y, std::sin(angle), 2e-16);
  }
}

TEST(RigidSphere, stays_a_rotation_however_fast_it_spins) {
  Quaternion<double> q;
  for (int n = 0; n < 1000; ++n) q = turn(q, {3.0, -20.0, 7.0}, 0.3);
  EXPECT_NEAR(q.w * q.w + dot(q.v, q.v), 1, 4e-16);
}

TEST(RigidSphere, turning_back_undoes_turning) {
  Quaternion<double> q = turn(Quaternion<double>{}, {0.3, 0.2, -0.9}, 1.0);
  const Quaternion<double> before = q;
  q = turn(turn(q, {1.0, 0.5, 0.2}, 0.01), {1.0, 0.5, 0.2}, -0.01);
  EXPECT_NEAR(q.w, before.w, 2e-16);
  EXPECT_NEAR(norm(q.v - before.v), 0, 3e-16);
}

TEST(RigidSphere, the_matrix_of_a_quaternion_turns_alike) {
  const Quaternion<double> q = turn(Quaternion<double>{}, {0.3, 1.2, -0.9}, 1.0);
  const Vector v{0.2, -1.4, 0.7};
  EXPECT_LT(norm(rotate(q, v) - rotate(Rotation<double>(q), v)), 5e-16);
}

}  // namespace solidem::rigid_sphere_test
