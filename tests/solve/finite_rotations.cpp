// SPDX-License-Identifier: GPL-2.0-or-later
//
// Large deflections against exact solutions.
#include "effects/beam_parameters.hpp"
#include "solve/statics/finite_equilibrium.hpp"

#include <gtest/gtest.h>

#include "model/error.hpp"
#include "solve/bonded_bodies.hpp"

namespace solidem::finite_rotations_test {

/// A cantilever of unit length under a force across its rest direction, k = P L² / EI, thin enough
/// not to stretch: Bisshopp & Drucker, Q. Appl. Math. 3 (1945) 272.
struct Elastica {
  explicit Elastica(double k) {
    const auto left_over = [&](double p) {
      return std::pow(std::comp_ellint_1(p) - std::ellint_1(p, angle(p)), 2) - k;
    };
    double low = std::sqrt(0.5) + 1e-12, high = 1 - 1e-12;
    for (int step = 0; step < 200; ++step) {
      const double middle = 0.5 * (low + high);
      (left_over(middle) < 0 ? low : high) = middle;
    }
    const double p = 0.5 * (low + high), sine = 2 * p * p - 1;
    deflection = 1 - 2 * (std::comp_ellint_2(p) - std::ellint_2(p, angle(p))) / std::sqrt(k);
    reach = std::sqrt(2 * sine / k);
    slope = std::asin(sine);
  }
  static double angle(double p) { return std::asin(1 / (p * std::sqrt(2.0))); }
  double deflection, reach, slope;
};

double elastica_error(int elements, double k) {
  BeamParameters thin = beam_parameters();
  thin.radius_ratio = 0.02;
  const Row row(elements, thin);
  const double L = row.length, P = k * row.bending() / (L * L);
  const Equilibrium e = finite_equilibrium(row.network, row.clamped, {{row.last, {0, P, 0}, {}}});
  EXPECT_FALSE(e.unstable);
  const Elastica exact(k);
  const Vector u = at(e.displacement, row.last);
  return std::max({std::abs(u.y / L - exact.deflection), std::abs(1 + u.x / L - exact.reach),
                   std::abs(at(e.rotation, row.last).z - exact.slope)});
}

TEST(FiniteRotations, ElasticaUnderAForce) {
  EXPECT_LT(elastica_error(81, 1), 1e-4);
  EXPECT_LT(elastica_error(81, 10), 1e-3);
}

TEST(FiniteRotations, ElasticaConvergesWithTheSquareOfTheElements) {
  const double coarse = elastica_error(11, 4), fine = elastica_error(41, 4);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2, 0.1);
}

TEST(FiniteRotations, MomentRollsARowIntoAnArc) {
  const Row row(81);
  const double turn = 4;  // rad, more than half a circle
  const Equilibrium e = finite_equilibrium(
      row.network, row.clamped, {{row.last, {}, {0, 0, turn * row.bending() / row.length}}});
  const double radius = row.length / turn;
  const Vector u = at(e.displacement, row.last);
  EXPECT_NEAR((row.length + u.x) / radius, std::sin(turn), 0.005);
  EXPECT_NEAR(u.y / radius, 1 - std::cos(turn), 0.005);
  EXPECT_NEAR(at(e.rotation, row.last).z, turn - 2 * pi, 0.003);
}

TEST(FiniteRotations, SmallLoadsMoveAsInSmallMotion) {
  const Row row(21);
  const auto deviation = [&](double k) {
    const double P = k * row.bending() / (row.length * row.length);
    const std::vector<ElementLoad> loads = {{row.last, {0, P, 0}, {}}};
    const Equilibrium small = small_equilibrium(row.network, row.clamped, loads);
    const Equilibrium finite = finite_equilibrium(row.network, row.clamped, loads);
    return std::abs(at(finite.displacement, row.last).y / at(small.displacement, row.last).y - 1);
  };
  const double at_small = deviation(0.02), at_ten_times = deviation(0.2);
  EXPECT_LT(at_small, 1e-4);
  EXPECT_NEAR(std::log10(at_ten_times / at_small), 2, 0.05);  // of second order in the load
}

TEST(FiniteRotations, RigidTurnStrainsNothing) {
  const Specimen body = jittered("bcc", {4, 3, 3});
  const BeamNetwork network = beam_network(beam_parameters(), body);
  const double turn = 0.7;
  const Vector middle = 0.5 * (body.domain.lower + body.domain.upper);
  const Quaternion<double> q{std::cos(turn / 2), {0, 0, std::sin(turn / 2)}};
  std::vector<Constraint> moved = stretched(body, 0);
  for (Constraint& c : moved) {
    const Vector arm = at(body.position, c.element) - middle;
    c.value = c.degree < 3 ? component(rotate(q, arm) - arm, c.degree) : c.degree == 5 ? turn : 0.0;
  }
  const Equilibrium e = finite_equilibrium(network, moved, {});
  const Equilibrium strained = small_equilibrium(network, stretched(body, 1e-5), {});
  EXPECT_LT(e.energy, 1e-12 * strained.energy);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Vector arm = body.position[i] - middle;
    EXPECT_LT(norm(e.displacement[i] - (rotate(q, arm) - arm)), 1e-10);
    EXPECT_NEAR(e.rotation[i].z, turn, 1e-6);
  }
}

TEST(FiniteRotations, ColumnBucklesAtEulersLoad) {
  const Row row(41);
  const double critical = pi * pi * row.bending() / (4 * row.length * row.length);
  const auto unstable = [&](double fraction) {
    return finite_equilibrium(row.network, row.clamped,
                              {{row.last, {-fraction * critical, 0, 0}, {}}})
        .unstable;
  };
  EXPECT_FALSE(unstable(0.995));
  EXPECT_TRUE(unstable(1.005));
}

TEST(FiniteRotations, PulledBodyNeedsTheWorkThatItStores) {
  // The force on a grip is the rate of the energy by its displacement.
  const Specimen body = jittered("bcc", {4, 2, 2});
  const BeamNetwork network = beam_network(beam_parameters(), body);
  const auto pulled = [&](double displacement) {
    FiniteOptions options;
    options.tolerance = 1e-12;
    return finite_equilibrium(network, stretched(body, displacement), {}, options);
  };
  const double u = 4e-5, du = 1e-7;  // 5 % of strain
  double force = 0;
  const Equilibrium e = pulled(u);
  for (const std::int32_t i : select(face(0, true), body)) force += at(e.reaction, i).x;
  const double rate = (pulled(u + du).energy - pulled(u - du).energy) / (2 * du);
  EXPECT_NEAR(rate / force, 1, 1e-5);
}

}  // namespace solidem::finite_rotations_test
