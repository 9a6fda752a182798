// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/gauge_check.hpp"

#include <string>

#include "effects/selections.hpp"
#include "model/error.hpp"

namespace solidem {

void check_gauge(const Gauge& gauge, const Domain& domain) {
  const std::string axis(1, "xyz"[gauge.axis]);
  if (domain.periodic[gauge.axis])
    throw InputError("[gauge] axis = \"" + axis + "\": the body is periodic along " + axis +
                     ", so that forces pass from one end to the other; expected an axis along "
                     "which it ends");
  if (domain.cuts > 0 || domain.is_sphere() || domain.shape == "mesh" || domain.shape == "bodies")
    throw InputError(
        "[gauge]: a gauge divides forces by the section of the body, which has not one "
        "section (" +
        (domain.cuts > 0 ? std::string("something was cut out of it") : domain.shape) +
        "); expected no gauge: grips tell forces, sensors displacements");
  const double low = component(domain.lower, gauge.axis),
               high = component(domain.upper, gauge.axis);
  const double margin = 1e-9 * (high - low);
  if (gauge.lower < low - margin || gauge.upper > high + margin)
    throw InputError("[gauge] lower = " + text(gauge.lower) + " m, upper = " + text(gauge.upper) +
                     " m: reaches beyond the body, whose mean stress it would dilute; expected " +
                     text(low) + " m or more and " + text(high) + " m or less along " + axis);
}

}  // namespace solidem
