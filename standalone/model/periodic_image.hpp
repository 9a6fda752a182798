// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_PERIODIC_IMAGE_HPP
#define SOLIDEM_MODEL_PERIODIC_IMAGE_HPP

#include <cmath>

#include "model/specimen.hpp"

namespace solidem {

/// The shortest of a difference of two places and those of their images in periodic directions, m.
inline Vector to_nearest_image(const Domain& domain, Vector difference) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const double period = component(domain.upper, axis) - component(domain.lower, axis);
    component(difference, axis) -= period * std::nearbyint(component(difference, axis) / period);
  }
  return difference;
}

}  // namespace solidem

#endif
