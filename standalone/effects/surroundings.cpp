// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/surroundings.hpp"

#include <cmath>

#include "effects/kernels/kernels.hpp"
#include "effects/spread_directions.hpp"
#include "laws/constants.hpp"
#include "model/blocks.hpp"

namespace solidem {

namespace {

constexpr int looked_along = 400;

/// A blown-up element, seen from another.
struct Blown {
  Vector from;
  double radius;

  bool holds(const Vector& point) const {
    const Vector away = point - from;
    return dot(away, away) < radius * radius;
  }
};

/// How much more a flat piece of surface counts than one that bends: of a factor that both would
/// give, a piece whose vector areas sum to .9 of their lengths tells a twentieth.
constexpr double selectivity = 30;

}  // namespace

Surroundings::Surroundings(const Specimen& specimen)
    : specimen_(specimen),
      spread_(spread_directions(looked_along)),
      near_(find_neighbours(specimen.domain, specimen.position, specimen.radius, blow_up, 0, {},
                            kernels().pick_near)) {}

Openness Surroundings::openness(std::size_t element, const std::vector<char>& apart) const {
  std::vector<Blown> around;
  for_each_near(element, [&](std::size_t other, std::size_t entry) {
    if (!apart.empty() && apart[entry] != 0) return;
    Vector from = specimen_.position[other] - specimen_.position[element];
    if (!near_.image.empty()) from += image_shift(specimen_.domain, near_.image[entry]);
    around.push_back({from, blow_up * specimen_.radius[other]});
  });
  Openness open;
  std::size_t last = 0;  // who hid one direction often hides the next
  for (const Vector& direction : spread_) {
    const Vector point = blow_up * specimen_.radius[element] * direction;
    if (last < around.size() && around[last].holds(point)) continue;
    for (last = 0; last < around.size() && !around[last].holds(point);) ++last;
    if (last < around.size()) continue;
    open.share += 1.0 / looked_along;
    open.mean += (1.0 / looked_along) * direction;
  }
  return open;
}

std::vector<Openness> Surroundings::openness() const {
  std::vector<Openness> open(specimen_.size());
  constexpr std::size_t least = 1000;  // elements: below, a second thread costs more than it saves
  for_blocks(open.size(), least, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) open[i] = openness(i, {});
  });
  return open;
}

Vector Surroundings::vector_area(std::size_t element, const Openness& open) const {
  const double radius = blow_up * specimen_.radius[element];
  return 4 * pi * radius * radius * open.mean;
}

Vector Surroundings::around(std::size_t element, const std::vector<Vector>& area,
                            const std::vector<char>& apart) const {
  Vector sum = area[element];
  for_each_near(element, [&](std::size_t other, std::size_t entry) {
    const bool counts = apart.empty() || apart[entry] == 0;
    if (counts && dot(area[other], area[element]) > 0) sum += area[other];
  });
  return sum;
}

std::vector<double> Surroundings::areas(const std::vector<Openness>& open) const {
  std::vector<Vector> vector_areas;
  for (std::size_t i = 0; i < open.size(); ++i) vector_areas.push_back(vector_area(i, open[i]));
  std::vector<double> area(open.size());
  double along = 0, all = 0;  // vector area along the normal, and w, of what is flat, m²
  for (std::size_t i = 0; i < open.size(); ++i) {
    area[i] = 4 * pi * specimen_.radius[i] * specimen_.radius[i] * open[i].share;
    const Vector sum = around(i, vector_areas, {});
    const double length = norm(sum);
    if (!(length > 0)) continue;
    double lengths = norm(vector_areas[i]);
    for_each_near(i, [&](std::size_t other, std::size_t) {
      if (dot(vector_areas[other], vector_areas[i]) > 0) lengths += norm(vector_areas[other]);
    });
    const double weight = std::pow(length / lengths, selectivity);
    along += weight * dot(sum, vector_areas[i]) / length;
    all += weight * area[i];
  }
  if (all > 0)
    for (double& one : area) one *= along / all;
  return area;
}

}  // namespace solidem
