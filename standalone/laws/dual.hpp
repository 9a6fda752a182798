// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_LAWS_DUAL_HPP
#define SOLIDEM_LAWS_DUAL_HPP

#include <cmath>

namespace solidem {

/// A number and its derivative with respect to one variable. A law taken with it as its scalar
/// gives its exact tangent beside its value.
struct Dual {
  double value = 0, derivative = 0;

  constexpr Dual() = default;
  constexpr Dual(double v, double d = 0) : value(v), derivative(d) {}  // NOLINT: constants convert

  friend constexpr Dual operator+(Dual a, Dual b) {
    return {a.value + b.value, a.derivative + b.derivative};
  }
  friend constexpr Dual operator-(Dual a, Dual b) {
    return {a.value - b.value, a.derivative - b.derivative};
  }
  friend constexpr Dual operator*(Dual a, Dual b) {
    return {a.value * b.value, a.value * b.derivative + a.derivative * b.value};
  }
  friend constexpr Dual operator/(Dual a, Dual b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.derivative - quotient * b.derivative) / b.value};
  }
  friend constexpr Dual operator-(Dual a) { return {-a.value, -a.derivative}; }
  friend Dual sqrt(Dual a) {
    const double root = std::sqrt(a.value);
    // Where a root starts, its derivative is taken as none: laws use roots of sums of squares.
    return {root, root > 0 ? a.derivative / (2 * root) : 0.0};
  }
  friend Dual abs(Dual a) { return a.value < 0 ? -a : a; }
  friend constexpr bool greater(Dual a, Dual b) { return a.value > b.value; }
  friend constexpr Dual select(bool condition, Dual a, Dual b) { return condition ? a : b; }
};

}  // namespace solidem

#endif
