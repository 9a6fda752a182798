// SPDX-License-Identifier: GPL-2.0-or-later
//
// The (m,n) potential of Mie.
//
// Source: Gado 2017, equations 1 and 2 (one expression on both sides of the equilibrium):
//   Φ = ε [n/(m−n) (δ_eq/δ)^m − m/(m−n) (δ_eq/δ)^n]
//   F = mnε/((m−n) δ) [(δ_eq/δ)^m − (δ_eq/δ)^n]
// with ε the depth of the well and m > n. (12,6) is the potential of Lennard and Jones. At the
// equilibrium the stiffness is mnε/δ_eq².
#ifndef SOLIDEM_LAWS_MIE_HPP
#define SOLIDEM_LAWS_MIE_HPP

#include <array>

#include "laws/central_law.hpp"

namespace solidem {

struct Mie {
  double energy = 0;               ///< ε, J
  double repulsive_exponent = 0;   ///< m, an integer
  double attractive_exponent = 0;  ///< n, an integer below m

  static constexpr const char* name = "mie";
  static constexpr std::array<LawParameter<Mie>, 3> parameters() {
    return {
        {{"energy", &Mie::energy, LawQuantity::energy, "depth of the well"},
         {"repulsive_exponent", &Mie::repulsive_exponent, LawQuantity::exponent, "m"},
         {"attractive_exponent", &Mie::attractive_exponent, LawQuantity::exponent, "n, below m"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const {
    return attractive_exponent < repulsive_exponent
               ? nullptr
               : "attractive_exponent must be below repulsive_exponent";
  }

  template <class Real>
  constexpr Real force(const Separation<Real>& at) const {
    const int m = static_cast<int>(repulsive_exponent), n = static_cast<int>(attractive_exponent);
    const Real s = at.compression_ratio(), attractive = power(s, n);
    return Real{m * n * energy / (m - n)} * at.inverse_distance * attractive *
           (power(s, m - n) - Real{1.0});
  }

  template <class Real>
  constexpr Real potential(const Separation<Real>& at) const {
    const int m = static_cast<int>(repulsive_exponent), n = static_cast<int>(attractive_exponent);
    const Real s = at.compression_ratio();
    return Real{energy / (m - n)} * power(s, n) * (Real(n) * power(s, m - n) - Real(m));
  }
};

}  // namespace solidem

#endif
