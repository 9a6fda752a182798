// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_GAUGE_CHECK_HPP
#define SOLIDEM_EFFECTS_GAUGE_CHECK_HPP

#include "model/gauge.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// Refuses a gauge section whose mean stress would not be that of the body: one that reaches beyond
/// it.
void check_gauge(const Gauge& gauge, const Domain& domain);

/// How much lies in the section of a line that goes from a place as far along the axis, m, with all
/// its images where the body is periodic along it. A force times this, summed over lines and
/// divided by the section's length, is the mean force across its planes.
double length_inside(const Gauge& gauge, const Domain& domain, double from, double along);

}  // namespace solidem

#endif
