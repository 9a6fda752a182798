// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/orthotropic_constants.hpp"
#include "effects/beam_parameters.hpp"
#include "laws/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/Dense>

#include "effects/beam_properties.hpp"
#include "model/error.hpp"
#include "support/specimens.hpp"

namespace solidem::orthotropic_constants_test {

constexpr GrainAxes<double> axes_of_the_cell{{1, 0, 0}, {0, 1, 0}};

Specimen periodic_packing(std::int64_t elements) {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {1e-3, 1e-3, 1e-3};
  recipe.elements = elements;
  recipe.periodic = {true, true, true};
  return make_specimen(recipe);
}

BeamParameters beams_of(double radius_ratio) {
  BeamParameters beams;
  beams.young_modulus = 3.5e12;
  beams.shear_modulus = 1.35e12;
  beams.radius_ratio = radius_ratio;
  return beams;
}

BeamParameters grained(const GrainAxes<double>& axes) {
  BeamParameters beams = beams_of(0.5);
  Anisotropy grain;
  grain.axes = axes;
  grain.radial_modulus = 0.5e12;
  grain.tangential_modulus = 0.2e12;
  grain.exponent = 3;
  beams.anisotropy = grain;
  return beams;
}

Matrix6 stiffness_of(const BeamParameters& beams, const Specimen& specimen,
                     const GrainAxes<double>& axes = axes_of_the_cell) {
  return effective_stiffness(beam_network(beams, specimen), axes).stiffness;
}

double largest(const Matrix6& m) {
  double result = 0;
  for (const auto& row : m)
    for (const double value : row) result = std::max(result, std::abs(value));
  return result;
}

void expect_near(const Matrix6& a, const Matrix6& b, double fraction) {
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      EXPECT_NEAR(a[i][j], b[i][j], fraction * largest(b)) << i << j;
}

TEST(EffectiveStiffness, OfASimpleCubicLatticeIsExact) {
  // One beam along each axis stands for a square d × d. Stretched, it carries E S / d². Sheared by
  // γ, no element turns, by symmetry, and the ends of a beam move apart by γ d / 2 across it: it
  // carries 12 E I / d³ times that, so G = 6 E I / d⁴.
  const Specimen cell = crystal("simple_cubic", {5, 5, 5}, {true, true, true});
  const BeamParameters beams = beams_of(0.4);
  const double d = 2e-4, r = 0.4e-4;
  const double area = pi * r * r, second = area * r * r / 4;
  const Matrix6 c = stiffness_of(beams, cell);
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) {
      double exact = 0;
      if (a == b && a < 3) exact = beams.young_modulus * area / (d * d);
      if (a == b && a >= 3) exact = 6 * beams.young_modulus * second / (d * d * d * d);
      EXPECT_NEAR(c[a][b], exact, 1e-9 * largest(c)) << a << b;
    }
}

TEST(EffectiveStiffness, OfFacesCentredSpringsFollowsCauchy) {
  // Springs along the twelve directions (±1, ±1, 0)/√2: C = (k/V) Σ l² n⊗n⊗n⊗n, and a lattice of
  // central forces in which each element is a centre of symmetry has C_1122 = C_1212.
  const Specimen cell = crystal("fcc", {4, 4, 4}, {true, true, true});
  BeamParameters beams = beams_of(0.4);
  beams.law = BeamParameters::Law::spring;
  beams.shear_modulus = 0;
  const double d = 2e-4, r = 0.4e-4;
  const double cube = std::sqrt(2.0) * d;  // edge, holds four elements and 24 springs
  const double scale = beams.young_modulus * pi * r * r * d / (cube * cube * cube);
  const Matrix6 c = stiffness_of(beams, cell);
  EXPECT_NEAR(c[0][0], 16 * scale / 4, 1e-9 * c[0][0]);  // 16 of 24 springs, n_x⁴ = 1/4
  EXPECT_NEAR(c[0][1], 8 * scale / 4, 1e-9 * c[0][0]);
  EXPECT_NEAR(c[5][5], 8 * scale / 4, 1e-9 * c[0][0]);
  EXPECT_NEAR(c[0][5], 0, 1e-9 * c[0][0]);
}

TEST(EffectiveStiffness, IsSymmetricAndPositiveDefiniteAndTheEnergyOfTheStrains) {
  const Specimen cell = periodic_packing(200);
  const BeamNetwork network = beam_network(grained(axes_of_the_cell), cell);
  const EffectiveStiffness measured = effective_stiffness(network, axes_of_the_cell);
  EXPECT_LT(measured.asymmetry, 1e-8);
  Eigen::Matrix<double, 6, 6> c;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) c(a, b) = measured.stiffness[std::size_t(a)][std::size_t(b)];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(c);
  EXPECT_GT(solver.eigenvalues()[0], 0);
  for (std::size_t a = 0; a < 6; ++a)
    EXPECT_NEAR(2 * measured.strained[a].energy / cell.domain.volume, measured.stiffness[a][a],
                1e-7 * measured.stiffness[a][a]);
}

