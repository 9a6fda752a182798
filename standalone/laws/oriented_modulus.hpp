// SPDX-License-Identifier: GPL-2.0-or-later
//
// A modulus that depends on the direction of a bond against the grain of the material, as in wood:
// stiff along the grain, soft across it.
//
// Source: the power of the cosine is the form used for wood by bonded elements (beams whose moduli
// follow their angle to the grain); the transverse plane is added here.
//
// Symbols
//   n            unit direction of the bond at rest; n and −n are the same bond
//   L, R, T      longitudinal axis (the grain), radial axis and tangential axis, T = L × R
//   θ            angle of n to L; φ the angle of its transverse part to R
//   M_L, M_R, M_T  the modulus of a bond along each axis                                       [Pa]
//   p            exponent: how narrowly stiff bonds gather about the grain
//
// Derivation. Along an axis the modulus must be that axis' own; it must be even in n, and free of φ
// at n = L, where φ has no meaning. Across the grain the simplest such interpolation is that of a
// tensor of second order,
//   M_⊥(φ) = M_T + (M_R − M_T) cos²φ,   cos²φ = n_R² / (n_R² + n_T²),
// and from there to the grain
//   M(n) = M_⊥(φ) + (M_L − M_⊥(φ)) |cos θ|^p.
// With M_R = M_T this is M_T + (M_L − M_T)|cos θ|^p, symmetric about the grain; with three equal
// moduli it is that modulus to the last bit.
#ifndef SOLIDEM_LAWS_ORIENTED_MODULUS_HPP
#define SOLIDEM_LAWS_ORIENTED_MODULUS_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// The axes of a grained material: unit vectors, perpendicular to each other.
template <class Real>
struct GrainAxes {
  Vector3<Real> longitudinal;  ///< L, along the grain
  Vector3<Real> radial;        ///< R
  constexpr Vector3<Real> tangential() const { return cross(longitudinal, radial); }
};

/// A modulus along each axis of the grain, and how it passes from one to the other.
template <class Real>
struct OrientedModulus {
  Real longitudinal;  ///< M_L, Pa
  Real radial;        ///< M_R, Pa
  Real tangential;    ///< M_T, Pa
  Real exponent;      ///< p, above 0
};

/// M(n) for the unit direction n, Pa.
template <class Real>
Real modulus_along(const OrientedModulus<Real>& modulus, const GrainAxes<Real>& axes,
                   const Vector3<Real>& direction) {
  using std::abs;
  using std::pow;
  const Real radial = dot(direction, axes.radial), tangential = dot(direction, axes.tangential());
  const Real across = radial * radial + tangential * tangential;
  const Real tiny{1e-300};  // along the grain: any φ will do
  const Real transverse = modulus.tangential + (modulus.radial - modulus.tangential) *
                                                   (radial * radial / (across + tiny));
  return transverse + (modulus.longitudinal - transverse) *
                          pow(abs(dot(direction, axes.longitudinal)), modulus.exponent);
}

}  // namespace solidem

#endif
