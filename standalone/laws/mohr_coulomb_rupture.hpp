// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rupture of a bond in tension or in shear, each at a strength of its own.
//
// Source: parallel bonds of Potyondy & Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329 (2004),
// equations 15 to 17, with the shear strength after Mohr and Coulomb that later versions give them:
//   a bond breaks when  σ_n + σ_b > σ_t   or   |τ| > c − μ σ_n,
// σ_n the mean normal stress, above 0 in tension, σ_b and τ those of bending and of twist at the
// edge of the section, here at mid-length, like all limits of a beam. All are divided by E.
//
// Of all bonds with an equivalent strain ε_e = sqrt((|σ_n| + σ_b)² + 3 τ²) / E, tension breaks none
// below ε_e = σ_t / E, and |τ| + μ σ_n is at most ε_e sqrt(1/3 + μ²).
#ifndef SOLIDEM_LAWS_MOHR_COULOMB_RUPTURE_HPP
#define SOLIDEM_LAWS_MOHR_COULOMB_RUPTURE_HPP

#include <array>
#include <cmath>

#include "laws/rupture_law.hpp"

namespace solidem {

struct MohrCoulombRupture {
  double tensile_strain = 0;        ///< σ_t / E
  double cohesion_strain = 0;       ///< c / E
  double friction_coefficient = 0;  ///< μ, tangent of the friction angle

  static constexpr const char* name = "mohr-coulomb";
  static constexpr std::array<BondLawParameter<MohrCoulombRupture>, 3> parameters() {
    return {{{"tensile_strain", "tensile_strength", &MohrCoulombRupture::tensile_strain,
              LawBound::above_zero, true, "tension over E at which a bond breaks"},
             {"cohesion_strain", "cohesion", &MohrCoulombRupture::cohesion_strain,
              LawBound::above_zero, true, "shear over E at which a bond breaks without pressure"},
             {"friction_coefficient", nullptr, &MohrCoulombRupture::friction_coefficient,
              LawBound::from_zero, false, "growth of that shear with pressure"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const { return nullptr; }

  template <class Real>
  constexpr auto breaks(const BondStrain<Real>& at) const {
    using std::abs;
    return either(
        greater(at.normal + at.bending, Real{tensile_strain}),
        greater(abs(at.twist), Real{cohesion_strain} - Real{friction_coefficient} * at.normal));
  }

  template <class Real>
  constexpr Real lower_bound(const Real&) const {
    using std::sqrt;
    const Real friction{friction_coefficient};
    return smaller_of(Real{tensile_strain},
                      Real{cohesion_strain} / sqrt(Real{1.0 / 3.0} + friction * friction));
  }
};

}  // namespace solidem

#endif
