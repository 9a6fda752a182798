// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_GAUGE_CHECK_HPP
#define SOLIDEM_EFFECTS_GAUGE_CHECK_HPP

#include "model/gauge.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// Refuses a gauge section whose mean stress would not be that of the body: one that reaches beyond
/// it, or along an axis on which the body is periodic.
void check_gauge(const Gauge& gauge, const Domain& domain);

}  // namespace solidem

#endif
