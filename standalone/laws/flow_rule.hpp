// SPDX-License-Identifier: GPL-2.0-or-later
//
// When and how far a bond flows. Two rules leave the share p of the elastic deformation, in every
// mode alike, so that the stress returns to σ_y along the ray to the origin, which is not normal to
// the yield surface where modes are mixed:
//   radial return   when the strain since the last flow exceeds ε_y(κ):  p ε_e = ε_y(κ'),
//                   κ' = κ + (1 − p) ε_e the plastic strain;
//   scaled offset   (the thesis) when the strain ε since the bond was made exceeds its largest
//                   before, ε_y(κ) + κ: the stress is then that of the same monotonic curve,
//                   p ε = ε_y(κ'), κ' = (1 − p) ε; below it everything stays elastic, so reverse
//                   flow comes late and is a jump of the stress. The law is not bound to take
//                   energy: on paths that turn, a flow may give some back.
// The third, associated, is normal to it: associated_flow.hpp.
//
// Source: Terreros 2013, sections 3.2.1 and 3.2.2.
#ifndef SOLIDEM_LAWS_FLOW_RULE_HPP
#define SOLIDEM_LAWS_FLOW_RULE_HPP

#include <type_traits>

#include "laws/bond_limit.hpp"
#include "laws/yield_law.hpp"

namespace solidem {

/// act(rule) with the rule as a constant.
template <class Act>
constexpr auto by_rule(FlowRule rule, const Act& act) {
  switch (rule) {  // NOLINT(bugprone-branch-clone): what is alike differs in type
    case FlowRule::scaled_offset:
      return act(std::integral_constant<FlowRule, FlowRule::scaled_offset>{});
    case FlowRule::associated:
      return act(std::integral_constant<FlowRule, FlowRule::associated>{});
    case FlowRule::radial_return:
      break;
  }
  return act(std::integral_constant<FlowRule, FlowRule::radial_return>{});
}

/// How far a beam flows.
template <class Real>
struct PlasticFlow {
  Real fraction;        ///< p: what remains of the elastic deformation, 1 where nothing flows
  Real strain;          ///< κ afterwards
  Real elastic_strain;  ///< σ_e / E afterwards
};

/// Radial return: `strain` is ε_e since the last flow, `plastic_strain` κ before.
template <class Law, class Real>
constexpr PlasticFlow<Real> radial_return(const YieldCurve<Law, Real>& yield, const Real& strain,
                                          const Real& plastic_strain) {
  const Real one{1.0};
  const Real limit = yield.limit(plastic_strain);
  const Real after = returned_strain(yield, strain, plastic_strain);
  const auto flows = greater(strain, limit);
  return {select(flows, after / select(flows, strain, one), one),
          select(flows, plastic_strain + (strain - after), plastic_strain),
          select(flows, after, strain)};
}

/// Scaled offset: `strain` is ε since the bond was made, `plastic_strain` κ before.
template <class Law, class Real>
constexpr PlasticFlow<Real> scaled_offset(const YieldCurve<Law, Real>& yield, const Real& strain,
                                          const Real& plastic_strain) {
  const Real one{1.0};
  const Real largest = yield.total_limit(plastic_strain);
  const Real after = returned_strain(yield, strain, Real{0.0});
  const auto flows = greater(strain, largest);
  return {select(flows, after / select(flows, strain, one), one),
          select(flows, strain - after, plastic_strain), after};
}

}  // namespace solidem

#endif
