// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_WALLS_HPP
#define SOLIDEM_SPECIMEN_WALLS_HPP

#include <string>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// A wall of a body: a plane, a cylinder about the body's axis, or a sphere.
struct Wall {
  std::string name;
  double area = 0;       ///< exact, m²
  Vector point{};        ///< of the plane, or of the cylinder's axis, m; the sphere's centre
  Vector direction{};    ///< plane: unit normal, outward; cylinder: unit vector along its axis
  double radius = 0;     ///< of the cylinder or sphere, m; 0 for a plane
  bool concave = false;  ///< the body lies outside of the cylinder

  /// From a point to the wall along its normal, m; negative beyond the wall.
  double distance(const Vector& from) const;

  /// The length, m, that heat on its way from a point to the wall is held up by, so that
  /// conductivity × area / length is the conductance for the wall's own area: `distance` for a
  /// plane, R |ln(ρ/R)| for a cylinder (ρ from the axis, at least R/2), R (R/ρ − 1) for a sphere,
  /// exact for radial flow.
  double conduction_length(const Vector& from) const;
};

/// All walls, in this order: x_low, x_high, y_low, y_high, z_low, z_high where the body is flat and
/// not periodic (every shape's bounding box but the directions across a round body's axis); then
/// `side` of a cylinder, `surface` of a sphere, `inner` and `outer` of an annulus or wedge, and
/// `first` and `last` of a wedge, the planes at angle 0 and at its angle. A body known by its
/// spheres alone, a mesh and one with cuts have none.
std::vector<Wall> walls_of(const Domain& domain);

/// Those of the shape before something was cut out of it.
std::vector<Wall> walls_of_shape(Domain domain);

/// The names alone.
std::vector<std::string> wall_names(const Domain& domain);

/// Area of all walls, m².
double wall_area(const Domain& domain);

}  // namespace solidem

#endif
