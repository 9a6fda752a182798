// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_LAWS_DUAL_HPP
#define SOLIDEM_LAWS_DUAL_HPP

#include <cmath>

#include "laws/algebra.hpp"

namespace solidem {

/// A number and its derivative with respect to one variable. A law taken with it as its scalar
/// gives its exact tangent beside its value.
template <class Real>
struct DualNumber {
  Real value{0.0}, derivative{0.0};

  constexpr DualNumber() = default;
  constexpr DualNumber(Real v, Real d = Real{0.0})  // NOLINT: constants convert
      : value(v), derivative(d) {}

  friend constexpr DualNumber operator+(DualNumber a, DualNumber b) {
    return {a.value + b.value, a.derivative + b.derivative};
  }
  friend constexpr DualNumber operator-(DualNumber a, DualNumber b) {
    return {a.value - b.value, a.derivative - b.derivative};
  }
  friend constexpr DualNumber operator*(DualNumber a, DualNumber b) {
    return {a.value * b.value, a.value * b.derivative + a.derivative * b.value};
  }
  friend constexpr DualNumber operator/(DualNumber a, DualNumber b) {
    const Real quotient = a.value / b.value;
    return {quotient, (a.derivative - quotient * b.derivative) / b.value};
  }
  friend constexpr DualNumber operator-(DualNumber a) { return {-a.value, -a.derivative}; }
  friend DualNumber sqrt(DualNumber a) {
    using std::sqrt;
    const Real root = sqrt(a.value), none{0.0};
    // Where a root starts, its derivative is taken as none: laws use roots of sums of squares.
    return {root, select(greater(root, none), a.derivative / (Real{2.0} * root), none)};
  }
  friend DualNumber exp(DualNumber a) {
    using std::exp;
    const Real power = exp(a.value);
    return {power, power * a.derivative};
  }
  friend DualNumber log(DualNumber a) {
    using std::log;
    return {log(a.value), a.derivative / a.value};
  }
  friend DualNumber abs(DualNumber a) { return select(greater(Real{0.0}, a.value), -a, a); }
  friend constexpr auto greater(DualNumber a, DualNumber b) { return greater(a.value, b.value); }
  template <class Condition>
  friend constexpr DualNumber select(Condition condition, DualNumber a, DualNumber b) {
    return {select(condition, a.value, b.value), select(condition, a.derivative, b.derivative)};
  }
};

using Dual = DualNumber<double>;

}  // namespace solidem

#endif
