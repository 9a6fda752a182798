// SPDX-License-Identifier: GPL-2.0-or-later
#include "laws/bond_damping.hpp"

#include <gtest/gtest.h>

#include <random>

namespace solidem::test::bond_damping_test {

typedef Vector3<double> Vector;

const BondModeFactors<double> dashpots{3.0, 0.7, 0.4, 0.9};

TEST(BondDampingLaw, RigidMotionMeetsNothingAndLoadsSumToNoForceAndNoMoment) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const auto any = [&] { return Vector{normal(random), normal(random), normal(random)}; };
  for (int n = 0; n < 20; ++n) {
    const Vector chord = any(), turn = any();
    const DashpotAction<double> rigid =
        bond_damping(dashpots, chord, {cross(turn, chord), turn, turn});
    EXPECT_NEAR(norm(rigid.load.force) + norm(rigid.load.moment_i) + norm(rigid.load.moment_j), 0,
                1e-13);
    const BondMotion<double> motion{any(), any(), any()};
    const DashpotAction<double> action = bond_damping(dashpots, chord, motion);
    const BeamLoad<double>& load = action.load;
    EXPECT_NEAR(norm(load.moment_i + load.moment_j - cross(chord, load.force)), 0, 1e-13);
    // What the loads take from the motion is the power: F_j = −F_i.
    const double taken = dot(load.force, motion.approach) - dot(load.moment_i, motion.spin_i) -
                         dot(load.moment_j, motion.spin_j);
    EXPECT_NEAR(action.power, taken, 1e-12);
    EXPECT_GT(action.power, 0);
  }
}

TEST(BondDampingLaw, WithTheStiffnessOfTheModesForDashpotsItIsTheBeamInSmallMotion) {
  const BeamSection<double> section{70e9, 27e9, 4e-5};
  const double length = 2.1e-4;
  const BeamRigidity<double> rigidity = timoshenko_rigidity(section, length, 0.9);
  const Vector direction{0.6, 0, 0.8};
  const double small = 1e-6;
  const Vector moved{0.3e-4, -0.7e-4, 0.2e-4}, turned_i{0.5, -0.2, 0.9}, turned_j{-0.4, 0.8, 0.3};
  const auto quaternion = [small](const Vector& turn) {
    return Quaternion<double>{1, 0.5 * small * turn};
  };
  const BeamLoad<double> beam = beam_load(rigidity, length,
                                          beam_pose(length * direction + small * moved, direction,
                                                    quaternion(turned_i), quaternion(turned_j)));
  const BeamLoad<double> linear = bond_damping(bond_mode_stiffness(rigidity, length),
                                               length * direction, {moved, turned_i, turned_j})
                                      .load;
  EXPECT_NEAR(norm((1 / small) * beam.force - linear.force), 0, 1e-5 * norm(linear.force));
  EXPECT_NEAR(norm((1 / small) * beam.moment_i - linear.moment_i), 0, 1e-5 * norm(linear.moment_i));
  EXPECT_NEAR(norm((1 / small) * beam.moment_j - linear.moment_j), 0, 1e-5 * norm(linear.moment_j));
}

TEST(BondDampingLaw, DashpotsOfRatioOneAreCritical) {
  const BondInertia<double> inertia{2.0, 5.0};
  const BeamRigidity<double> rigidity{10, 2, 1.5, 3};
  const BondModeFactors<double> c = bond_dashpots(1.0, rigidity, 0.5, inertia);
  const BondModeFactors<double> k = bond_mode_stiffness(rigidity, 0.5);
  const BondModeFactors<double> light = bond_mode_lightness(inertia, 0.5);
  EXPECT_DOUBLE_EQ(c.axial * c.axial * light.axial, 4 * k.axial);
  EXPECT_DOUBLE_EQ(c.opening * c.opening * light.opening, 4 * k.opening);
  EXPECT_DOUBLE_EQ(c.shear * c.shear * light.shear, 4 * k.shear);
  EXPECT_DOUBLE_EQ(c.twist * c.twist * light.twist, 4 * k.twist);
  EXPECT_DOUBLE_EQ(light.shear, 5.0 / 4 + 2.0 / 0.25);
}

}  // namespace solidem::test::bond_damping_test