TEST(EffectiveStiffness, RateIsTheDerivative) {
  const Specimen cell = periodic_packing(200);
  BeamParameters beams = grained(axes_of_the_cell);
  const auto rigidities = [&](double exponent) {
    beams.anisotropy->exponent = exponent;
    return beam_network(beams, cell);
  };
  const double step = 1e-4;
  const BeamNetwork low = rigidities(3 - step), high = rigidities(3 + step), middle = rigidities(3);
  std::vector<BeamRigidity<double>> rate;
  for (std::size_t b = 0; b < middle.bonds.size(); ++b) {
    const BeamRigidity<double>&l = low.rigidity[b], &h = high.rigidity[b];
    rate.push_back({(h.axial - l.axial) / (2 * step), (h.bending - l.bending) / (2 * step),
                    (h.shear - l.shear) / (2 * step), (h.torsion - l.torsion) / (2 * step)});
  }
  const Matrix6 exact = stiffness_rate(middle, effective_stiffness(middle, axes_of_the_cell), rate);
  const Matrix6 before = effective_stiffness(low, axes_of_the_cell).stiffness;
  const Matrix6 after = effective_stiffness(high, axes_of_the_cell).stiffness;
  Matrix6 measured{};
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < 6; ++b) measured[a][b] = (after[a][b] - before[a][b]) / (2 * step);
  expect_near(exact, measured, 1e-5);
}

TEST(EffectiveStiffness, OfThreeEqualModuliIsThatOfPlainBeamsToTheLastBit) {
  const Specimen cell = periodic_packing(200);
  const BeamParameters plain = beams_of(0.3);
  BeamParameters oriented = plain;
  oriented.anisotropy = Anisotropy{};
  oriented.anisotropy->radial_modulus = oriented.anisotropy->tangential_modulus =
      plain.young_modulus;
  EXPECT_EQ(stiffness_of(plain, cell), stiffness_of(oriented, cell));
}

TEST(EffectiveStiffness, TurnsWithTheSample) {
  // x → y → z → x, body and grain alike.
  Specimen cell = periodic_packing(200);
  add_fibres(cell, {axes_of_the_cell.longitudinal, 2, 0.94});
  BeamParameters beams = grained(axes_of_the_cell);
  beams.fibres = Fibres{};
  const Matrix6 before = stiffness_of(beams, cell);
  Specimen turned = cell;
  for (Vector& p : turned.position) p = {p.z, p.x, p.y};
  const GrainAxes<double> turned_axes{{0, 1, 0}, {0, 0, 1}};
  beams.anisotropy->axes = turned_axes;
  expect_near(stiffness_of(beams, turned, turned_axes), before, 1e-8);
}

TEST(EffectiveStiffness, IsATensor) {
  // The same body measured in other axes: the compliance along any direction is the same.
  const Specimen cell = periodic_packing(200);
  const BeamParameters beams = grained(axes_of_the_cell);
  const Matrix6 s = inverse(stiffness_of(beams, cell));
  const double half = 0.4;
  const Quaternion<double> turn{std::cos(half),
                                (std::sin(half) / std::sqrt(14.0)) * Vector{1, 2, 3}};
  const GrainAxes<double> other{rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0})};
  const Matrix6 turned = inverse(stiffness_of(beams, cell, other));
  for (const Vector& n : {Vector{1, 0, 0}, Vector{0, 0.6, 0.8}, Vector{0.48, 0.6, 0.64}})
    EXPECT_NEAR(young_modulus_along(n, turned) / young_modulus_along(rotate(turn, n), s), 1, 1e-7);
}

TEST(EffectiveStiffness, RefusesBodiesWithoutOne) {
  EXPECT_THROW(stiffness_of(beams_of(0.3), crystal("fcc", {3, 3, 3})), InputError);
  BeamParameters springs = beams_of(0.3);
  springs.law = BeamParameters::Law::spring;
  // A simple cubic lattice of springs does not resist shear.
  const Matrix6 c = stiffness_of(springs, crystal("simple_cubic", {4, 4, 4}, {true, true, true}));
  EXPECT_THROW(orthotropic_constants(c), RunError);
}

TEST(OrthotropicConstants, ComeBackFromTheirStiffness) {
  const OrthotropicConstants wood{
      {14.7e9, 1.0e9, 0.735e9}, {0.94e9, 1.15e9, 0.1e9}, {0.292, 0.449, 0.39}, 0};
  Matrix6 s{};
  const auto& [e, g, nu, coupling] = wood;
  for (std::size_t a = 0; a < 3; ++a) s[a][a] = 1 / e[a];
  s[5][5] = 1 / g[0];
  s[4][4] = 1 / g[1];
  s[3][3] = 1 / g[2];
  s[0][1] = s[1][0] = -nu[0] / e[0];
  s[0][2] = s[2][0] = -nu[1] / e[0];
  s[1][2] = s[2][1] = -nu[2] / e[1];
  const OrthotropicConstants back = orthotropic_constants(inverse(s));
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(back.young_modulus[a], e[a], 1e-9 * e[a]);
    EXPECT_NEAR(back.shear_modulus[a], g[a], 1e-9 * g[a]);
    EXPECT_NEAR(back.poisson_ratio[a], nu[a], 1e-9);
  }
  EXPECT_EQ(back.coupling, coupling);
  // Off the axes: 1/E = c⁴/E_L + s⁴/E_T + c²s²(1/G_LT − 2ν_LT/E_L).
  const double angle = 0.5, c2 = std::pow(std::cos(angle), 2), s2 = 1 - c2;
  const double exact =
      1 / (c2 * c2 / e[0] + s2 * s2 / e[2] + c2 * s2 * (1 / g[1] - 2 * nu[1] / e[0]));
  EXPECT_NEAR(young_modulus_along({std::cos(angle), 0, std::sin(angle)}, s), exact, 1e-9 * exact);
}

}  // namespace solidem::orthotropic_constants_test
