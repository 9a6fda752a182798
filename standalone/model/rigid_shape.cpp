// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/rigid_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "laws/constants.hpp"
#include "model/facet_tree.hpp"

namespace solidem {

namespace {

constexpr int segments = 48;  // of round shapes, in pictures

/// A convex shape: one place, which a formula gives.
class ConvexShape : public RigidShape {
 public:
  void find_touching(const Vector& centre, double radius,
                     std::vector<SurfacePoint>& found) const override {
    const SurfacePoint nearest = closest(centre);
    if (nearest.distance < radius) found.push_back(nearest);
  }
  double distance(const Vector& point, double /*reach*/) const override {
    return closest(point).distance;
  }

 protected:
  virtual SurfacePoint closest(const Vector& point) const = 0;

  /// Of a point outside, whose closest point is known.
  static SurfacePoint outside(const Vector& point, const Vector& on_surface) {
    const Vector away = point - on_surface;
    const double distance = norm(away);
    return {on_surface, (1 / distance) * away, distance};
  }
  static SurfacePoint inside(const Vector& point, const Vector& normal, double distance) {
    return {point - distance * normal, normal, distance};
  }
};

class Plane : public ConvexShape {
 public:
  const char* name() const override { return "plane"; }
  double extent() const override { return std::numeric_limits<double>::infinity(); }
  TriangleMesh drawn(double size) const override {
    return {{{-size, -size, 0}, {size, -size, 0}, {size, size, 0}, {-size, size, 0}},
            {{0, 1, 2}, {0, 2, 3}}};
  }

 protected:
  SurfacePoint closest(const Vector& point) const override {
    return inside(point, {0, 0, 1}, point.z);
  }
};

class Box : public ConvexShape {
 public:
  explicit Box(const Vector& size) : half_(0.5 * size) {}

  const char* name() const override { return "box"; }
  double extent() const override { return norm(half_); }
  TriangleMesh drawn(double /*size*/) const override {
    TriangleMesh mesh;
    for (const double z : {-half_.z, half_.z})
      for (const double y : {-half_.y, half_.y})
        for (const double x : {-half_.x, half_.x}) mesh.vertices.push_back({x, y, z});
    mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
  }

 protected:
  SurfacePoint closest(const Vector& point) const override {
    Vector nearest = point, normal{};
    double depth = -1;
    int shallowest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = component(half_, axis), at = component(point, axis);
      component(nearest, axis) = std::clamp(at, -half, half);
      const double below = std::fabs(at) - half;
      if (axis == 0 || below > depth) {
        depth = below;
        shallowest = axis;
      }
    }
    if (depth > 0) return outside(point, nearest);
    component(normal, shallowest) = component(point, shallowest) < 0 ? -1 : 1;
    return inside(point, normal, depth);
  }

 private:
  Vector half_;
};

class Ball : public ConvexShape {
 public:
  explicit Ball(double radius) : radius_(radius) {}

  const char* name() const override { return "sphere"; }
  double extent() const override { return radius_; }
  TriangleMesh drawn(double /*size*/) const override {
    TriangleMesh mesh;
    constexpr int rings = segments / 2;
    mesh.vertices.push_back({0, 0, -radius_});
    for (int k = 1; k < rings; ++k)
      for (int s = 0; s < segments; ++s) {
        const double height = -std::cos(0.5 * two_pi * k / rings);
        const double wide = std::sin(0.5 * two_pi * k / rings), angle = two_pi * s / segments;
        mesh.vertices.push_back(radius_ *
                                Vector{wide * std::cos(angle), wide * std::sin(angle), height});
      }
    mesh.vertices.push_back({0, 0, radius_});
    const auto last = static_cast<std::int32_t>(mesh.vertices.size() - 1);
    for (int s = 0; s < segments; ++s) {
      const int next = (s + 1) % segments;
      mesh.facets.push_back({0, 1 + next, 1 + s});
      for (int k = 0; k < rings - 2; ++k) {
        const int low = 1 + k * segments, high = low + segments;
        mesh.facets.push_back({low + s, low + next, high + next});
        mesh.facets.push_back({low + s, high + next, high + s});
      }
      mesh.facets.push_back({last, last - segments + s, last - segments + next});
    }
    return mesh;
  }

 protected:
  SurfacePoint closest(const Vector& point) const override {
    const double from_centre = norm(point);
    const Vector normal = from_centre > 0 ? (1 / from_centre) * point : Vector{0, 0, 1};
    return {radius_ * normal, normal, from_centre - radius_};
  }

