// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/ordering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "specimen/bonds.hpp"

namespace solidem {

namespace {

constexpr int bits = 21;  // three of them fit 64 bits
constexpr std::size_t window = 128;

}  // namespace

// Skilling's transform (AIP Conference Proceedings 707, 381, 2004): Gray code undone from the
// highest bit down, each level's reflections and axis swaps applied to the bits below.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::array<std::uint32_t, 3> a{x, y, z};
  const std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& c : a) {
      if (c & bit) {
        a[0] ^= below;
      } else {
        const std::uint32_t swapped = (a[0] ^ c) & below;
        a[0] ^= swapped;
        c ^= swapped;
      }
    }
  }
  a[1] ^= a[0];
  a[2] ^= a[1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1)
    if (a[2] & bit) flip ^= bit - 1;
  for (std::uint32_t& c : a) c ^= flip;

  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t c : a) index = (index << 1) | ((c >> bit) & 1u);
  return index;
}

std::vector<std::int32_t> hilbert_order(const std::vector<Vector>& position) {
  std::vector<std::int32_t> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  if (position.empty()) return order;
  Vector lower = position[0], upper = position[0];
  for (const Vector& p : position) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
  }
  const Vector extent = upper - lower;
  const double side = std::max({extent.x, extent.y, extent.z});
  const double scale = side > 0 ? ((1u << bits) - 1) / side : 0.0;
  std::vector<std::uint64_t> place(position.size());
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Vector p = scale * (position[i] - lower);
    place[i] = hilbert_index(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y),
                             static_cast<std::uint32_t>(p.z));
  }
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return place[a] != place[b] ? place[a] < place[b] : a < b;
  });
  return order;
}

void sort_elements(Specimen& specimen) {
  std::vector<std::int32_t> order = hilbert_order(specimen.position);
  const std::vector<std::int32_t> degree = count_bonds(specimen);
  for (std::size_t first = 0; first < order.size(); first += window) {
    const std::size_t last = std::min(first + window, order.size());
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first),
                     order.begin() + static_cast<std::ptrdiff_t>(last),
                     [&](std::int32_t a, std::int32_t b) { return degree[a] > degree[b]; });
  }

  std::vector<std::int32_t> new_number(order.size());
  std::vector<Vector> position(order.size());
  std::vector<double> radius(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    new_number[order[k]] = static_cast<std::int32_t>(k);
    position[k] = specimen.position[order[k]];
    radius[k] = specimen.radius[order[k]];
  }
  specimen.position = std::move(position);
  specimen.radius = std::move(radius);
  for (Pair& pair : specimen.bonds) {
    const std::int32_t a = new_number[pair.i], b = new_number[pair.j];
    pair = {std::min(a, b), std::max(a, b)};
  }
  std::sort(specimen.bonds.begin(), specimen.bonds.end());
  const auto renumber = [&](std::vector<std::int32_t>& elements) {
    for (std::int32_t& element : elements) element = new_number[element];
    std::sort(elements.begin(), elements.end());
  };
  for (auto& [name, elements] : specimen.sets) renumber(elements);
  for (Body& body : specimen.bodies) renumber(body.elements);
}

}  // namespace solidem
