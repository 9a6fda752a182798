// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/surface_elements.hpp"

#include <algorithm>
#include <cmath>

#include "effects/kernels/kernels.hpp"
#include "model/blocks.hpp"
#include "neighbours/neighbourhood.hpp"

namespace solidem {

namespace {

constexpr int directions = 400;

/// Directions that are spread evenly: a spiral of the golden angle (Vogel 1979).
std::vector<Vector> spread_directions() {
  std::vector<Vector> spread;
  const double golden_angle = 3.14159265358979323846 * (3 - std::sqrt(5.0));
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2 * k + 1.0) / directions, r = std::sqrt(1 - z * z);
    spread.push_back({r * std::cos(k * golden_angle), r * std::sin(k * golden_angle), z});
  }
  return spread;
}

/// What stands around an element.
struct Obstacle {
  Vector from;   ///< the element, m
  double reach;  ///< within which of it the centre of a probe overlaps it, m
};

bool blocks(const Obstacle& obstacle, const Vector& centre) {
  const Vector away = centre - obstacle.from;
  return dot(away, away) < obstacle.reach * obstacle.reach;
}

/// Whether a probe finds room at this distance from the element in some direction.
bool is_exposed(const std::vector<Obstacle>& around, double distance,
                const std::vector<Vector>& spread) {
  // Who blocked one direction often blocks the next.
  std::size_t last = 0;
  return std::any_of(spread.begin(), spread.end(), [&](const Vector& direction) {
    const Vector centre = distance * direction;
    if (last < around.size() && blocks(around[last], centre)) return false;
    for (last = 0; last < around.size(); ++last)
      if (blocks(around[last], centre)) return false;
    return true;
  });
}

}  // namespace

std::vector<std::int32_t> surface_elements(const Specimen& specimen) {
  if (specimen.size() == 0) return {};
  const double probe = *std::min_element(specimen.radius.begin(), specimen.radius.end());
  const Neighbourhood near = find_neighbours(specimen.domain, specimen.position, specimen.radius, 1,
                                             2 * probe, {}, kernels().pick_near);
  const std::vector<Vector> spread = spread_directions();
  std::vector<char> exposed(specimen.size(), 0);
  constexpr std::size_t least = 1000;  // elements: below, a second thread costs more than it saves
  for_blocks(specimen.size(), least, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::vector<Obstacle> around;
      for (std::size_t k = near.first[i]; k < near.first[i + 1]; ++k) {
        const auto j = static_cast<std::size_t>(near.neighbour[k]);
        Vector from = specimen.position[j] - specimen.position[i];
        if (!near.image.empty()) from += image_shift(specimen.domain, near.image[k]);
        around.push_back({from, specimen.radius[j] + probe});
      }
      exposed[i] = is_exposed(around, specimen.radius[i] + probe, spread) ? 1 : 0;
    }
  });
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < exposed.size(); ++i)
    if (exposed[i] != 0) found.push_back(static_cast<std::int32_t>(i));
  return found;
}

}  // namespace solidem
