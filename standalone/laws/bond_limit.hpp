// SPDX-License-Identifier: GPL-2.0-or-later
//
// The strain up to which a bond needs no look at its laws of yield and rupture.
#ifndef SOLIDEM_LAWS_BOND_LIMIT_HPP
#define SOLIDEM_LAWS_BOND_LIMIT_HPP

#include <variant>

#include "laws/rupture_laws.hpp"
#include "laws/yield_laws.hpp"

namespace solidem {

/// When and how far bonds flow: beam_plasticity.hpp.
enum class FlowRule { radial_return, scaled_offset, associated };

/// What scenes and bond styles call them.
inline constexpr NamedChoice<FlowRule> flow_rules[] = {{"radial-return", FlowRule::radial_return},
                                                       {"scaled-offset", FlowRule::scaled_offset},
                                                       {"associated", FlowRule::associated}};

/// The equivalent strain since the last flow up to which a bond of the plastic strain κ surely does
/// not flow.
template <class Law, class Real>
constexpr Real strain_before_flow(const Law& law, FlowRule rule, const Real& plastic_strain) {
  const Real limit = law.lower_bound(plastic_strain), none{0.0};
  if (rule != FlowRule::scaled_offset) return limit;
  // What the strain since the bond was made tells cannot be told from that since the last flow.
  return select(greater(plastic_strain, none), none, limit);
}

/// The equivalent strain up to which a bond of the plastic strain κ surely does not break.
template <class Real>
constexpr Real strain_before_rupture(const RuptureLaw* rupture, const Real& plastic_strain) {
  if (rupture == nullptr) return Real{unlimited};
  return std::visit([&](const auto& law) { return law.lower_bound(plastic_strain); }, *rupture);
}

/// Up to which it does neither.
inline double limit_strain(const YieldLaw* yield, FlowRule rule, const RuptureLaw* rupture,
                           double plastic_strain) {
  const double before_rupture = strain_before_rupture(rupture, plastic_strain);
  if (yield == nullptr) return before_rupture;
  return std::visit(
      [&](const auto& law) {
        return smaller_of(strain_before_flow(law, rule, plastic_strain), before_rupture);
      },
      *yield);
}

/// Whether a bond breaks that is strained so.
template <class Real>
constexpr auto breaks(const RuptureLaw& rupture, const BondStrain<Real>& strain) {
  return std::visit([&](const auto& law) { return law.breaks(strain); }, rupture);
}

}  // namespace solidem

#endif
