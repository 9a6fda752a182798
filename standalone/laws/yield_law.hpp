// SPDX-License-Identifier: GPL-2.0-or-later
//
// What every yield law of bonds has: a name, parameters that say themselves what they are
// (bond_law.hpp), `complaint()` about parameters that do not go together (null: none), and pure
// functions of the plastic strain κ,
//   limit(κ, state)   ε_y(κ) = σ_y / E, the equivalent strain at which a bond flows
//   lower_bound(κ)    what ε_y is not below at κ in any state
// A law may offer besides, where it knows better than the ways that serve all laws,
//   slope(κ, state)               dε_y / dκ; else taken with a dual number
//   returned(ε, κ)                the strain ε' that a return from ε leaves, ε' = ε_y(κ + ε − ε');
//                                 else found by Newton's method
//   total_limit(κ)                ε_y(κ) + κ
// A law that looks at the state says so (`depends_on_state`), and whether it does with the
// parameters it has, in follows_temperature() and follows_rate(). Its limit is least at rest.
#ifndef SOLIDEM_LAWS_YIELD_LAW_HPP
#define SOLIDEM_LAWS_YIELD_LAW_HPP

#include <type_traits>

#include "laws/dual.hpp"
#include "laws/limit_scale.hpp"

namespace solidem {

/// What a yield law may depend on besides the plastic strain.
template <class Real>
struct YieldState {
  Real temperature{0.0};  ///< K
  Real rate{0.0};         ///< of the plastic strain, 1/s
};

namespace detail {

template <class Law>
inline constexpr const Law* any_law = nullptr;  // never looked at

template <class Law, class Real, class = void>
struct OffersSlope : std::false_type {};
template <class Law, class Real>
struct OffersSlope<Law, Real,
                   std::void_t<decltype(any_law<Law>->slope(Real{0.0}, YieldState<Real>{}))>>
    : std::true_type {};

template <class Law, class Real, class = void>
struct OffersReturn : std::false_type {};
template <class Law, class Real>
struct OffersReturn<Law, Real, std::void_t<decltype(any_law<Law>->returned(Real{0.0}, Real{0.0}))>>
    : std::true_type {};

template <class Law, class = void>
struct DependsOnState : std::false_type {};
template <class Law>
struct DependsOnState<Law, std::void_t<decltype(Law::depends_on_state)>> : std::true_type {};

template <class Law, class Real, class = void>
struct OffersTotalLimit : std::false_type {};
template <class Law, class Real>
struct OffersTotalLimit<Law, Real, std::void_t<decltype(any_law<Law>->total_limit(Real{0.0}))>>
    : std::true_type {};

}  // namespace detail

/// Whether a law looks at temperature or rate.
template <class Law>
inline constexpr bool depends_on_state = detail::DependsOnState<Law>::value;

/// The law of a bond of some scale: a law itself, without the closed forms of the other.
template <class Law, class Real>
struct ScaledLaw {
  const Law& law;
  LimitScale<Real> scale;

  template <class Number>
  constexpr Number limit(const Number& plastic_strain, const YieldState<Number>& state) const {
    return Number{scale.yield} * law.limit(plastic_strain / Number{scale.plastic}, state);
  }

  constexpr Real lower_bound(const Real& plastic_strain) const {
    return scale.yield * law.lower_bound(plastic_strain / scale.plastic);
  }
};

namespace detail {

template <class Law, class Real>
struct DependsOnState<ScaledLaw<Law, Real>> : DependsOnState<Law> {};

}  // namespace detail

/// act(law) with the law of a bond of some scale.
template <class Law, class Real, class Act>
constexpr auto with_scale(const Law& law, const LimitScale<Real>& scale, const Act& act) {
  return scale.is_one ? act(law) : act(ScaledLaw<Law, Real>{law, scale});
}

/// A yield law in a state: the yield strain as a function of the plastic strain alone. The rate of
/// a bond is what is left of the rate that it had, and what it flows now.
template <class Law, class Real>
struct YieldCurve {
  const Law& law;
  YieldState<Real> state{};
  Real flow_start{0.0};     ///< κ at which the rate is that of the state
  Real rate_per_flow{0.0};  ///< what a flow adds to it, 1/s

  /// κ̇, of a bond that has flowed on to κ.
  template <class Number>
  constexpr Number rate(const Number& plastic_strain) const {
    return Number{state.rate} + Number{rate_per_flow} * (plastic_strain - Number{flow_start});
  }

  /// ε_y(κ), for the scalar of the curve or a dual number of it.
  template <class Number>
  constexpr Number limit(const Number& plastic_strain) const {
    YieldState<Number> at{Number{state.temperature}, Number{state.rate}};
    if constexpr (depends_on_state<Law>) at.rate = rate(plastic_strain);
    return law.limit(plastic_strain, at);
  }

  /// What ε_y is not below at κ while the temperature stays, at any rate.
  constexpr Real lower_bound(const Real& plastic_strain) const {
    if constexpr (depends_on_state<Law>)
      return law.limit(plastic_strain, YieldState<Real>{state.temperature, Real{0.0}});
    else
      return law.lower_bound(plastic_strain);
  }

  /// dε_y / dκ
  constexpr Real slope(const Real& plastic_strain) const {
    if constexpr (detail::OffersSlope<Law, Real>::value)
      return law.slope(plastic_strain, state);
    else
      return limit(DualNumber<Real>{plastic_strain, Real{1.0}}).derivative;
  }

  /// ε_y(κ) + κ: the strain of a bond that has flowed in one direction only, where it flows again.
  constexpr Real total_limit(const Real& plastic_strain) const {
    if constexpr (detail::OffersTotalLimit<Law, Real>::value)
      return law.total_limit(plastic_strain);
    else
      return limit(plastic_strain) + plastic_strain;
  }
};

/// The strain ε' that a return from ε > ε_y(κ) leaves, ε' = ε_y(κ + ε − ε'): Newton's method for
/// the flow ε − ε', which halves the bracket [0, ε] where a step would leave it. Where nothing
/// flows, ε itself.
template <class Law, class Real>
constexpr Real newton_return(const YieldCurve<Law, Real>& curve, const Real& strain,
                             const Real& plastic_strain) {
  using std::abs;
  constexpr int most_steps = 80;  // halving alone needs 54
  const Real none{0.0}, one{1.0};
  const Real tolerance = Real{2e-16} * strain;
  Real low{0.0}, high = strain, flow{0.0};
  for (int n = 0; n < most_steps; ++n) {
    const Real at = plastic_strain + flow;
    const Real excess = (strain - flow) - curve.limit(at);
    const auto flows_further = greater(excess, none);
    low = select(flows_further, flow, low);
    high = select(flows_further, high, flow);
    const Real slope = one + curve.slope(at);
    const Real step = flow + excess / slope;
    const auto leaves =
        either(either(greater(low, step), greater(step, high)), greater(none, slope));
    const Real next = select(leaves, Real{0.5} * (low + high), step);
    const bool moves = any(greater(abs(next - flow), tolerance));
    flow = next;
    if (!moves) break;
  }
  return strain - flow;
}

/// The same in the closed form of the law, if it has one.
template <class Law, class Real>
constexpr Real returned_strain(const YieldCurve<Law, Real>& curve, const Real& strain,
                               const Real& plastic_strain) {
  if constexpr (detail::OffersReturn<Law, Real>::value)
    return curve.law.returned(strain, plastic_strain);
  else
    return newton_return(curve, strain, plastic_strain);
}

}  // namespace solidem

#endif