 private:
  double radius_;
};

class Cylinder : public ConvexShape {
 public:
  Cylinder(double radius, double length) : radius_(radius), half_(0.5 * length) {}

  const char* name() const override { return "cylinder"; }
  double extent() const override { return std::sqrt(radius_ * radius_ + half_ * half_); }
  TriangleMesh drawn(double /*size*/) const override {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, -half_}, {0, 0, half_}};
    for (int s = 0; s < segments; ++s)
      for (const double z : {-half_, half_}) {
        const double angle = two_pi * s / segments;
        mesh.vertices.push_back({radius_ * std::cos(angle), radius_ * std::sin(angle), z});
      }
    for (int s = 0; s < segments; ++s) {
      const int low = 2 + 2 * s, next = 2 + 2 * ((s + 1) % segments);
      mesh.facets.push_back({0, next, low});
      mesh.facets.push_back({1, low + 1, next + 1});
      mesh.facets.push_back({low, next, next + 1});
      mesh.facets.push_back({low, next + 1, low + 1});
    }
    return mesh;
  }

 protected:
  SurfacePoint closest(const Vector& point) const override {
    const double from_axis = std::sqrt(point.x * point.x + point.y * point.y);
    const double beyond = from_axis - radius_, above = std::fabs(point.z) - half_;
    const Vector across =
        from_axis > 0 ? (1 / from_axis) * Vector{point.x, point.y, 0} : Vector{1, 0, 0};
    if (beyond > 0 || above > 0) {
      Vector nearest = std::min(from_axis, radius_) * across;
      nearest.z = std::clamp(point.z, -half_, half_);
      return outside(point, nearest);
    }
    if (beyond >= above) return inside(point, across, beyond);
    return inside(point, {0, 0, point.z < 0 ? -1.0 : 1.0}, above);
  }

 private:
  double radius_, half_;
};

class MeshShape : public RigidShape {
 public:
  explicit MeshShape(TriangleMesh mesh) : tree_(std::move(mesh)) { note_flat_places(); }

  void find_touching(const Vector& centre, double radius,
                     std::vector<SurfacePoint>& found) const override {
    ClosestPoint nearest;
    thread_local std::vector<ClosestPoint> near;
    near.clear();
    tree_.for_each_near(centre, radius, [&](std::int32_t facet) {
      const ClosestPoint at = tree_.closest_on(facet, centre);
      if (at.distance >= radius) return;
      if (at.distance < nearest.distance) nearest = at;
      near.push_back(at);
    });
    if (near.empty()) return;
    const SurfacePoint first = surface_point(nearest, centre);
    if (first.distance < 0) {
      found.push_back(first);
      return;
    }
    Touched touched;
    for (const ClosestPoint& at : near)
      if (is_nearest_around(at, centre) && faces(at, centre))
        touched.add({surface_point(at, centre), at.facet});
    touched.finish(found);
  }

  const char* name() const override { return "mesh"; }
  double distance(const Vector& point, double reach) const override {
    const ClosestPoint nearest = tree_.closest(point, reach);
    if (nearest.facet >= 0) return surface_point(nearest, point).distance;
    return tree_.is_closed() && is_within_bounds(point) ? tree_.signed_distance(point) : reach;
  }

  int most_contacts() const override { return 3; }
  double extent() const override {
    double largest = 0;
    for (const Vector& vertex : tree_.mesh().vertices) largest = std::max(largest, norm(vertex));
    return largest;
  }
  TriangleMesh drawn(double /*size*/) const override { return tree_.mesh(); }

