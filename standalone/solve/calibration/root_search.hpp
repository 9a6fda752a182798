// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_CALIBRATION_ROOT_SEARCH_HPP
#define SOLIDEM_SOLVE_CALIBRATION_ROOT_SEARCH_HPP

#include <functional>
#include <vector>

namespace solidem {

/// Where a root is sought: lower < upper.
struct RootRange {
  double lower, upper;
};

/// A place that was tried, and the function there.
struct RootTrial {
  double at, value;
};

/// How a search went. Not found: every trial of a scan over the whole range has the same sign.
struct RootSearch {
  bool found = false;
  RootTrial best{};               ///< of all trials the one nearest to zero
  std::vector<RootTrial> trials;  ///< in the order of trying; no place twice
};

/// Seeks the root of a continuous function that costs much to evaluate: secants from `start`, the
/// first with the given `slope`, kept inside a bracket as soon as there is one (Illinois method,
/// Dowell and Jarratt, BIT 11, 168 (1971)). Where secants lead out of the range, the ends are
/// tried, then a scan of the inside, so that two roots of one sign change each are not missed.
/// Ends when |value| ≤ `tolerance`. Throws InputError when the range is empty or the start outside.
RootSearch find_root(const std::function<double(double)>& function, RootRange range, double start,
                     double slope, double tolerance);

}  // namespace solidem

#endif
