// SPDX-License-Identifier: GPL-2.0-or-later
//
// Neighbours of every element, seen from both sides, found with linked cells: the lists of Verlet,
// which hold a little more than the range so that they last for many steps.
#ifndef SOLIDEM_NEIGHBOURS_NEIGHBOURHOOD_HPP
#define SOLIDEM_NEIGHBOURS_NEIGHBOURHOOD_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// Which periodic image of a neighbour is meant: whole periods along x, y, z, each of at most
/// `most_periods` either way.
class Image {
 public:
  Image() = default;
  Image(int x, int y, int z) : code_(((x + 512) << 20) | ((y + 512) << 10) | (z + 512)) {}
  static constexpr int most_periods = 511;
  int periods(int axis) const { return ((code_ >> (10 * (2 - axis))) & 1023) - 512; }
  /// Images go in this order.
  std::uint32_t code() const { return static_cast<std::uint32_t>(code_); }
  static Image of_code(std::uint32_t code) {
    Image image;
    image.code_ = static_cast<std::int32_t>(code);
    return image;
  }
  friend bool operator==(Image a, Image b) { return a.code_ == b.code_; }
  friend bool operator<(Image a, Image b) { return a.code_ < b.code_; }

 private:
  std::int32_t code_ = (512 << 20) | (512 << 10) | 512;
};

/// What is added to the centre of a neighbour to reach its image, m.
Vector image_shift(const Domain& domain, Image image);

/// Lists of neighbours: those of element i stand from first[i] to first[i + 1], in the order of
/// their numbers, then of their images.
struct Neighbourhood {
  std::vector<std::uint32_t> first;
  std::vector<std::int32_t> neighbour;
  std::vector<Image> image;  ///< empty where nothing is periodic
};

/// Positions to choose from, m, and how far each reaches. Room beyond `count` up to a multiple of 8
/// is there, with positions that are near nothing.
struct NearPositions {
  const double *x, *y, *z, *reach;
  std::size_t count;
};

/// Writes the numbers of the positions within the sum of both reaches of x, y, z, in ascending
/// order; returns how many. `near` has room for `count` and 8 more.
using PickNear = std::size_t (*)(const NearPositions& positions, double x, double y, double z,
                                 double reach, std::uint32_t* near);

/// The plain way.
std::size_t pick_near_positions(const NearPositions& positions, double x, double y, double z,
                                double reach, std::uint32_t* near);

/// All j, and images of them, with |x_j + shift − x_i| ≤ factor (R_i + R_j) + margin, j ≠ i; the
/// same on any number of threads. Several images of a neighbour count where a period is short; an
/// element is no neighbour of its own images, whose forces on it cancel. Elements marked as absent
/// neither have nor are neighbours. `absent` is empty or has one entry per element. `pick`: a
/// faster way than the plain one.
Neighbourhood find_neighbours(const Domain& domain, const std::vector<Vector>& position,
                              const std::vector<double>& radius, double factor, double margin,
                              const std::vector<char>& absent = {},
                              PickNear pick = pick_near_positions);

}  // namespace solidem

#endif
