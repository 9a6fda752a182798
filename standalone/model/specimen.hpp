// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_SPECIMEN_HPP
#define SOLIDEM_MODEL_SPECIMEN_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "laws/algebra.hpp"

namespace solidem {

using Vector = Vector3<double>;

struct Outline;  // model/outline.hpp

/// Two bonded elements, i < j.
struct Pair {
  std::int32_t i, j;
  friend bool operator==(const Pair& a, const Pair& b) { return a.i == b.i && a.j == b.j; }
  friend bool operator<(const Pair& a, const Pair& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }
};

/// The continuous body that a specimen represents.
struct Domain {
  /// box, plate, cylinder, annulus, wedge, sphere, mesh, crystal, bodies (several) or imported
  std::string shape = "imported";
  Vector lower{}, upper{};  ///< bounding box of the body, m
  std::array<bool, 3> periodic{false, false, false};
  double volume = 0;  ///< of the body, m³: exact, or (imported, and not told) of its cut cells

  int cuts = 0;  ///< parts that were taken out of it: its volume is what they left

  /// Round bodies (cylinder, annulus, wedge); else −1 and zeros, but for a sphere's radius.
  int axis = -1;            ///< 0, 1, 2
  double radius = 0;        ///< outer radius, m
  double inner_radius = 0;  ///< of annulus and wedge, m; else 0
  double angle = 0;  ///< of a wedge, rad: from the first transverse axis, to the second; else 0

  bool is_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  bool is_sphere() const { return radius > 0 && axis < 0; }
  /// Whether its walls are known: it has a shape, and nothing was cut out of it.
  bool has_walls() const;

  /// Area of the section normal to an axis, m²: volume over extent.
  double cross_section(int normal_axis) const;

  /// Round bodies: the point of the axis at the low end; the angle that the body takes about the
  /// axis, rad; the unit vectors across the axis that angles are measured from and towards (y and z
  /// for the axis x, z and x for y, x and y for z).
  Vector axis_point() const;
  double arc() const;
  Vector first_transverse() const;
  Vector second_transverse() const;
};

/// One of several bodies of a specimen.
struct Body {
  std::string name;
  std::string shape;                      ///< as of a domain
  Vector lower{}, upper{};                ///< of a box that holds it, m
  double volume = 0;                      ///< m³, as of a domain
  std::vector<std::int32_t> elements;     ///< increasing
  std::vector<std::int32_t> bonded_to{};  ///< numbers of bodies that its elements are bonded with
};

/// A compact packing of spheres: what every code reads.
/// Elements stand in the order of a Hilbert curve, then of their number of bonds in windows of 128.
struct Specimen {
  std::vector<Vector> position;  ///< centres at rest, m
  std::vector<double> radius;    ///< m
  Domain domain;
  std::vector<Pair> bonds;  ///< sorted, each pair once; rest length = distance of `position`
  double bond_tolerance = -1;  ///< t of d ≤ (1+t)(R_i+R_j) that made the bonds; −1: unknown or none
  /// Relative: elements that stand farther apart by this much still touch. It follows the digits
  /// with which positions were given.
  double contact_margin = 1e-12;
  std::map<std::string, std::vector<std::int32_t>> sets;  ///< named groups of elements
  std::map<std::string, double> report;                   ///< figures of the packing, by name
  std::vector<Body> bodies;  ///< where there are several; each element is in one
  /// Where the body's cuts are, and the mesh that bounds it; null where `domain` tells all, or
  /// nobody knows.
  std::shared_ptr<const Outline> outline{};

  std::size_t size() const { return position.size(); }
};

/// From centre i to centre j at rest, the nearest image in periodic directions, m.
Vector rest_chord(const Specimen& specimen, Pair pair);

/// Sum of the spheres' volumes, m³.
double sphere_volume(const Specimen& specimen);

/// Mean radius R_m, m.
double mean_radius(const Specimen& specimen);

/// The number of each element's body; empty where there is but one body.
std::vector<std::int32_t> body_of_elements(const Specimen& specimen);

/// Of each element: the volume of its body over that of the body's spheres.
std::vector<double> represented_share(const Specimen& specimen);

/// The mass that each element represents, kg: density × body volume, shared by sphere volume, so
/// that the sum over each body is exactly its mass. `density` has one value per element or one for
/// all, kg/m³.
std::vector<double> represented_mass(const Specimen& specimen, const std::vector<double>& density);

}  // namespace solidem

#endif
