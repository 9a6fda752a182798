// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_TIME_FUNCTION_HPP
#define SOLIDEM_MODEL_TIME_FUNCTION_HPP

#include <vector>

namespace solidem {

/// A quantity given as a function of time: a constant, a table (linear between its points, held
/// outside them), a sine, or the sum of these.
struct TimeFunction {
  std::vector<double> time;   ///< of the table, s, strictly increasing; one point is a constant
  std::vector<double> value;  ///< of the table
  double amplitude = 0;       ///< of the sine
  double frequency = 0;       ///< of the sine, Hz
  double phase = 0;           ///< of the sine, rad

  static TimeFunction constant(double value) { return {{0.0}, {value}}; }

  /// The value at a time.
  double operator()(double t) const;

  /// The time derivative; at a corner of the table that of the segment after it.
  double rate(double t) const;

  /// The largest value at any time.
  double largest() const;

  /// The largest size of the time derivative at any time.
  double largest_rate() const;

  /// Whether it is the same at all times.
  bool is_constant() const { return time.size() == 1 && amplitude == 0; }

  /// The exact integral from time 0 to t (t ≥ 0): turns a velocity into a displacement.
  double integral(double t) const;
};

}  // namespace solidem

#endif
