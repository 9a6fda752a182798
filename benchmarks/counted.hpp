// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_BENCHMARKS_COUNTED_HPP
#define SOLIDEM_BENCHMARKS_COUNTED_HPP

#include <cmath>

namespace solidem {

/// Floating-point operations that were done.
struct Operations {
  long simple = 0;  ///< sums, differences, products
  long divisions = 0;
  long roots = 0;
};

/// A number that counts what is done with it: a law taken with it as its scalar tells how much
/// arithmetic it needs, whatever a compiler makes of it.
struct Counted {
  double value = 0;

  constexpr Counted() = default;
  explicit constexpr Counted(double v) : value(v) {}

  static Operations& operations() {
    static Operations all;
    return all;
  }

  friend Counted operator+(Counted a, Counted b) { return simple(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return simple(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return simple(a.value * b.value); }
  friend Counted operator-(Counted a) { return Counted(-a.value); }  // a change of sign is free
  friend Counted operator/(Counted a, Counted b) {
    ++operations().divisions;
    return Counted(a.value / b.value);
  }
  friend Counted sqrt(Counted a) {
    ++operations().roots;
    return Counted(std::sqrt(a.value));
  }
  // What compares and chooses is a mask, and free here as well.
  friend constexpr bool greater(Counted a, Counted b) { return a.value > b.value; }
  friend constexpr Counted select(bool condition, Counted a, Counted b) {
    return condition ? a : b;
  }
  friend Counted abs(Counted a) { return Counted(std::abs(a.value)); }
  Counted& operator+=(Counted b) { return *this = *this + b; }

 private:
  static Counted simple(double v) {
    ++operations().simple;
    return Counted(v);
  }
};

}  // namespace solidem

#endif
