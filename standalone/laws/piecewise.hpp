// SPDX-License-Identifier: GPL-2.0-or-later
//
// A spring round the equilibrium that attracts no stronger than a plateau.
//
// Source: Terreros 2013, section 3.1.3 and figure 3.3:
//   F = K (δ_eq − δ), but no less than −γ,
// up to the range, where it ends. Its stiffness is never above K, however deep the overlap.
//   Φ = ½ K e² + γ (δ − δ_eq − e),   e the smaller of δ − δ_eq and γ/K.
#ifndef SOLIDEM_LAWS_PIECEWISE_HPP
#define SOLIDEM_LAWS_PIECEWISE_HPP

#include <array>

#include "laws/central_law.hpp"

namespace solidem {

struct Piecewise {
  double stiffness = 0;   ///< K, N/m
  double attraction = 0;  ///< γ, N

  static constexpr const char* name = "piecewise";
  static constexpr std::array<LawParameter<Piecewise>, 2> parameters() {
    return {{{"stiffness", &Piecewise::stiffness, LawQuantity::stiffness,
              "slope round the equilibrium"},
             {"attraction", &Piecewise::attraction, LawQuantity::force, "that of the plateau"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const { return nullptr; }

  template <class Real>
  constexpr Real force(const Separation<Real>& at) const {
    return -(Real{stiffness} * elastic_part(at));
  }

  template <class Real>
  constexpr Real potential(const Separation<Real>& at) const {
    const Real elastic = elastic_part(at);
    return Real{0.5 * stiffness} * elastic * elastic +
           Real{attraction} * (at.distance - at.equilibrium - elastic);
  }

 private:
  /// e
  template <class Real>
  constexpr Real elastic_part(const Separation<Real>& at) const {
    const Real stretch = at.distance - at.equilibrium, most{attraction / stiffness};
    return select(greater(stretch, most), most, stretch);
  }
};

}  // namespace solidem

#endif
