// SPDX-License-Identifier: GPL-2.0-or-later
//
// The volume of a body less its cuts. The body's box is halved again and again, until what is left
// of each half is cut by one round surface at most, for which there are closed formulas; where two
// meet, halves become small and the flatter one a plane in each.
#include <algorithm>
#include <cmath>

#include "specimen/cut.hpp"
#include "specimen/shape.hpp"

namespace solidem {

namespace {

constexpr double smallest_half = 1.0 / 200;  // of the body's extent

Vector along(int axis, double value) {
  Vector v{};
  component(v, axis) = value;
  return v;
}

struct HalfSpace {
  Vector normal;  // outward
  double offset;
};

enum class Relation { outside, inside, across };

// A convex part that the body must lie in, or that is taken out of it.
struct Bound {
  Cut cut;
  bool is_kept;

  Vector in_frame(const Vector& point) const {
    return rotate(conjugate(cut.turned), point - cut.part.offset);
  }

  // Of a point to the round surface, m; negative within. Boxes have none.
  double beyond_round(const Vector& local) const {
    Vector across = local;
    if (cut.part.kind == Shape::Kind::cylinder) component(across, cut.part.axis) = 0;
    return norm(across) - cut.part.radius;
  }
  bool is_round() const { return cut.part.kind != Shape::Kind::box; }

  // The largest distance of a point beyond one of its flat faces, m; negative within.
  double beyond_flat(const Vector& local) const {
    const Shape::Part& part = cut.part;
    if (part.kind == Shape::Kind::cylinder)
      return std::abs(component(local, part.axis)) - 0.5 * part.length;
    if (part.kind == Shape::Kind::sphere) return -part.radius;
    double beyond = -std::abs(part.size.x);
    for (int k = 0; k < 3; ++k)
      beyond = std::max(beyond, std::abs(component(local, k)) - 0.5 * component(part.size, k));
    return beyond;
  }

  // To a ball.
  Relation relation(const Vector& local, double reach) const {
    const double flat = beyond_flat(local), round = is_round() ? beyond_round(local) : flat;
    const double beyond = std::max(flat, round);
    if (beyond >= reach) return Relation::outside;
    return beyond <= -reach ? Relation::inside : Relation::across;
  }

  HalfSpace half_space(const Vector& local_normal, double distance) const {
    const Vector normal = rotate(cut.turned, local_normal);
    return {normal, dot(normal, cut.part.offset) + distance};
  }

  std::vector<HalfSpace> flat_faces() const {
    std::vector<HalfSpace> faces;
    const Shape::Part& part = cut.part;
    for (int k = 0; k < 3; ++k) {
      const bool is_end = part.kind == Shape::Kind::cylinder && k == part.axis;
      if (part.kind != Shape::Kind::box && !(is_end && std::isfinite(part.length))) continue;
      const double half = 0.5 * (is_end ? part.length : component(part.size, k));
      for (const double side : {1.0, -1.0}) faces.push_back(half_space(along(k, side), half));
    }
    return faces;
  }

  // A plane in place of the round surface near a point: as far within it as a surface that touches
  // it is beyond it on average over a patch of a size.
  HalfSpace plane_near(const Vector& local, double size) const {
    const bool is_cylinder = cut.part.kind == Shape::Kind::cylinder;
    Vector across = local;
    if (is_cylinder) component(across, cut.part.axis) = 0;
    const double length = norm(across), radius = cut.part.radius;
    if (!(length > 0)) return half_space({1, 0, 0}, radius);
    return half_space((1 / length) * across,
                      radius - size * size / ((is_cylinder ? 24 : 12) * radius));
  }

