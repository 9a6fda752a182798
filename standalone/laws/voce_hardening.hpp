// SPDX-License-Identifier: GPL-2.0-or-later
//
// Hardening of a bond that saturates.
//
// Source: Voce, J. Inst. Metals 74, 537 (1948), and Metallurgia 51, 219 (1955):
//   ε_y(κ) = ε_0 + s (1 − exp(−κ / κ_s)),
// ε_0 = σ_y / E, s what the yield strain gains in all, κ_s the plastic strain in which 1 − 1/e of
// it is gained.
#ifndef SOLIDEM_LAWS_VOCE_HARDENING_HPP
#define SOLIDEM_LAWS_VOCE_HARDENING_HPP

#include <array>
#include <cmath>

#include "laws/bond_law.hpp"
#include "laws/yield_law.hpp"

namespace solidem {

struct VoceHardening {
  double yield_strain = 0;       ///< ε_0
  double saturation_strain = 0;  ///< s
  double plastic_scale = 0;      ///< κ_s

  static constexpr const char* name = "voce";
  static constexpr std::array<BondLawParameter<VoceHardening>, 3> parameters() {
    return {{{"yield_strain", "yield_stress", &VoceHardening::yield_strain, LawBound::above_zero,
              true, "at which a bond first flows"},
             {"saturation_strain", "saturation_stress", &VoceHardening::saturation_strain,
              LawBound::from_zero, true, "what the yield strain gains in all"},
             {"plastic_scale", nullptr, &VoceHardening::plastic_scale, LawBound::above_zero, true,
              "plastic strain in which 1 - 1/e of that is gained"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const { return nullptr; }

  template <class Real>
  Real limit(const Real& plastic_strain, const YieldState<Real>& = {}) const {
    using std::exp;
    const Real left = exp(-plastic_strain / Real{plastic_scale});
    return Real{yield_strain} + Real{saturation_strain} * (Real{1.0} - left);
  }

  template <class Real>
  Real lower_bound(const Real& plastic_strain) const {
    return limit(plastic_strain);
  }
};

}  // namespace solidem

#endif
