// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/rigid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/constants.hpp"

namespace solidem {

namespace {

constexpr int segments = 48;  // of round shapes, in pictures

/// A convex shape: one place, which a formula gives.
class ConvexShape : public RigidShape {
 public:
  void find_touching(const Vector& centre, double radius, NearFacets& /*near*/,
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

}  // namespace solidem
