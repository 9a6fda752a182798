// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat conduction between neighbouring elements by platonic solids.
//
// Source: Terreros 2013, section 2.4, equation 2.7 and table 2.1.
//   W_ij = S_ij λ (T_j − T_i) / d_ij            power from j to i                  [W]
//   S_ij = sqrt(S_i S_j), S_i = R_i² S_nd(N_v)  transmission area                  [m²]
//   C_i  = c_p ρ_0 V_i / f_v(N_v)               heat capacity, V_i the sphere's    [J/K]
// An element with N_v neighbours stands for the platonic solid with N_v faces drawn round it (S_nd)
// and for the crystal with N_v neighbours (f_v). On a simple cubic lattice this is exactly the
// central finite-difference scheme.
#ifndef SOLIDEM_LAWS_PLATONIC_CONDUCTION_HPP
#define SOLIDEM_LAWS_PLATONIC_CONDUCTION_HPP

#include <cmath>

#include "laws/constants.hpp"

namespace solidem {

/// S_nd: area of one face of the platonic solid round a unit sphere, linear in the number of
/// neighbours between 4, 6, 8, 12 and 20; the outer slopes go on below 4 and above 20, and the area
/// stays positive.
inline double platonic_face_area(double neighbours) {
  // Face areas of the solids of inradius 1: tetrahedron 6√3, cube 4, octahedron 3√3/2, then
  // dodecahedron and icosahedron.
  constexpr double faces[] = {4, 6, 8, 12, 20};
  static const double dodecahedron = [] {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    const double edge = 2 * std::sqrt(3 - golden) / (golden * golden);
    return 0.25 * std::sqrt(25 + 10 * std::sqrt(5.0)) * edge * edge;
  }();
  static const double icosahedron = [] {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    const double edge = 2 * std::sqrt(3.0) / (golden * golden);
    return 0.25 * std::sqrt(3.0) * edge * edge;
  }();
  const double area[] = {6 * std::sqrt(3.0), 4, 1.5 * std::sqrt(3.0), dodecahedron, icosahedron};
  int k = 0;
  while (k < 3 && neighbours > faces[k + 1]) ++k;
  const double slope = (area[k + 1] - area[k]) / (faces[k + 1] - faces[k]);
  const double value = area[k] + slope * (neighbours - faces[k]);
  return value > 0.01 * area[4] ? value : 0.01 * area[4];
}

/// f_v: volume fraction of the crystal with that many neighbours (diamond 4, simple cubic 6,
/// body-centred 8, face-centred 12), linear between, 0 at 0, the last slope kept above 12, at
/// most 1.
inline double platonic_volume_fraction(double neighbours) {
  const double count[] = {0, 4, 6, 8, 12};
  const double fraction[] = {0, pi * std::sqrt(3.0) / 16, pi / 6, pi * std::sqrt(3.0) / 8,
                             pi / (3 * std::sqrt(2.0))};
  int k = 0;
  while (k < 3 && neighbours > count[k + 1]) ++k;
  const double slope = (fraction[k + 1] - fraction[k]) / (count[k + 1] - count[k]);
  const double value = fraction[k] + slope * (neighbours - count[k]);
  return value < 1 ? value : 1;
}

/// One side of a conducting pair.
struct PlatonicElement {
  double radius;      ///< R, m
  double neighbours;  ///< N_v
};

/// S_ij, m².
inline double platonic_transmission_area(const PlatonicElement& i, const PlatonicElement& j) {
  return i.radius * j.radius *
         std::sqrt(platonic_face_area(i.neighbours) * platonic_face_area(j.neighbours));
}

/// Heat capacity C_i, J/K. An element without neighbours counts as a bare sphere.
inline double platonic_heat_capacity(const PlatonicElement& element, double density,
                                     double specific_heat) {
  const double sphere = 4.0 / 3.0 * pi * element.radius * element.radius * element.radius;
  const double fraction =
      element.neighbours > 0 ? platonic_volume_fraction(element.neighbours) : 1.0;
  return specific_heat * density * sphere / fraction;
}

}  // namespace solidem

#endif
