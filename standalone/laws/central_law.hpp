// SPDX-License-Identifier: GPL-2.0-or-later
//
// What every law of central force between two elements has: a name, parameters that say themselves
// what they are, `complaint()` about parameters that do not go together, and two pure functions of
// a separation,
//   force      F = −dΦ/dδ, F > 0 pushes apart                                                 [N]
//   potential  Φ, of any zero                                                                  [J]
// Whoever evaluates a law (a kernel, a pair style, a plot) adds what all laws share: the range
// beyond which there is no force, the continuation at deep overlap, dissipation and crack faces
// (central_interaction.hpp). Stiffness is no function of a law: it is the exact derivative of its
// force, taken with a dual number.
#ifndef SOLIDEM_LAWS_CENTRAL_LAW_HPP
#define SOLIDEM_LAWS_CENTRAL_LAW_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// What a parameter is measured in.
enum class LawQuantity {
  energy,     ///< J
  force,      ///< N
  stiffness,  ///< N/m
  ratio,      ///< a number above 0
  exponent    ///< an integer from 1
};

/// A parameter of a law, as a scene, a pair style or a plot names it. All are required.
template <class Law>
struct LawParameter {
  const char* name;
  double Law::*place;
  LawQuantity quantity;
  const char* meaning;
};

/// Two elements seen from each other.
template <class Real>
struct Separation {
  Real distance;          ///< δ, m
  Real inverse_distance;  ///< 1 / δ
  Real equilibrium;       ///< δ_eq, m

  /// δ_eq / δ
  constexpr Real compression_ratio() const { return equilibrium * inverse_distance; }
};

template <class Real>
constexpr Separation<Real> separation(const Real& distance, const Real& equilibrium) {
  return {distance, Real{1.0} / distance, equilibrium};
}

/// base^exponent of an integer exponent from 0, by squaring.
template <class Real>
constexpr Real power(Real base, int exponent) {
  Real result{1.0};
  for (; exponent > 1; exponent /= 2) {
    if (exponent % 2 == 1) result = result * base;
    base = base * base;
  }
  return exponent == 1 ? result * base : result;
}

}  // namespace solidem

#endif
