// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_GAUGE_HPP
#define SOLIDEM_MODEL_GAUGE_HPP

namespace solidem {

/// A gauge length: the section of a specimen whose stress and strain are measured.
struct Gauge {
  int axis = 0;
  double lower = 0, upper = 0;  ///< along the axis, m
};

}  // namespace solidem

#endif
