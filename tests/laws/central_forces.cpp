// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "laws/central_interaction.hpp"
#include "laws/central_laws.hpp"
#include "laws/crack_face.hpp"

namespace solidem::central_forces_test {

constexpr double eq = 3e-4;      // δ_eq, m
constexpr double gamma_ = 25;    // γ, N
constexpr double deepest = 0.3;  // overlap from which the continuation goes on
constexpr double range = 1.5 * eq;

/// Parameters of the size the sources use, for whatever law it is.
template <class Law>
Law typical() {
  Law law;
  for (const auto& parameter : Law::parameters()) {
    const std::string name = parameter.name;
    switch (parameter.quantity) {
      case LawQuantity::energy:
        law.*parameter.place = name.rfind("beyond", 0) == 0 ? 1e-4 : 2.4e-3;
        break;
      case LawQuantity::force:
        law.*parameter.place = gamma_;
        break;
      case LawQuantity::stiffness:
        law.*parameter.place = 1.5e6;
        break;
      case LawQuantity::ratio:
        law.*parameter.place = name == "threshold_strain" ? 0.005 : 1.15;
        break;
      case LawQuantity::exponent:
        law.*parameter.place = name.find("repulsive") != std::string::npos ? 8 : 4;
        break;
    }
  }
  EXPECT_EQ(law.complaint(), nullptr) << Law::name;
  return law;
}

template <class Visit>
void for_each_typical_law(Visit&& visit) {
  CentralLaws::for_each([&](auto law) {
    SCOPED_TRACE(law.name);
    visit(typical<decltype(law)>());
  });
}

template <class Law>
double force(const Law& law, double distance) {
  return law.force(separation(distance, eq));
}
template <class Law>
double stiffness(const Law& law, double distance) {
  return bare_force(law, distance, eq).stiffness;
}

/// A force that errors are measured against: the larger one of what acts and of what acts at a
/// change of distance by a hundredth.
template <class Law>
double scale(const Law& law, double distance) {
  return std::max(std::abs(force(law, distance)), 0.01 * stiffness(law, eq) * eq);
}

TEST(CentralLaws, ForceIsTheDerivativeOfThePotential) {
  for_each_typical_law([](const auto& law) {
    for (double ratio = 0.5; ratio < 2.5; ratio += 0.0137) {
      const Dual potential = law.potential(separation(Dual(ratio * eq, 1), Dual(eq)));
      EXPECT_NEAR(force(law, ratio * eq), -potential.derivative, 1e-12 * scale(law, ratio * eq))
          << "at " << ratio;
    }
  });
}

TEST(CentralLaws, AtTheEquilibriumThereIsNoForceAndThePotentialIsLeast) {
  for_each_typical_law([](const auto& law) {
    EXPECT_NEAR(force(law, eq), 0, 1e-12 * scale(law, eq));
    EXPECT_GT(stiffness(law, eq), 0);
    for (double ratio = 0.8; ratio < 1.6; ratio += 0.01) {
      EXPECT_GE(law.potential(separation(ratio * eq, eq)),
                law.potential(separation(eq, eq)) * (1 + 1e-14) - 1e-18);
      EXPECT_EQ(force(law, ratio * eq) > 0, ratio < 1 - 1e-9) << "at " << ratio;
    }
  });
}

TEST(CentralLaws, NamesAreUniqueAndParametersSayWhatTheyAre) {
  std::vector<std::string> names;
  for_each_typical_law([&](const auto& law) {
    names.emplace_back(law.name);
    std::vector<std::string> parameters;
    for (const auto& parameter : law.parameters()) {
      parameters.emplace_back(parameter.name);
      EXPECT_FALSE(std::string(parameter.meaning).empty()) << parameter.name;
    }
    std::sort(parameters.begin(), parameters.end());
    EXPECT_EQ(std::unique(parameters.begin(), parameters.end()), parameters.end());
  });
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

TEST(CentralLaws, ParametersThatDoNotGoTogetherAreRefused) {
  Mie mie = typical<Mie>();
  mie.attractive_exponent = mie.repulsive_exponent;
  EXPECT_NE(mie.complaint(), nullptr);
  ShiftedLennardJones shifted = typical<ShiftedLennardJones>();
  shifted.peak_separation = 1;
  EXPECT_NE(shifted.complaint(), nullptr);
  Threshold threshold = typical<Threshold>();
  threshold.threshold_strain = 1;
  EXPECT_NE(threshold.complaint(), nullptr);
  threshold = typical<Threshold>();
  threshold.beyond_attractive_exponent = threshold.beyond_repulsive_exponent;
  EXPECT_NE(threshold.complaint(), nullptr);
}

TEST(LennardJones, IsThatOfTwelveAndSix) {
  const LennardJones law{2.4e-3};
  const Mie mie{2.4e-3, 12, 6};
  for (double ratio = 0.7; ratio < 2; ratio += 0.01) {
    EXPECT_NEAR(force(law, ratio * eq), force(mie, ratio * eq), 1e-12 * scale(law, ratio * eq));
    EXPECT_NEAR(law.potential(separation(ratio * eq, eq)),
                mie.potential(separation(ratio * eq, eq)),
                1e-12 * std::max(2.4e-3, law.potential(separation(ratio * eq, eq))));
  }
  EXPECT_DOUBLE_EQ(law.potential(separation(eq, eq)), -2.4e-3);
}

TEST(LennardJones, LargestAttractionIsThePublishedOne) {
  const LennardJones law{2.4e-3};
  const double there = std::pow(13.0 / 7, 1.0 / 6) * eq;
  EXPECT_NEAR(stiffness(law, there), 0, 1e-12 * stiffness(law, eq));
  EXPECT_NEAR(-force(law, there), 2.690 * 2.4e-3 / eq, 5e-4 * 2.4e-3 / eq);
}

TEST(ShiftedLennardJones, AttractsMostAtTheGivenPlaceAndByTheGivenForce) {
  for (const double peak : {1.05, 1.1, 1.15, 1.3, 1.8}) {
    const ShiftedLennardJones law{gamma_, peak};
    EXPECT_NEAR(force(law, peak * eq), -gamma_, 1e-12 * gamma_) << peak;
    EXPECT_NEAR(stiffness(law, peak * eq), 0, 1e-12 * stiffness(law, eq)) << peak;
    for (double ratio = 1; ratio < 2.5; ratio += 0.01)
      EXPECT_GE(force(law, ratio * eq), -gamma_ * (1 + 1e-12)) << peak << ", " << ratio;
  }
}

TEST(ShiftedLennardJones, StiffnessAtTheEquilibriumIsThePublishedOne) {
  const double q = std::pow(13.0 / 7, 1.0 / 6), peak = std::pow(q, -7) - std::pow(q, -13);
  EXPECT_NEAR(12 * peak, 2.690, 5e-4);
  for (const double ratio : {1.05, 1.15, 1.5}) {
    const double energy = gamma_ * eq / (12 * peak), slope = (q - 1) / (ratio - 1);
    EXPECT_NEAR(stiffness(ShiftedLennardJones{gamma_, ratio}, eq), 72 * slope * energy / (eq * eq),
                1e-12 * 72 * slope * energy / (eq * eq));
  }
}

TEST(ShiftedLennardJones, IsThePlainOneWhereThePeakIsNotMoved) {
  const double q = std::pow(13.0 / 7, 1.0 / 6);
  const double peak = 12 * (std::pow(q, -7) - std::pow(q, -13));
  const LennardJones plain{gamma_ * eq / peak};
  const ShiftedLennardJones law{gamma_, q};
  for (double ratio = 0.7; ratio < 2; ratio += 0.01) {
    EXPECT_NEAR(force(law, ratio * eq), force(plain, ratio * eq), 1e-12 * scale(plain, ratio * eq));
    EXPECT_NEAR(law.potential(separation(ratio * eq, eq)),
                plain.potential(separation(ratio * eq, eq)),
                1e-12 * std::max(plain.energy, plain.potential(separation(ratio * eq, eq))));
  }
}

TEST(ShiftedLennardJones, PushesWithAFiniteForceThroughFullInterpenetration) {
  for (const double peak : {1.109, 1.15, 1.5}) {
    const ShiftedLennardJones law{gamma_, peak};
    // Not even the pole of 1/δ is left; the limit from distances that are ever smaller.
    const double at_zero = force(law, 1e-12 * eq), near_zero = force(law, 1e-6 * eq);
    EXPECT_TRUE(std::isfinite(at_zero)) << peak;
    EXPECT_NEAR(at_zero / near_zero, 1, 0.01) << peak;
    EXPECT_GT(at_zero, gamma_) << peak;
  }
}

TEST(Mie, StiffnessAtTheEquilibriumIsThePublishedOne) {
  for (const auto& [m, n] : {std::pair{12, 6}, {8, 4}, {6, 3}, {2, 1}, {9, 2}}) {
    const double expected = m * n * 2.4e-3 / (eq * eq);
    const Mie law{2.4e-3, double(m), double(n)};
    EXPECT_NEAR(stiffness(law, eq), expected, 1e-12 * expected) << m << ", " << n;
    // The well is as deep as the energy says.
    EXPECT_NEAR(law.potential(separation(eq, eq)), -2.4e-3, 1e-15) << m << ", " << n;
  }
}

TEST(Mie, StiffensWithTheOverlapAsPublished) {
  struct Row {
    double overlap, twelve_six, eight_four;
  };
  const Mie steep{1, 12, 6}, soft{1, 8, 4};
  for (const Row& row : {Row{0.1, 6.8, 4}, {0.2, 42, 16}, {0.3, 299, 69}}) {
    const double distance = (1 - row.overlap) * eq;
    const auto rounded = [](double value, double unit) { return unit * std::round(value / unit); };
    EXPECT_NEAR(
        rounded(stiffness(steep, distance) / stiffness(steep, eq), row.overlap < 0.15 ? 0.1 : 1),
        row.twelve_six, 1e-9);
    EXPECT_NEAR(rounded(stiffness(soft, distance) / stiffness(soft, eq), 1), row.eight_four, 1e-9);
  }
}

TEST(Threshold, IsContinuousAndIsTheFirstLawInside) {
  const Threshold law = typical<Threshold>();
  const Mie first{law.energy, law.repulsive_exponent, law.attractive_exponent};
  const Mie second{law.beyond_energy, law.beyond_repulsive_exponent,
                   law.beyond_attractive_exponent};
  for (const double side : {-1.0, 1.0}) {
    const double edge = (1 + side * law.threshold_strain) * eq, step = 1e-12 * eq;
    EXPECT_NEAR(force(law, edge - step), force(law, edge + step), 4 * step * stiffness(law, eq));
    EXPECT_NEAR(law.potential(separation(edge - step, eq)),
                law.potential(separation(edge + step, eq)), 1e-11 * law.energy);
    // Beyond, the second law begins anew at its equilibrium, from the force that is reached.
    for (const double further : {0.01, 0.05, 0.1}) {
      const double distance = edge + side * further * eq;
      EXPECT_NEAR(force(law, distance),
                  force(second, (1 + side * further) * eq) + force(first, edge),
                  1e-12 * scale(law, distance));
    }
  }
  for (double strain = -0.0049; strain < 0.005; strain += 0.0007)
    EXPECT_DOUBLE_EQ(force(law, (1 + strain) * eq), force(first, (1 + strain) * eq));
}

TEST(Piecewise, HasASlopeAndAPlateau) {
  const Piecewise law{1.5e6, gamma_};
  for (const double ratio : {0.1, 0.7, 0.99, 1.0}) {
    EXPECT_NEAR(force(law, ratio * eq), 1.5e6 * (1 - ratio) * eq, 1e-12 * 1.5e6 * eq);
    EXPECT_DOUBLE_EQ(stiffness(law, ratio * eq), 1.5e6);
  }
  for (const double ratio : {1.06, 1.2, 1.9}) {
    EXPECT_DOUBLE_EQ(force(law, ratio * eq), -gamma_);
    EXPECT_DOUBLE_EQ(stiffness(law, ratio * eq), 0);
  }
}

TEST(CentralInteraction, GoesOnStraightBelowTheDeepestOverlap) {
  for_each_typical_law([](const auto& law) {
    const double edge = (1 - deepest) * eq;
    const ForceAndStiffness there = bare_force(law, edge, eq);
    for (const double ratio : {0.69999, 0.5, 0.1, 0.0, -0.1}) {
      const ForceAndStiffness at = central_force(law, deepest, ratio * eq, eq);
      EXPECT_DOUBLE_EQ(at.stiffness, there.stiffness) << ratio;
      EXPECT_NEAR(at.force, there.force + there.stiffness * (edge - ratio * eq),
                  1e-12 * there.stiffness * eq)
          << ratio;
    }
    const double step = 1e-9 * eq;
    EXPECT_NEAR(central_force(law, deepest, edge - step, eq).force,
                central_force(law, deepest, edge + step, eq).force, 2.001 * step * there.stiffness);
    EXPECT_EQ(central_force(law, deepest, 0.9 * eq, eq).force, force(law, 0.9 * eq));
  });
}

TEST(CentralInteraction, PotentialIsTheWorkToTheRange) {
  for_each_typical_law([](const auto& law) {
    const auto potential = [&](double d) { return central_potential(law, deepest, range, d, eq); };
    EXPECT_EQ(potential(range), 0);
    // Simpson's rule is exact for the straight part, and as good as exact for small steps.
    const double from = 0.2 * eq, to = 0.98 * (1 - deepest) * eq;
    const auto f = [&](double d) { return central_force(law, deepest, d, eq).force; };
    const double work = (to - from) / 6 * (f(from) + 4 * f((from + to) / 2) + f(to));
    EXPECT_NEAR(potential(from) - potential(to), work, 1e-12 * std::abs(potential(from)));
    const double edge = (1 - deepest) * eq;
    EXPECT_NEAR(potential(edge * (1 - 1e-13)), potential(edge),
                1e-11 * std::abs(potential(edge)) + 1e-12 * f(edge) * eq);
  });
}

class Pairs : public testing::Test {
 protected:
  Vector3<double> any_vector() { return {number_(random_), number_(random_), number_(random_)}; }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> number_{-1, 1};
};

TEST_F(Pairs, DissipationOnlyTakesEnergyAndIsTheSameSeenFromBothSides) {
  constexpr double c = 0.08;
  for (int k = 0; k < 1000; ++k) {
    const Vector3<double> chord = any_vector(), velocity_i = any_vector(),
                          velocity_j = any_vector();
    const double distance = norm(chord), inverse = 1 / distance;
    const double on_i = dissipative_force(c, chord, inverse, velocity_i - velocity_j);
    const double on_j = dissipative_force(c, -chord, inverse, velocity_j - velocity_i);
    EXPECT_EQ(on_i, on_j);
    // Both forces are along their own n, which points from the other element.
    const Vector3<double> n = -inverse * chord;
    const double power = on_i * dot(n, velocity_i) - on_j * dot(n, velocity_j);
    EXPECT_LE(power, 0);
    const double rate = dot(n, velocity_i - velocity_j);
    EXPECT_NEAR(power, -c * rate * rate, 1e-14);
    // Two that move alike, or across their chord, lose nothing.
    EXPECT_EQ(dissipative_force(c, chord, inverse, velocity_i - velocity_i), 0);
    EXPECT_NEAR(dissipative_force(c, chord, inverse, cross(chord, velocity_i)), 0, 1e-16);
  }
}

TEST_F(Pairs, LipsAreTheSameSeenFromBothSidesAndInAMirror) {
  int opposite = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vector3<double> chord = any_vector(), i = any_vector(), j = any_vector();
    const bool seen = on_opposite_faces(i, j, chord);
    opposite += seen;
    EXPECT_EQ(seen, on_opposite_faces(j, i, -chord));
    EXPECT_EQ(seen, on_opposite_faces(-i, -j, -chord));
    const auto mirrored = [](const Vector3<double>& v) { return Vector3<double>{-v.x, v.y, v.z}; };
    EXPECT_EQ(seen, on_opposite_faces(mirrored(i), mirrored(j), mirrored(chord)));
    EXPECT_EQ(seen, dot(i, chord) < 0 && dot(j, chord) > 0);
  }
  // A quarter of all random pairs point away from each other.
  EXPECT_NEAR(opposite, 250, 60);
}

TEST_F(Pairs, ALipShowsItsBarycentreAndAnInnerElementShowsNothing) {
  const Vector3<double> sum{3, 0, 4};  // of 10 neighbours: the barycentre is .5 away
  const Vector3<double> crack_face = crack_face_barycentre(sum, 10.0, 0.4),
                        inner = crack_face_barycentre(sum, 10.0, 0.6);
  EXPECT_DOUBLE_EQ(norm(crack_face), 0.5);
  EXPECT_EQ(norm(inner), 0);
  // An element alone is on none; who shows nothing stands opposite nobody.
  EXPECT_EQ(norm(crack_face_barycentre(Vector3<double>{}, 0.0, 0.0)), 0);
  EXPECT_FALSE(on_opposite_faces(inner, {1, 0, 0}, {1, 0, 0}));
  EXPECT_TRUE(on_opposite_faces({-1, 0, 0}, {1, 0, 0}, Vector3<double>{1, 0, 0}));
  EXPECT_FALSE(on_opposite_faces({1, 0, 0}, {-1, 0, 0}, Vector3<double>{1, 0, 0}));
}

}  // namespace solidem::central_forces_test
