// SPDX-License-Identifier: GPL-2.0-or-later
//
// What bounds a body beside its shape: parts that were taken out of it, and the mesh that it is.
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

/// Of a body with cuts, or one that a closed mesh bounds.
struct Outline {
  std::shared_ptr<const FacetTree> surface{};  ///< of a mesh, else null
  std::vector<Cut> cuts;

  /// Whether a point is inside of the mesh, if there is one, and outside of all cuts.
  bool holds(const Vector& point) const;
};

}  // namespace solidem

#endif