  double volume_in_round(const Polyhedron& solid) const {
    Polyhedron turned = solid;
    for (std::vector<Vector>& face : turned.faces)
      for (Vector& p : face) p = in_frame(p);
    return cut.part.kind == Shape::Kind::sphere
               ? volume_in_ball(turned, {}, cut.part.radius)
               : volume_in_cylinder(turned, {}, cut.part.axis, cut.part.radius);
  }
};

Polyhedron within(Polyhedron solid, const std::vector<HalfSpace>& faces) {
  for (const HalfSpace& face : faces)
    if (!solid.empty()) solid = clipped(solid, face.normal, face.offset);
  return solid;
}

// Convex pieces of what lies outside of one of the faces.
void take_out(std::vector<Polyhedron>& pieces, const std::vector<HalfSpace>& faces) {
  std::vector<Polyhedron> left;
  for (Polyhedron& piece : pieces)
    for (const HalfSpace& face : faces) {
      if (piece.empty()) break;
      Polyhedron outside = clipped(piece, -face.normal, -face.offset);
      if (!outside.empty()) left.push_back(std::move(outside));
      piece = clipped(piece, face.normal, face.offset);
    }
  pieces = std::move(left);
}

// Two convex solids' common part.
Polyhedron common(const Polyhedron& solid, const Polyhedron& other) {
  std::vector<HalfSpace> faces;
  for (const std::vector<Vector>& face : other.faces) {
    const Vector across = cross(face[1] - face[0], face[2] - face[0]);
    const Vector normal = (1 / norm(across)) * across;
    faces.push_back({normal, dot(normal, face[0])});
  }
  return within(solid, faces);
}

class VolumeLeft {
 public:
  explicit VolumeLeft(double smallest) : smallest_(smallest) {}

  double of(const Polyhedron& solid, const std::vector<Bound>& bounds_of_all) const {
    if (solid.empty()) return 0;
    const auto [lower, upper] = bounds(solid);
    const Vector middle = 0.5 * (lower + upper), extent = upper - lower;
    const double reach = 0.5 * norm(extent);
    std::vector<Bound> near;
    int round = 0;
    for (const Bound& bound : bounds_of_all) {
      const Vector local = bound.in_frame(middle);
      const Relation relation = bound.relation(local, reach);
      if (relation == (bound.is_kept ? Relation::outside : Relation::inside)) return 0;
      if (relation != Relation::across) continue;
      near.push_back(bound);
      if (bound.is_round() && std::abs(bound.beyond_round(local)) < reach) ++round;
    }
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (component(extent, k) > component(extent, longest)) longest = k;
    const double size = component(extent, longest);
    if (round <= 1 || size < smallest_) return of_leaf(solid, near, middle, reach);
    const double half = component(middle, longest);
    return of(clipped(solid, along(longest, 1), half), near) +
           of(clipped(solid, along(longest, -1), -half), near);
  }

 private:
  // Planes stand for all round surfaces but the most curved one.
  static double of_leaf(const Polyhedron& solid, const std::vector<Bound>& near,
                        const Vector& middle, double reach) {
    const Bound* exact = nullptr;
    for (const Bound& bound : near)
      if (bound.is_round() && std::abs(bound.beyond_round(bound.in_frame(middle))) < reach &&
          (exact == nullptr || bound.cut.part.radius < exact->cut.part.radius))
        exact = &bound;
    const auto [lower, upper] = bounds(solid);
    const double size = std::cbrt((upper - lower).x * (upper - lower).y * (upper - lower).z);
    std::vector<Polyhedron> pieces{solid};
    for (const Bound& bound : near) {
      std::vector<HalfSpace> faces = bound.flat_faces();
      if (&bound == exact) {
        if (bound.is_kept)
          for (Polyhedron& piece : pieces) piece = within(std::move(piece), faces);
        continue;
      }
      const Vector local = bound.in_frame(middle);
      if (bound.is_round() && std::abs(bound.beyond_round(local)) < reach)
        faces.push_back(bound.plane_near(local, size));
      if (bound.is_kept)
        for (Polyhedron& piece : pieces) piece = within(std::move(piece), faces);
      else
        take_out(pieces, faces);
    }
    double sum = 0;
    for (const Polyhedron& piece : pieces) {
      if (piece.empty()) continue;
      if (exact == nullptr)
        sum += volume(piece);
      else if (exact->is_kept)
        sum += exact->volume_in_round(piece);
      else
        sum += volume(piece) - exact->volume_in_round(within(piece, exact->flat_faces()));
    }
    return sum;
  }

