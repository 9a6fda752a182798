// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/surface_elements.hpp"

#include <algorithm>
#include <cmath>

#include "effects/kernels/kernels.hpp"
#include "effects/spread_directions.hpp"
#include "model/blocks.hpp"
#include "neighbours/neighbourhood.hpp"
#include "specimen/pieces.hpp"

namespace solidem {

namespace {

constexpr int directions = 400;

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

bool is_free(const std::vector<Obstacle>& around, const Vector& centre, std::size_t j,
             std::size_t k) {
  for (std::size_t n = 0; n < around.size(); ++n)
    if (n != j && n != k && blocks(around[n], centre)) return false;
  return true;
}

/// Whether a probe at this distance from the element that touches two of what stands around it
/// finds room: the corners of every gap, however narrow, are such places.
bool is_exposed_in_a_gap(const std::vector<Obstacle>& around, double distance) {
  for (std::size_t j = 0; j < around.size(); ++j)
    for (std::size_t k = j + 1; k < around.size(); ++k) {
      const Vector &a = around[j].from, &b = around[k].from;
      const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), square = distance * distance;
      const double area = aa * bb - ab * ab;
      if (!(area > 1e-12 * aa * bb)) continue;
      const double along_a = 0.5 * (square + aa - around[j].reach * around[j].reach),
                   along_b = 0.5 * (square + bb - around[k].reach * around[k].reach);
      const double of_a = (along_a * bb - along_b * ab) / area,
                   of_b = (along_b * aa - along_a * ab) / area;
      const double height = square - of_a * along_a - of_b * along_b;
      if (height < 0) continue;
      const Vector foot = of_a * a + of_b * b, up = std::sqrt(height / area) * cross(a, b);
      if (is_free(around, foot + up, j, k) || is_free(around, foot - up, j, k)) return true;
    }
  return false;
}

}  // namespace

std::vector<std::int32_t> surface_elements(const Specimen& specimen,
                                           const std::vector<Pair>& bonds) {
  if (specimen.size() == 0) return {};
  const double probe = *std::min_element(specimen.radius.begin(), specimen.radius.end());
  const Neighbourhood near = find_neighbours(specimen.domain, specimen.position, specimen.radius, 1,
                                             2 * probe, {}, kernels().pick_near);
  const std::vector<Vector> spread = spread_directions(directions);
  const std::vector<std::int32_t> piece = lowest_of_piece(specimen.size(), bonds);
  std::vector<char> exposed(specimen.size(), 0);
  constexpr std::size_t least = 1000;  // elements: below, a second thread costs more than it saves
  for_blocks(specimen.size(), least, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::vector<Obstacle> around;
      for (std::size_t k = near.first[i]; k < near.first[i + 1]; ++k) {
        const auto j = static_cast<std::size_t>(near.neighbour[k]);
        if (piece[j] != piece[i]) continue;
        Vector from = specimen.position[j] - specimen.position[i];
        if (!near.image.empty()) from += image_shift(specimen.domain, near.image[k]);
        around.push_back({from, specimen.radius[j] + probe});
      }
      const double distance = specimen.radius[i] + probe;
      exposed[i] =
          is_exposed(around, distance, spread) || is_exposed_in_a_gap(around, distance) ? 1 : 0;
    }
  });
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < exposed.size(); ++i)
    if (exposed[i] != 0) found.push_back(static_cast<std::int32_t>(i));
  return found;
}

}  // namespace solidem
