// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_SHAPE_HPP
#define SOLIDEM_MODEL_SHAPE_HPP

#include <limits>
#include <utility>
#include <vector>

#include "model/polyhedron.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// A simple solid around the origin, or a union of several of which some may be cut out.
struct Shape {
  enum class Kind { sphere, cylinder, box };
  struct Part {
    Kind kind = Kind::sphere;
    double radius = 0;                                        ///< of a sphere or cylinder, m
    int axis = 2;                                             ///< of a cylinder
    double length = std::numeric_limits<double>::infinity();  ///< of a cylinder, m
    Vector size{};                                            ///< of a box, m
    Vector offset{};                                          ///< of its centre, m
    bool is_cut_out = false;  ///< taken away from the parts before it
  };
  std::vector<Part> parts;

  /// Lower and upper corner of a box that holds the solid, m.
  std::pair<Vector, Vector> bounds() const;

  /// The least of its parts' radii, lengths and sizes, m.
  double smallest_extent() const;
};

/// Volume of a solid inside of a shape whose origin is at a position, m³. Exact for a shape of one
/// part. Of several, where two round ones meet inside the solid, one of them counts as flat facets
/// that stay within .005 of the solid's size of it.
double volume_inside(const Polyhedron& solid, const Shape& shape, const Vector& position);

}  // namespace solidem

#endif
