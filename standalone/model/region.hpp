// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_REGION_HPP
#define SOLIDEM_MODEL_REGION_HPP

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// A part of a specimen, by where the centres stand at rest.
struct Region {
  enum class Kind {
    all,   ///< every element
    face,  ///< centres within `depth` of a face of the domain
    box,   ///< lower ≤ centre ≤ upper, infinite bounds are open
    set    ///< a set named in the specimen file
  };
  Kind kind = Kind::all;
  int axis = 0;            ///< of a face: 0, 1, 2
  bool high_side = false;  ///< of a face: the upper one
  double depth = 0;        ///< of a face, m; unused when `layers` > 0
  double layers = 0;       ///< of a face: depth in mean diameters
  Vector lower{-infinity, -infinity, -infinity},
      upper{infinity, infinity, infinity};  ///< of a box, m
  std::string set;                          ///< name of a set of the specimen
  std::string body{};                       ///< of this body alone, and of its faces; empty: of all

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// Elements of a region, increasing. Throws InputError when the named set does not exist; an empty
/// region is the caller's to judge.
std::vector<std::int32_t> select(const Region& region, const Specimen& specimen);

/// The element whose centre at rest is nearest to a point.
std::int32_t nearest_element(const Specimen& specimen, const Vector& point);

}  // namespace solidem

#endif
