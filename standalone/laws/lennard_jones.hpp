// SPDX-License-Identifier: GPL-2.0-or-later
//
// The potential of Lennard and Jones.
//
// Source: Terreros 2013, section 3.1.1 (the sign of the printed force is put right):
//   Φ = ε [(δ_eq/δ)¹² − 2 (δ_eq/δ)⁶],   F = 12 ε/δ [(δ_eq/δ)¹² − (δ_eq/δ)⁶]
// with ε the depth of the well. The largest attraction is 2.690 ε/δ_eq, at 1.1087 δ_eq.
#ifndef SOLIDEM_LAWS_LENNARD_JONES_HPP
#define SOLIDEM_LAWS_LENNARD_JONES_HPP

#include <array>

#include "laws/central_law.hpp"

namespace solidem {

struct LennardJones {
  double energy = 0;  ///< ε, J

  static constexpr const char* name = "lennard-jones";
  static constexpr std::array<LawParameter<LennardJones>, 1> parameters() {
    return {{{"energy", &LennardJones::energy, LawQuantity::energy, "depth of the well"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const { return nullptr; }

  template <class Real>
  constexpr Real force(const Separation<Real>& at) const {
    const Real sixth = power(at.compression_ratio(), 6);
    return Real{12 * energy} * at.inverse_distance * sixth * (sixth - Real{1.0});
  }

  template <class Real>
  constexpr Real potential(const Separation<Real>& at) const {
    const Real sixth = power(at.compression_ratio(), 6);
    return Real{energy} * sixth * (sixth - Real{2.0});
  }
};

}  // namespace solidem

#endif
