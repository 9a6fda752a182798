// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rupture of a beam bond.
//
// Source: Terreros 2013, section 3.2.2: a bond breaks when its equivalent stress exceeds σ_rupt,
// taken there as that of an elastic tension of 100 %. With plasticity the stress stays on the yield
// surface, so the strain says it: σ_e / E + κ, the elastic and the plastic part.
#ifndef SOLIDEM_LAWS_BEAM_RUPTURE_HPP
#define SOLIDEM_LAWS_BEAM_RUPTURE_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// When a bond breaks. What is not asked for is infinite.
template <class Real>
struct BeamRupture {
  Real elastic_strain;  ///< σ_rupt / E, bound of σ_e / E
  Real strain;          ///< bound of σ_e / E + κ
};

/// Whether a bond breaks at an equivalent strain σ_e / E and a plastic strain κ.
template <class Real>
constexpr auto breaks(const BeamRupture<Real>& rupture, const Real& strain,
                      const Real& plastic_strain) {
  return either(greater(strain, rupture.elastic_strain),
                greater(strain + plastic_strain, rupture.strain));
}

}  // namespace solidem

#endif
