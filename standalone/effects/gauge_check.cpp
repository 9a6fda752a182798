// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/gauge_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/selections.hpp"
#include "model/error.hpp"

namespace solidem {

void check_gauge(const Gauge& gauge, const Domain& domain) {
  const std::string axis(1, "xyz"[gauge.axis]);
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

double length_inside(const Gauge& gauge, const Domain& domain, double from, double along) {
  const double low = std::min(from, from + along), high = std::max(from, from + along);
  const auto inside = [&](double shift) {
    return std::max(0.0, std::min(high + shift, gauge.upper) - std::max(low + shift, gauge.lower));
  };
  if (!domain.periodic[static_cast<std::size_t>(gauge.axis)]) return inside(0);
  const double period = component(domain.upper - domain.lower, gauge.axis);
  double length = 0;
  const auto first = static_cast<int>(std::floor((gauge.lower - high) / period));
  const auto last = static_cast<int>(std::ceil((gauge.upper - low) / period));
  for (int image = first; image <= last; ++image) length += inside(image * period);
  return length;
}

}  // namespace solidem
