// SPDX-License-Identifier: GPL-2.0-or-later
//
// The strain up to which a bond needs no look at its laws of yield and rupture.
#ifndef SOLIDEM_LAWS_BOND_LIMIT_HPP
#define SOLIDEM_LAWS_BOND_LIMIT_HPP

#include <type_traits>
#include <variant>

#include "laws/limit_scale.hpp"
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
constexpr Real strain_before_flow(const YieldCurve<Law, Real>& yield, FlowRule rule,
                                  const Real& plastic_strain) {
  const Real limit = yield.lower_bound(plastic_strain), none{0.0};
  if (rule != FlowRule::scaled_offset) return limit;
  // What the strain since the bond was made tells cannot be told from that since the last flow.
  return select(greater(plastic_strain, none), none, limit);
}

/// The equivalent strain up to which a bond of the plastic strain κ surely does not break.
template <class Real>
constexpr Real strain_before_rupture(const RuptureLaw* rupture, const Real& plastic_strain,
                                     const LimitScale<Real>& scale = {}) {
  if (rupture == nullptr) return Real{unlimited};
  const auto bound = [&](const Real& at) {
    return std::visit([&](const auto& law) { return law.lower_bound(at); }, *rupture);
  };
  return scale.is_one ? bound(plastic_strain)
                      : scale.rupture * bound(plastic_strain / scale.rupture);
}

/// Up to which it does neither.
inline double limit_strain(const YieldLaw* yield, FlowRule rule, const RuptureLaw* rupture,
                           double plastic_strain, const LimitScale<double>& scale = {},
                           double temperature = 0) {
  const double before_rupture = strain_before_rupture(rupture, plastic_strain, scale);
  if (yield == nullptr) return before_rupture;
  return std::visit(
      [&](const auto& law) {
        return with_scale(law, scale, [&](const auto& own) {
          const YieldCurve<std::decay_t<decltype(own)>, double> curve{own, {temperature}};
          return smaller_of(strain_before_flow(curve, rule, plastic_strain), before_rupture);
        });
      },
      *yield);
}

/// Whether a bond breaks that is strained so.
template <class Real>
constexpr auto breaks(const RuptureLaw& rupture, const BondStrain<Real>& strain,
                      const LimitScale<Real>& scale = {}) {
  const auto seen_to_break = [&](const BondStrain<Real>& seen) {
    return std::visit([&](const auto& law) { return law.breaks(seen); }, rupture);
  };
  if (scale.is_one) return seen_to_break(strain);
  const Real& u = scale.rupture;
  return seen_to_break({strain.equivalent / u, strain.plastic / u, strain.normal / u,
                        strain.bending / u, strain.twist / u});
}

}  // namespace solidem

#endif
