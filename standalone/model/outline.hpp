// SPDX-License-Identifier: GPL-2.0-or-later
//
// What bounds a body beside its shape: parts that were taken out of it, and the mesh that it is;
// and of several bodies, what bounds each of them.
#ifndef SOLIDEM_MODEL_OUTLINE_HPP
#define SOLIDEM_MODEL_OUTLINE_HPP

#include <memory>
#include <vector>

#include "model/facet_tree.hpp"
#include "model/shape.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// A part that is taken out of a body: a simple solid, turned about its centre, or what a closed
/// mesh bounds.
struct Cut {
  Shape::Part part;  ///< `offset` is where its centre is
  Quaternion<double> turned{};
  bool takes_touched = false;               ///< elements that reach into it go, too
  std::shared_ptr<const FacetTree> mesh{};  ///< where it is put; then it is no part

  /// From a point to the solid, m; 0 inside.
  double distance(const Vector& point) const;
};

/// What bounds one of several bodies: where it was made, and how it came from there to its place.
struct PlacedOutline {
  Domain domain;                             ///< where it was made
  std::shared_ptr<const Outline> outline{};  ///< likewise, as that of a specimen
  Quaternion<double> turned{};               ///< about the origin, then
  Vector shift{};                            ///< m

  /// A point where the body was made, and where it is.
  Vector to_place(const Vector& point) const { return rotate(turned, point) + shift; }
  Vector from_place(const Vector& point) const { return rotate(conjugate(turned), point - shift); }
};

/// Of a body with cuts, or one that a closed mesh bounds; or of several bodies.
struct Outline {
  std::shared_ptr<const FacetTree> surface{};  ///< of a mesh, else null
  std::vector<Cut> cuts;
  std::vector<PlacedOutline> bodies{};  ///< of several, in their order; then nothing else

  /// Whether a point is inside of the mesh, if there is one, and outside of all cuts.
  bool holds(const Vector& point) const;
};

}  // namespace solidem

#endif
