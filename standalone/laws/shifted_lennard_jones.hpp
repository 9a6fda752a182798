// SPDX-License-Identifier: GPL-2.0-or-later
//
// Lennard and Jones' potential whose largest attraction is where and what one wants.
//
// Source: Terreros 2013, annex D: δ is replaced by Bδ − C with
//   B = δ_eq (q − 1)/(δ_max − δ_eq),   C = δ_eq (B − 1),   q = (13/7)^(1/6),
// so that the equilibrium stays at δ_eq and the largest attraction moves to δ_max:
//   F = D [δ_eq¹²/(Bδ − C)¹³ − δ_eq⁶/(Bδ − C)⁷].
// With s = δ_eq/(Bδ − C) and F(δ_max) = −.22416 D/δ_eq = −γ this is
//   F = γ (s¹³ − s⁷)/(q⁻⁷ − q⁻¹³),   Φ = γ δ_eq (s¹²/12 − s⁶/6)/(B (q⁻⁷ − q⁻¹³)).
// The depth of the well is ε/B with ε = γ δ_eq/2.690. Where δ_max > 1.1087 δ_eq the force at δ = 0
// is finite. Below, Bδ − C would be zero at a distance above 0, where the force has its pole.
#ifndef SOLIDEM_LAWS_SHIFTED_LENNARD_JONES_HPP
#define SOLIDEM_LAWS_SHIFTED_LENNARD_JONES_HPP

#include <array>

#include "laws/central_law.hpp"

namespace solidem {

struct ShiftedLennardJones {
  double attraction = 0;       ///< γ, the largest, N
  double peak_separation = 0;  ///< δ_max/δ_eq, above 1

  static constexpr const char* name = "shifted-lennard-jones";
  static constexpr std::array<LawParameter<ShiftedLennardJones>, 2> parameters() {
    return {
        {{"attraction", &ShiftedLennardJones::attraction, LawQuantity::force, "largest attraction"},
         {"peak_separation", &ShiftedLennardJones::peak_separation, LawQuantity::ratio,
          "distance of the largest attraction over that of equilibrium, above 1"}}};
  }

  constexpr const char* complaint() const {
    return peak_separation > 1 ? nullptr : "peak_separation must be above 1";
  }

  template <class Real>
  constexpr Real force(const Separation<Real>& at) const {
    const Real s = compression_ratio(at), sixth = power(s, 6);
    return Real{attraction / peak} * s * sixth * (sixth - Real{1.0});
  }

  template <class Real>
  constexpr Real potential(const Separation<Real>& at) const {
    const Real sixth = power(compression_ratio(at), 6);
    return Real{attraction / (12 * peak * slope())} * at.equilibrium * sixth * (sixth - Real{2.0});
  }

 private:
  static constexpr double q = 1.1086834179687215;      // (13/7)^(1/6)
  static constexpr double peak = 0.22415840810039330;  // q⁻⁷ − q⁻¹³
  /// B
  constexpr double slope() const { return (q - 1) / (peak_separation - 1); }
  /// s
  template <class Real>
  constexpr Real compression_ratio(const Separation<Real>& at) const {
    return at.equilibrium / (at.equilibrium + Real{slope()} * (at.distance - at.equilibrium));
  }
};

}  // namespace solidem

#endif
