// SPDX-License-Identifier: GPL-2.0-or-later
//
// A row of beams against beam theory.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "model/error.hpp"
#include "solve/bonded_bodies.hpp"

namespace solidem::static_beams_test {

using Law = BeamParameters::Law;

class StaticBeam : public ::testing::TestWithParam<LinearMethod> {
 protected:
  EquilibriumOptions options() const {
    EquilibriumOptions options;
    options.method = GetParam();
    return options;
  }
};

TEST_P(StaticBeam, CantileverBendsByBeamTheory) {
  const Row row(41);
  const double P = 1e-3;
  const Equilibrium e =
      small_equilibrium(row.network, row.clamped, {{row.last, {0, P, 0}, {}}}, options());
  const double L = row.length;
  EXPECT_NEAR(at(e.displacement, row.last).y / (P * L * L * L / (3 * row.bending())), 1, 1e-6);
  EXPECT_NEAR(at(e.rotation, row.last).z / (P * L * L / (2 * row.bending())), 1, 1e-6);
  EXPECT_NEAR(at(e.reaction, row.first).y / P, -1, 1e-6);
  EXPECT_NEAR(at(e.reaction_moment, row.first).z / (P * L), -1, 1e-6);
}

TEST_P(StaticBeam, TimoshenkoCantileverShearsAsWell) {
  BeamParameters thick = beam_parameters(Law::timoshenko);
  thick.radius_ratio = 0.8;
  const Row row(4, thick);
  const double P = 1e-3, L = row.length;
  const Equilibrium e =
      small_equilibrium(row.network, row.clamped, {{row.last, {0, 0, P}, {}}}, options());
  const double bent = P * L * L * L / (3 * row.bending());
  const double sheared = P * L / (0.9 * row.shear * row.area);
  ASSERT_GT(sheared / bent, 0.01);  // so that its absence would show
  EXPECT_NEAR(at(e.displacement, row.last).z / (bent + sheared), 1, 1e-9);
}

TEST_P(StaticBeam, PullAndTorque) {
  const Row row(11);
  const double P = 1e-2, T = 1e-7;
  const Equilibrium e =
      small_equilibrium(row.network, row.clamped, {{row.last, {P, 0, 0}, {T, 0, 0}}}, options());
  EXPECT_NEAR(at(e.displacement, row.last).x / (P * row.length / (row.young * row.area)), 1, 1e-9);
  EXPECT_NEAR(at(e.rotation, row.last).x / (T * row.length / (row.shear * 2 * row.second_moment)),
              1, 1e-9);
}

TEST_P(StaticBeam, SpringsNeedNoStiffnessOfRotation) {
  const Row row(11, beam_parameters(Law::spring));
  // Held in its line, for springs in a row do not resist being moved out of it.
  std::vector<Constraint> held;
  for (std::int32_t e = 0; e < 11; ++e)
    for (int axis = 1; axis < 3; ++axis) held.push_back({e, axis, 0.0});
  held.push_back({row.first, 0, 0.0});
  const double P = 1e-2;
  const Equilibrium e =
      small_equilibrium(row.network, held, {{row.last, {P, 0, 0}, {}}}, options());
  EXPECT_NEAR(at(e.displacement, row.last).x / (P * row.length / (row.young * row.area)), 1, 1e-9);
  for (const Vector& turn : e.rotation) EXPECT_EQ(norm(turn), 0);
  EXPECT_THROW(
      small_equilibrium(row.network, held, {{row.last, {P, 0, 0}, {0, 0, 1e-9}}}, options()),
      InputError);
}

INSTANTIATE_TEST_SUITE_P(Methods, StaticBeam,
                         ::testing::Values(LinearMethod::factorised, LinearMethod::iterated,
                                           LinearMethod::automatic));

std::string refusal(const Row& row, const std::vector<Constraint>& constraints) {
  try {
    small_equilibrium(row.network, constraints, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StaticBeam, NamesTheRigidMotionThatIsFree) {
  const Row row(5);
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(says(refusal(row, {}), "shift along any direction; it can turn about any direction"));
  std::vector<Constraint> pinned(row.clamped.begin(), row.clamped.begin() + 3);
  EXPECT_TRUE(says(refusal(row, pinned), "not held: it can turn about any direction"));
  pinned.push_back({row.last, 1, 0.0});
  pinned.push_back({row.last, 2, 0.0});
  EXPECT_TRUE(says(refusal(row, pinned), "not held: it can turn about x;"));
  pinned.push_back({row.last, 3, 0.0});
  EXPECT_EQ(refusal(row, pinned), "accepted");
  std::vector<Constraint> sliding(row.clamped.begin() + 1, row.clamped.end());
  EXPECT_TRUE(says(refusal(row, sliding), "not held: it can shift along x;"));
}

TEST(StaticBeam, RefusesTwoValuesForOneDegreeOfFreedom) {
  const Row row(5);
  std::vector<Constraint> twice = row.clamped;
  twice.push_back({row.first, 0, 1e-6});
  EXPECT_THROW(small_equilibrium(row.network, twice, {}), InputError);
}

TEST(StaticBeam, SpringsOutOfLineAreAMechanismAndSaidToBe) {
  // A bent row of springs, held at both ends, folds without resistance.
  Row row(6, beam_parameters(Law::spring));
  for (Vector& p : row.specimen.position) p.y += 2e-5 * std::sin(4e4 * p.x);
  std::vector<Constraint> ends;
  for (const std::int32_t e : {row.first, row.last})
    for (int axis = 0; axis < 3; ++axis) ends.push_back({e, axis, 0.0});
  std::vector<Constraint> held = ends;
  for (std::int32_t e = 0; e < 6; ++e)
    if (e != row.first && e != row.last) held.push_back({e, 2, 0.0});
  held.push_back({row.first, 3, 0.0});
  const std::int32_t middle = row.network.bonds[2].i;
  EXPECT_ANY_THROW(small_equilibrium(row.network, held, {{middle, {1e-3, 1e-3, 0}, {}}}));
}

}  // namespace solidem::static_beams_test
