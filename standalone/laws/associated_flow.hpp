// SPDX-License-Identifier: GPL-2.0-or-later
//
// Associated flow of a beam bond: normal to the yield surface of the resultants Q = (N, M, T) at
// mid-length, in their elongation, bending and twist q (beam_plasticity.hpp):
//   Δq_p = Δλ ∂σ_e/∂Q, back onto the surface at once.
// With ε_N = |e|/l, ε_M = r |a_j − a_i|/l, γ = G/E · r φ/l, s = ε_N + ε_M and
// x = Δλ/(S l ε_e') this leaves
//   s' = max(s/(1 + 5x), ε_N/(1 + x), ε_M/(1 + 4x)),   γ' = γ/(1 + 6x G/E),
//   ε_N' = max(0, ε_N − x s'),   ε_M' = s' − ε_N',   κ' = κ + x ε_e',
// x from ε_e' = ε_y(κ'): κ is the strain that does the plastic work at σ_e.
#ifndef SOLIDEM_LAWS_ASSOCIATED_FLOW_HPP
#define SOLIDEM_LAWS_ASSOCIATED_FLOW_HPP

#include <cmath>
#include <utility>

#include "laws/yield_law.hpp"

namespace solidem {

/// Strains of the resultants at mid-length, each at the edge of the section.
template <class Real>
struct ResultantStrain {
  Real normal;   ///< ε_N, of |N|
  Real bending;  ///< ε_M, of |M|
  Real twist;    ///< γ, of T
};

/// How far a beam flows normal to its yield surface: what remains of each resultant.
template <class Real>
struct AssociatedFlow {
  Real normal, bending, twist;  ///< shares, 1 where nothing flows
  Real strain;                  ///< κ afterwards
  Real elastic_strain;          ///< σ_e / E afterwards
};

namespace detail {

template <class Number>
constexpr Number larger_of(const Number& a, const Number& b) {
  return select(greater(a, b), a, b);
}

/// σ_e / E after a flow by x, and s'.
template <class Number>
constexpr std::pair<Number, Number> strain_after(const ResultantStrain<Number>& strain,
                                                 const Number& shear_ratio, const Number& x) {
  using std::sqrt;
  const Number one{1.0};
  const Number edge =
      larger_of((strain.normal + strain.bending) / (one + Number{5.0} * x),
                larger_of(strain.normal / (one + x), strain.bending / (one + Number{4.0} * x)));
  const Number twist = strain.twist / (one + Number{6.0} * shear_ratio * x);
  return {sqrt(edge * edge + Number{3.0} * twist * twist), edge};
}

}  // namespace detail

/// Associated flow of a beam strained to ε_e. What is left beyond the surface falls with x and is
/// convex for laws that harden ever less, so that Newton's method comes to its end from one side;
/// where the first step goes too far, which it may for laws that begin infinitely steep, the
/// bracket is halved.
template <class Law, class Real>
constexpr AssociatedFlow<Real> associated_flow(const YieldCurve<Law, Real>& yield,
                                               const ResultantStrain<Real>& strain,
                                               const Real& shear_ratio, const Real& equivalent,
                                               const Real& plastic_strain) {
  using std::abs;
  using Varied = DualNumber<Real>;
  constexpr int most_steps = 60;
  const Real none{0.0}, one{1.0};
  const ResultantStrain<Varied> fixed{Varied{strain.normal}, Varied{strain.bending},
                                      Varied{strain.twist}};
  const auto flows = greater(equivalent, yield.limit(plastic_strain));
  Real x{0.0}, low{0.0};
  for (int n = 0; n < most_steps; ++n) {
    const Varied at{x, one};
    const Varied left = detail::strain_after(fixed, Varied{shear_ratio}, at).first;
    const Varied excess = left - yield.limit(Varied{plastic_strain} + at * left);
    const auto falls = both(flows, greater(none, excess.derivative));
    const auto beyond = greater(none, excess.value);  // what is sought
    low = select(beyond, low, x);
    const Real newton =
        select(falls, -(excess.value / select(falls, excess.derivative, one)), none);
    const auto leaves = both(beyond, greater(low, x + newton));
    const Real step = select(leaves, Real{0.5} * (low - x), newton);
    x = detail::larger_of(x + step, none);
    if (!any(greater(abs(step), Real{4e-16} * (one + x)))) break;
  }
  const auto [left, edge] = detail::strain_after(strain, shear_ratio, x);
  const Real normal = detail::larger_of(strain.normal - x * edge, none);
  const auto share = [&](const Real& after, const Real& before) {
    const auto is_any = both(flows, greater(before, none));
    return select(is_any, after / select(is_any, before, one), one);
  };
  return {share(normal, strain.normal), share(edge - normal, strain.bending),
          one / (one + Real{6.0} * shear_ratio * x),
          select(flows, plastic_strain + x * left, plastic_strain),
          select(flows, left, equivalent)};
}

}  // namespace solidem

#endif
