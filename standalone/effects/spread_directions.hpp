// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_SPREAD_DIRECTIONS_HPP
#define SOLIDEM_EFFECTS_SPREAD_DIRECTIONS_HPP

#include <cmath>
#include <vector>

#include "laws/constants.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// So many unit vectors, spread evenly: a spiral of the golden angle (Vogel 1979).
inline std::vector<Vector> spread_directions(int count) {
  std::vector<Vector> spread;
  const double golden_angle = pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z);
    spread.push_back({r * std::cos(k * golden_angle), r * std::sin(k * golden_angle), z});
  }
  return spread;
}

}  // namespace solidem

#endif