 private:
  /// Places found, of which those that have about the same normal are one.
  class Touched {
   public:
    struct Place {
      SurfacePoint point;
      std::int32_t facet;
    };
    void add(const Place& place) { places_.push_back(place); }
    void finish(std::vector<SurfacePoint>& found) {
      constexpr double alike = 0.9659258262890683;  // cosine of 15 degrees
      std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
        return a.point.distance != b.point.distance ? a.point.distance < b.point.distance
                                                    : a.facet < b.facet;
      });
      const std::size_t before = found.size();
      for (const Place& place : places_)
        if (std::none_of(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
                         [&](const SurfacePoint& other) {
                           return dot(other.normal, place.point.normal) > alike;
                         }))
          found.push_back(place.point);
    }

   private:
    std::vector<Place> places_;
  };

  /// Sides and vertices between facets that are coplanar to round-off: there a facet's own normal
  /// is more exact than the way to the closest point.
  void note_flat_places() {
    constexpr double round_off = 1e-9;
    const std::vector<Vector>& normals = tree_.normals();
    const auto differ = [&](std::size_t a, std::int32_t b) {
      return norm(normals[a] - normals[static_cast<std::size_t>(b)]) > round_off;
    };
    flat_side_.assign(normals.size(), {false, false, false});
    flat_corner_.assign(normals.size(), {true, true, true});
    for (std::size_t f = 0; f < normals.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t other = tree_.across()[f][k];
        flat_side_[f][k] = other >= 0 && !differ(f, other);
        tree_.for_each_around(tree_.mesh().facets[f][k], [&](std::int32_t around) {
          const Facet& beside = tree_.across()[static_cast<std::size_t>(around)];
          const bool is_rim =
              std::any_of(beside.begin(), beside.end(), [](std::int32_t next) { return next < 0; });
          if (is_rim || differ(f, around)) flat_corner_[f][k] = false;
        });
      }
  }
  bool is_flat(const ClosestPoint& at) const {
    const auto f = static_cast<std::size_t>(at.facet), k = static_cast<std::size_t>(at.which);
    return at.part == ClosestPoint::Part::side ? flat_side_[f][k] : flat_corner_[f][k];
  }

  /// With the normal towards the point, except from inside of a closed mesh.
  SurfacePoint surface_point(const ClosestPoint& at, const Vector& point) const {
    const Vector away = point - at.position;
    Vector normal = tree_.normal_at(at);
    const bool is_behind = dot(away, normal) < 0;
    if (at.part == ClosestPoint::Part::face || is_flat(at)) {
      normal = tree_.normals()[static_cast<std::size_t>(at.facet)];
      if (is_behind && !tree_.is_closed()) normal = -normal;
    } else if (at.distance > 0) {
      normal = ((is_behind && tree_.is_closed() ? -1 : 1) / at.distance) * away;
    } else {
      normal = (1 / norm(normal)) * normal;
    }
    return {at.position, normal, is_behind && tree_.is_closed() ? -at.distance : at.distance};
  }

  /// Whether no facet beside is nearer, nor as near with its inside, which then is the place.
  bool is_nearest_around(const ClosestPoint& at, const Vector& centre) const {
    using Part = ClosestPoint::Part;
    constexpr double round_off = 1e-12;
    if (at.part == Part::face) return true;
    const auto is_nearer = [&](std::int32_t facet) {
      if (facet < 0 || facet == at.facet) return false;
      const ClosestPoint there = tree_.closest_on(facet, centre);
      return there.distance <
             (there.part == Part::face ? 1 + round_off : 1 - round_off) * at.distance;
    };
    const auto f = static_cast<std::size_t>(at.facet), k = static_cast<std::size_t>(at.which);
    if (at.part == Part::side) return !is_nearer(tree_.across()[f][k]);
    bool is_nearest = true;
    tree_.for_each_around(tree_.mesh().facets[f][k], [&](std::int32_t facet) {
      is_nearest = is_nearest && !is_nearer(facet);
    });
    return is_nearest;
  }

  /// Whether the surface looks at the point: a closed mesh is felt from outside alone.
  bool faces(const ClosestPoint& at, const Vector& point) const {
    return !tree_.is_closed() || dot(point - at.position, tree_.normal_at(at)) >= 0;
  }

  bool is_within_bounds(const Vector& p) const {
    const auto& [lower, upper] = bounds_;
    return lower.x < p.x && p.x < upper.x && lower.y < p.y && p.y < upper.y && lower.z < p.z &&
           p.z < upper.z;
  }

  FacetTree tree_;
  std::vector<std::array<bool, 3>> flat_side_, flat_corner_;  ///< of each facet
  std::pair<Vector, Vector> bounds_ = bounds(tree_.mesh());
};

}  // namespace

std::unique_ptr<RigidShape> plane_shape() {
  return std::make_unique<Plane>();
}
std::unique_ptr<RigidShape> box_shape(const Vector& size) {
  return std::make_unique<Box>(size);
}
std::unique_ptr<RigidShape> ball_shape(double radius) {
  return std::make_unique<Ball>(radius);
}
std::unique_ptr<RigidShape> cylinder_shape(double radius, double length) {
  return std::make_unique<Cylinder>(radius, length);
}
std::unique_ptr<RigidShape> mesh_shape(TriangleMesh mesh) {
  return std::make_unique<MeshShape>(std::move(mesh));
}

}  // namespace solidem
