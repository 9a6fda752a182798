// SPDX-License-Identifier: GPL-2.0-or-later
//
// Convex solids with flat faces, and how much of them lies inside of balls and cylinders: closed
// formulas, sums over faces and edges that need no case for what touches or misses what.
#ifndef SOLIDEM_MODEL_POLYHEDRON_HPP
#define SOLIDEM_MODEL_POLYHEDRON_HPP

#include <utility>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// A convex solid: its faces, each with its corners counter-clockwise as seen from outside, m. No
/// faces: nothing.
struct Polyhedron {
  std::vector<std::vector<Vector>> faces;

  bool empty() const { return faces.empty(); }
};

/// A box between two corners.
Polyhedron box_between(const Vector& lower, const Vector& upper);

/// A polygon drawn out to both sides of its plane by half a thickness, m. `corners` in order about
/// the polygon's normal.
Polyhedron slab_of(const std::vector<Vector>& corners, double thickness);

/// A polyhedron in place of a ball of a volume, m³: 120 facets, the same for all.
Polyhedron ball_of_facets(const Vector& centre, double volume);

/// Directions that are spread evenly over the sphere.
std::vector<Vector> even_directions(int count);

/// What lies where normal · x ≤ offset; `normal` has unit length. Corners on the plane but for
/// round-off lie on it.
Polyhedron clipped(const Polyhedron& solid, const Vector& normal, double offset);

/// The same, with corners within a margin, m, of the plane counted as on it. `source` is told of
/// each face that is left which of the solid's faces it is of, −1: of the cut.
Polyhedron clipped(const Polyhedron& solid, const Vector& normal, double offset, double margin,
                   std::vector<int>& source);

/// Lower and upper corner of the box around it, m. It must not be empty.
std::pair<Vector, Vector> bounds(const Polyhedron& solid);

/// m³
double volume(const Polyhedron& solid);

/// Volume inside of a ball, m³. Exact: the cones from the ball's centre over the faces are cut
/// where they leave the ball (over each edge an elementary integral).
double volume_in_ball(const Polyhedron& solid, const Vector& centre, double radius);

/// Volume inside of an endless cylinder along an axis (0, 1, 2), m³. Exact: what lies below each
/// face, over triangles and sectors of the circle.
double volume_in_cylinder(const Polyhedron& solid, const Vector& centre, int axis, double radius);

/// Integral of exp(−2ρ²/w²) over the part of a flat polygon where ρ < 2w, m²; ρ is the distance
/// from the point of its plane nearest to `centre`. Over the whole plane it is πw²/2 (1 − e⁻⁸).
/// What two polygons have in common cancels, so that sums over a plane are as exact as its outline.
double gaussian_over(const std::vector<Vector>& corners, const Vector& centre, double w);

}  // namespace solidem

#endif
