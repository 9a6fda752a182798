// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/cut_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <voro++/voro++.hh>

#include "model/blocks.hpp"

namespace solidem {

namespace {

constexpr double farthest_corner = 2;  // in radii
constexpr int most_cuts = 500;         // of a cell; each takes a corner away
constexpr double elements_per_block = 5;

// In mean radii: voro++ takes points within 1e-11 of a plane to lie on it.
std::unique_ptr<voro::container_poly> container_of(const Specimen& specimen, double unit) {
  const Domain& domain = specimen.domain;
  const double far = 10 * *std::max_element(specimen.radius.begin(), specimen.radius.end()) / unit;
  Vector low{}, high = (1.0 / unit) * (domain.upper - domain.lower);
  for (int axis = 0; axis < 3; ++axis)
    if (!domain.periodic[static_cast<std::size_t>(axis)]) {
      component(low, axis) -= far;
      component(high, axis) += far;
    }
  const Vector size = high - low;
  const double per_length = std::cbrt(static_cast<double>(specimen.size()) /
                                      (elements_per_block * size.x * size.y * size.z));
  std::array<int, 3> blocks{};
  for (int axis = 0; axis < 3; ++axis)
    blocks[static_cast<std::size_t>(axis)] =
        static_cast<int>(component(size, axis) * per_length) + 1;
  auto container = std::make_unique<voro::container_poly>(
      low.x, high.x, low.y, high.y, low.z, high.z, blocks[0], blocks[1], blocks[2],
      domain.periodic[0], domain.periodic[1], domain.periodic[2], 8);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector p = (1.0 / unit) * (specimen.position[i] - domain.lower);
    container->put(static_cast<int>(i), p.x, p.y, p.z, specimen.radius[i] / unit);
  }
  return container;
}

// Cuts off what lies beyond the sphere, the farthest corner first; false when nothing is left.
bool cut_at_sphere(voro::voronoicell& cell, double radius, std::vector<double>& corners) {
  for (int cut = 0; cut < most_cuts; ++cut) {
    cell.vertices(corners);
    Vector farthest{};
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3) {
      const Vector corner{corners[k], corners[k + 1], corners[k + 2]};
      if (dot(corner, corner) > dot(farthest, farthest)) farthest = corner;
    }
    const double distance = norm(farthest);
    if (distance <= farthest_corner * radius) return true;
    // voro++ cuts halfway to a point.
    const Vector mirror = (2.0 * radius / distance) * farthest;
    if (!cell.plane(mirror.x, mirror.y, mirror.z)) return false;
  }
  return true;
}

/// What each thread has of its own, for voro++ keeps notes while it works.
struct Cutter {
  Cutter(const Specimen& specimen, double unit) : container(container_of(specimen, unit)) {}

  std::unique_ptr<voro::container_poly> container;
  voro::voronoicell cell;
  std::vector<double> corners;
};

}  // namespace

double cut_cell_volume(const Specimen& specimen) {
  const double unit = mean_radius(specimen);
  std::vector<double> volume(specimen.size(), 0.0);
  const auto blocks = static_cast<std::size_t>(container_of(specimen, unit)->nxyz);
  for_each_part_with(
      blocks, true, [&] { return Cutter(specimen, unit); },
      [&](Cutter& own, std::size_t block) {
        for (int k = 0; k < own.container->co[block]; ++k) {
          const auto element = static_cast<std::size_t>(own.container->id[block][k]);
          if (own.container->compute_cell(own.cell, static_cast<int>(block), k) &&
              cut_at_sphere(own.cell, specimen.radius[element] / unit, own.corners))
            volume[element] = own.cell.volume();
        }
      });
  return std::accumulate(volume.begin(), volume.end(), 0.0) * unit * unit * unit;
}

}  // namespace solidem
