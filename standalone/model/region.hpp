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

/// Elements that have neighbours, of which each has so many, or all if none has any: those whose
/// motion or temperature tells that of the body.
std::vector<std::int32_t> elements_of_the_body(const std::vector<std::int32_t>& neighbours);

/// Of some elements the one whose centre at rest, or an image of it, is nearest to a point.
std::int32_t nearest_element(const Specimen& specimen, const std::vector<std::int32_t>& elements,
                             const Vector& point);

}  // namespace solidem

#endif
