// SPDX-License-Identifier: GPL-2.0-or-later
//
// A property over temperature: linear between the points of a table, held outside of it. One point
// is a constant.
//
// Source: the trapezoidal rule, which is exact for the integral of straight pieces.
#ifndef SOLIDEM_LAWS_INTERPOLATION_HPP
#define SOLIDEM_LAWS_INTERPOLATION_HPP

namespace solidem {

/// The points of a table; nothing is owned.
struct TablePoints {
  int count;
  const double* at;        ///< strictly increasing
  const double* value;     ///< at these places
  const double* integral;  ///< of the value from the first place to these
};

/// The integrals of a table, for `count` points.
inline void integrate_table(int count, const double* at, const double* value, double* integral) {
  integral[0] = 0;
  for (int k = 1; k < count; ++k)
    integral[k] = integral[k - 1] + 0.5 * (value[k - 1] + value[k]) * (at[k] - at[k - 1]);
}

namespace detail {

/// The piece k, from at[k] to at[k + 1], in which x is.
inline int piece_of(const TablePoints& table, double x) {
  int low = 0, high = table.count - 1;
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    (x < table.at[middle] ? high : low) = middle;
  }
  return low;
}

}  // namespace detail

/// The value at x.
inline double interpolate(const TablePoints& table, double x) {
  const int last = table.count - 1;
  if (last == 0 || x <= table.at[0]) return table.value[0];
  if (x >= table.at[last]) return table.value[last];
  const int k = detail::piece_of(table, x);
  const double fraction = (x - table.at[k]) / (table.at[k + 1] - table.at[k]);
  return table.value[k] + fraction * (table.value[k + 1] - table.value[k]);
}

/// The integral from the first place of the table to x.
inline double integrate(const TablePoints& table, double x) {
  const int last = table.count - 1;
  if (last == 0 || x <= table.at[0]) return table.value[0] * (x - table.at[0]);
  if (x >= table.at[last]) return table.integral[last] + table.value[last] * (x - table.at[last]);
  const int k = detail::piece_of(table, x);
  const double beyond = x - table.at[k];
  const double slope = (table.value[k + 1] - table.value[k]) / (table.at[k + 1] - table.at[k]);
  return table.integral[k] + beyond * (table.value[k] + 0.5 * slope * beyond);
}

}  // namespace solidem

#endif
