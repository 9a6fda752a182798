// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rupture of a bond at an equivalent stress or at an equivalent strain.
//
// Source: Terreros 2013, section 3.2.2: a bond breaks when its equivalent stress exceeds σ_rupt,
// taken there as that of an elastic tension of 100 %. With plasticity the stress stays on the yield
// surface, so the strain says it: σ_e / E + κ, the elastic and the plastic part.
#ifndef SOLIDEM_LAWS_STRAIN_LIMIT_HPP
#define SOLIDEM_LAWS_STRAIN_LIMIT_HPP

#include <array>

#include "laws/rupture_law.hpp"

namespace solidem {

struct StrainLimit {
  double elastic_strain = unlimited;  ///< σ_rupt / E, bound of σ_e / E
  double strain = unlimited;          ///< bound of σ_e / E + κ

  static constexpr const char* name = "strain-limit";
  static constexpr std::array<BondLawParameter<StrainLimit>, 2> parameters() {
    return {{{"elastic_strain", "stress", &StrainLimit::elastic_strain, LawBound::above_zero, false,
              "equivalent stress over E at which a bond breaks"},
             {"strain", nullptr, &StrainLimit::strain, LawBound::above_zero, false,
              "the same and the plastic strain together"}}};
  }

  /// What is wrong with the parameters together; null: nothing.
  constexpr const char* complaint() const {
    return elastic_strain < unlimited || strain < unlimited ? nullptr
                                                            : "nothing says when a bond breaks";
  }

  template <class Real>
  constexpr auto breaks(const BondStrain<Real>& at) const {
    return either(greater(at.equivalent, Real{elastic_strain}),
                  greater(at.equivalent + at.plastic, Real{strain}));
  }

  template <class Real>
  constexpr Real lower_bound(const Real& plastic_strain) const {
    const Real left = Real{strain} - plastic_strain, none{0.0};
    return smaller_of(Real{elastic_strain}, select(greater(left, none), left, none));
  }
};

}  // namespace solidem

#endif
