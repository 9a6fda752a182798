// SPDX-License-Identifier: GPL-2.0-or-later
//
// A surface of facets as a ball feels it: `mesh_shape` of rigid_shape.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "model/facet_tree.hpp"
#include "model/rigid_shape.hpp"

namespace solidem {

namespace {

class MeshShape : public RigidShape {
 public:
  explicit MeshShape(TriangleMesh mesh) : tree_(std::move(mesh)) { note_flat_places(); }

  void find_touching(const Vector& centre, double radius, NearFacets& near,
                     std::vector<SurfacePoint>& found) const override {
    const double moved = look_around(centre, radius, near);
    ClosestPoint nearest;
    thread_local std::vector<ClosestPoint> places;
    places.clear();
    for (const NearFacets::Entry& entry : near.entries) {
      if (entry.distance - moved >= radius) continue;
      const ClosestPoint at = tree_.closest_on(entry.facet, centre);
      if (at.distance >= radius) continue;
      if (at.distance < nearest.distance) nearest = at;
      places.push_back(at);
    }
    if (places.empty()) return;
    const SurfacePoint first = surface_point(nearest, centre);
    if (first.distance < 0) {
      found.push_back(first);
      return;
    }
    thread_local Touched touched;
    for (const ClosestPoint& at : places)
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
      places_.clear();
    }

   private:
    std::vector<Place> places_;
  };

  /// How far a ball has moved since its facets were found, m; where that is too far they are found
  /// anew.
  double look_around(const Vector& centre, double radius, NearFacets& near) const {
    constexpr double margin_of_radius = 0.1, round_off = 1e-12;
    const double moved = norm(centre - near.centre) + round_off * radius;
    if (moved < near.margin) return moved;
    near.centre = centre;
    near.margin = margin_of_radius * radius;
    near.entries.clear();
    tree_.for_each_near(centre, radius + near.margin, [&](std::int32_t facet) {
      const double distance = tree_.closest_on(facet, centre).distance;
      if (distance < radius + near.margin) near.entries.push_back({facet, distance});
    });
    return round_off * radius;
  }

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

std::unique_ptr<RigidShape> mesh_shape(TriangleMesh mesh) {
  return std::make_unique<MeshShape>(std::move(mesh));
}

}  // namespace solidem
