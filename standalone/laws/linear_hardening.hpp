// SPDX-License-Identifier: GPL-2.0-or-later
//
// Linear isotropic hardening of a bond.
//
// Source: Terreros 2013, section 3.2.2, with H = 0 there:
//   ε_y(κ) = ε_0 + h κ,   ε_0 = σ_y / E,   h = H / E.
#ifndef SOLIDEM_LAWS_LINEAR_HARDENING_HPP
#define SOLIDEM_LAWS_LINEAR_HARDENING_HPP

#include <array>

#include "laws/bond_law.hpp"
#include "laws/yield_law.hpp"

namespace solidem {

struct LinearHardening {
  double yield_strain = 0;     ///< ε_0
  double hardening_ratio = 0;  ///< h

  static constexpr const char* name = "linear";
  static constexpr std::array<BondLawParameter<LinearHardening>, 2> parameters() {
    return {{{"yield_strain", "yield_stress", &LinearHardening::yield_strain, LawBound::above_zero,
              true, "at which a bond first flows"},
             {"hardening_ratio", "hardening_modulus", &LinearHardening::hardening_ratio,
              LawBound::from_zero, false, "growth of the yield strain with the plastic strain"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const { return nullptr; }

  template <class Real>
  constexpr Real limit(const Real& plastic_strain, const YieldState<Real>& = {}) const {
    return Real{yield_strain} + Real{hardening_ratio} * plastic_strain;
  }

  template <class Real>
  constexpr Real lower_bound(const Real& plastic_strain) const {
    return limit(plastic_strain);
  }

  template <class Real>
  constexpr Real slope(const Real&, const YieldState<Real>&) const {
    return Real{hardening_ratio};
  }

  template <class Real>
  constexpr Real returned(const Real& strain, const Real& plastic_strain) const {
    return Real{1 / (1 + hardening_ratio)} *
           (limit(plastic_strain) + Real{hardening_ratio} * strain);
  }

  template <class Real>
  constexpr Real total_limit(const Real& plastic_strain) const {
    return Real{yield_strain} + (Real{1.0} + Real{hardening_ratio}) * plastic_strain;
  }
};

}  // namespace solidem

#endif