  double smallest_;
};

// A convex solid that counts with a sign.
struct Piece {
  Polyhedron solid;
  double sign;
};

// What a closed mesh bounds, as cones over its facets.
std::vector<Piece> cones_of(const TriangleMesh& mesh) {
  const auto [lower, upper] = bounds(mesh);
  const Vector tip = 0.5 * (lower + upper);
  std::vector<Piece> cones;
  for (const Facet& facet : mesh.facets) {
    const Vector& a = mesh.vertices[static_cast<std::size_t>(facet[0])];
    Vector b = mesh.vertices[static_cast<std::size_t>(facet[1])];
    Vector c = mesh.vertices[static_cast<std::size_t>(facet[2])];
    const double content = dot(a - tip, cross(b - tip, c - tip));
    if (content == 0) continue;
    if (content < 0) std::swap(b, c);
    cones.push_back(
        {{{{a, b, c}, {tip, b, a}, {tip, c, b}, {tip, a, c}}}, content > 0 ? 1.0 : -1.0});
  }
  return cones;
}

// A body: pieces, and what bounds all of them.
struct Solid {
  std::vector<Piece> pieces;
  std::vector<HalfSpace> planes;
  std::vector<Bound> bounds;
};

void add_round_walls(const Domain& body, Solid& solid) {
  const auto round = [&](double radius, bool is_kept) {
    Cut part;
    part.part.kind = body.is_sphere() ? Shape::Kind::sphere : Shape::Kind::cylinder;
    part.part.axis = std::max(body.axis, 0);
    part.part.radius = radius;
    part.part.offset = body.axis_point();
    solid.bounds.push_back({part, is_kept});
  };
  round(body.radius, true);
  if (body.inner_radius > 0) round(body.inner_radius, false);
  if (!(body.angle > 0)) return;
  const Vector first = body.first_transverse(), second = body.second_transverse();
  const Vector last = std::cos(body.angle) * second - std::sin(body.angle) * first;
  solid.planes.push_back({-second, -dot(second, body.axis_point())});
  solid.planes.push_back({last, dot(last, body.axis_point())});
}

Solid solid_of(const Domain& body, const FacetTree* surface) {
  Solid solid;
  if (surface != nullptr) {
    solid.pieces = cones_of(surface->mesh());
    return solid;
  }
  solid.pieces.push_back({box_between(body.lower, body.upper), 1});
  for (int k = 0; k < 3; ++k) {
    solid.planes.push_back({along(k, 1), component(body.upper, k)});
    solid.planes.push_back({along(k, -1), -component(body.lower, k)});
  }
  if (body.radius > 0) add_round_walls(body, solid);
  return solid;
}

// What a piece has in common with a body.
double volume_in(const Solid& body, const Polyhedron& piece, const VolumeLeft& left) {
  return left.of(within(piece, body.planes), body.bounds);
}

// What a cone over a facet of a cut has in common with what is left of a body.
double volume_in_pieces(const Solid& body, const FacetTree* surface, const Polyhedron& cone,
                        const VolumeLeft& left) {
  if (surface == nullptr) return volume_in(body, cone, left);
  double sum = 0;
  for (const Piece& piece : body.pieces)
    sum += piece.sign * left.of(common(cone, piece.solid), body.bounds);
  return sum;
}

}  // namespace

double volume_left(const Domain& body, const std::vector<Cut>& cuts, const FacetTree* surface) {
  Solid solid = solid_of(body, surface);
  for (const Cut& cut : cuts)
    if (cut.mesh == nullptr) solid.bounds.push_back({cut, false});
  const Vector extent = body.upper - body.lower;
  const VolumeLeft left(smallest_half * std::max({extent.x, extent.y, extent.z}));
  double sum = 0;
  for (const Piece& piece : solid.pieces) sum += piece.sign * volume_in(solid, piece.solid, left);
  for (const Cut& cut : cuts) {
    if (cut.mesh == nullptr) continue;
    for (const Piece& cone : cones_of(cut.mesh->mesh()))
      sum -= cone.sign * volume_in_pieces(solid, surface, cone.solid, left);
  }
  return sum;
}

}  // namespace solidem
