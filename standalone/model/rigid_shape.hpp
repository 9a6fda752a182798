// SPDX-License-Identifier: GPL-2.0-or-later
//
// Rigid bodies as a ball feels them: where it touches their surface.
#ifndef SOLIDEM_MODEL_RIGID_SHAPE_HPP
#define SOLIDEM_MODEL_RIGID_SHAPE_HPP

#include <cstdint>
#include <memory>
#include <vector>

#include "model/triangle_mesh.hpp"

namespace solidem {

/// A place of a surface that a point is near.
struct SurfacePoint {
  Vector position{};    ///< m
  Vector normal{};      ///< unit, outward
  double distance = 0;  ///< of the point from it, along the normal, m; negative inside
};

/// The facets that a ball may touch while its centre stays within a margin of where it was. Shapes
/// that formulas describe need none.
struct NearFacets {
  struct Entry {
    std::int32_t facet;
    double distance;  ///< of the centre, m
  };
  std::vector<Entry> entries;
  Vector centre{};     ///< m
  double margin = -1;  ///< m; negative: nothing is known yet
};

/// A shape in axes of its own.
class RigidShape {
 public:
  virtual ~RigidShape() = default;

  /// "plane", "box", "sphere", "cylinder" or "mesh", as scene files call it.
  virtual const char* name() const = 0;

  /// Adds the places where a ball touches the surface. On what is flat or bulges there is one, the
  /// closest; in a hollow one for each face that the ball rests on.
  /// `near`: what is known of the surface about this ball, always of the same radius, from earlier
  /// calls; made anew where the ball has left it. What is found does not depend on it.
  virtual void find_touching(const Vector& centre, double radius, NearFacets& near,
                             std::vector<SurfacePoint>& found) const = 0;
  /// Distance of a point from the surface, m, negative inside; where it is beyond `reach` outside,
  /// anything beyond.
  virtual double distance(const Vector& point, double reach) const = 0;
  /// The most places at which a ball may touch.
  virtual int most_contacts() const { return 1; }
  /// Largest distance of its points from the origin, m.
  virtual double extent() const = 0;
  /// Its surface as triangles, for pictures; a plane as a square with sides of 2 × `size`, m.
  virtual TriangleMesh drawn(double size) const = 0;
};

/// The half space z < 0.
std::unique_ptr<RigidShape> plane_shape();
/// A box about the origin.
std::unique_ptr<RigidShape> box_shape(const Vector& size);
/// A ball about the origin.
std::unique_ptr<RigidShape> ball_shape(double radius);
/// A cylinder along z, its middle at the origin.
std::unique_ptr<RigidShape> cylinder_shape(double radius, double length);
/// What a closed mesh encloses; the two sides of an open one. `mesh` must be a surface.
///
/// A ball touches where its centre is nearer to the mesh than anywhere around: that is exact at
/// faces, edges and vertices, and on two coplanar facets it is one place. Places whose normals are
/// within 15 degrees count as one, the closest, so that a hollow which facets follow is smooth.
std::unique_ptr<RigidShape> mesh_shape(TriangleMesh mesh);

}  // namespace solidem

#endif
