// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_SHAPE_HPP
#define SOLIDEM_MODEL_SHAPE_HPP

#include <limits>
#include <utility>
#include <vector>

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

  /// Distance of a point from the surface, negative inside, m. Exact for one part; of several the
  /// usual bound, exact in sign. For `fraction_inside` of a ball around the point, give its radius,
  /// m: round surfaces then move inwards a little, so that flat cuts leave the volume as it is.
  double signed_distance(const Vector& point, double ball_radius = 0) const;

  /// Lower and upper corner of a box that holds the solid, m.
  std::pair<Vector, Vector> bounds() const;
};

/// The share of a ball's volume on the inner side of a plane at a signed distance of its centre
/// (negative inside), in radii of the ball: 1 below −1, 0 above 1.
double fraction_inside(double distance_in_radii);

}  // namespace solidem

#endif
