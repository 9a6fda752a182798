// SPDX-License-Identifier: GPL-2.0-or-later
//
// Two (m,n) potentials one after the other: stiff near the equilibrium, softer beyond a threshold.
//
// Source: Gado 2017, equation 8: F_I while |δ − δ_eq| ≤ ξ_s δ_eq, beyond it
//   F = F_II(δ − δ_s + δ_eq) + F_I(δ_s),   δ_s = (1 ± ξ_s) δ_eq on the side of δ.
// The law is continuous and has no memory. With δ_c, which is δ kept between both δ_s,
//   F = F_I(δ_c) + F_II(δ − δ_c + δ_eq)
// everywhere, as F_II(δ_eq) = 0; and
//   Φ = Φ_I(δ_c) − F_I(δ_c) (δ − δ_c) + Φ_II(δ − δ_c + δ_eq) − Φ_II(δ_eq).
#ifndef SOLIDEM_LAWS_THRESHOLD_HPP
#define SOLIDEM_LAWS_THRESHOLD_HPP

#include <array>

#include "laws/mie.hpp"

namespace solidem {

struct Threshold {
  double energy = 0;                      ///< ε_1, J
  double repulsive_exponent = 0;          ///< m_1
  double attractive_exponent = 0;         ///< n_1
  double beyond_energy = 0;               ///< ε_2, J
  double beyond_repulsive_exponent = 0;   ///< m_2
  double beyond_attractive_exponent = 0;  ///< n_2
  double threshold_strain = 0;            ///< ξ_s

  static constexpr const char* name = "threshold";
  static constexpr std::array<LawParameter<Threshold>, 7> parameters() {
    return {{{"energy", &Threshold::energy, LawQuantity::energy, "depth of the first well"},
             {"repulsive_exponent", &Threshold::repulsive_exponent, LawQuantity::exponent, "m"},
             {"attractive_exponent", &Threshold::attractive_exponent, LawQuantity::exponent,
              "n, below m"},
             {"beyond_energy", &Threshold::beyond_energy, LawQuantity::energy,
              "depth of the second well"},
             {"beyond_repulsive_exponent", &Threshold::beyond_repulsive_exponent,
              LawQuantity::exponent, "m of the second"},
             {"beyond_attractive_exponent", &Threshold::beyond_attractive_exponent,
              LawQuantity::exponent, "n of the second, below its m"},
             {"threshold_strain", &Threshold::threshold_strain, LawQuantity::ratio,
              "change of distance over that of equilibrium at which the second begins, below 1"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const {
    if (!(threshold_strain < 1)) return "threshold_strain must be below 1";
    if (!(attractive_exponent < repulsive_exponent))
      return "attractive_exponent must be below repulsive_exponent";
    if (!(beyond_attractive_exponent < beyond_repulsive_exponent))
      return "beyond_attractive_exponent must be below beyond_repulsive_exponent";
    return nullptr;
  }

  template <class Real>
  constexpr Real force(const Separation<Real>& at) const {
    const Real kept = kept_distance(at);
    return first().force(separation(kept, at.equilibrium)) + second().force(beyond(at, kept));
  }

  template <class Real>
  constexpr Real potential(const Separation<Real>& at) const {
    const Real kept = kept_distance(at);
    const Separation<Real> inside = separation(kept, at.equilibrium);
    return first().potential(inside) - first().force(inside) * (at.distance - kept) +
           second().potential(beyond(at, kept)) + Real{beyond_energy};
  }

 private:
  constexpr Mie first() const { return {energy, repulsive_exponent, attractive_exponent}; }
  constexpr Mie second() const {
    return {beyond_energy, beyond_repulsive_exponent, beyond_attractive_exponent};
  }
  /// δ_c
  template <class Real>
  constexpr Real kept_distance(const Separation<Real>& at) const {
    const Real near = Real{1 - threshold_strain} * at.equilibrium;
    const Real far = Real{1 + threshold_strain} * at.equilibrium;
    return select(greater(near, at.distance), near,
                  select(greater(at.distance, far), far, at.distance));
  }
  template <class Real>
  static constexpr Separation<Real> beyond(const Separation<Real>& at, const Real& kept) {
    return separation(at.distance - kept + at.equilibrium, at.equilibrium);
  }
};

}  // namespace solidem

#endif
