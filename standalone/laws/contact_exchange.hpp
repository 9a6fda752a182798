// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat between two bodies that touch, each of one temperature.
//
//   A = 2 π R* δ                          circle in which two spheres overlap by δ ≪ R
//   1/R* = 1/R_i + 1/R_j
//   Q(t) = C* (T_j − T_i)(1 − exp(−G t / C*))     into i, through a conductance G, exact
//   1/C* = 1/C_i + 1/C_j                  C heat capacities, J/K; infinite of what is held
#ifndef SOLIDEM_LAWS_CONTACT_EXCHANGE_HPP
#define SOLIDEM_LAWS_CONTACT_EXCHANGE_HPP

#include <cmath>

#include "laws/constants.hpp"

namespace solidem {

/// Area of the circle in which a sphere overlaps another or, where that has no curvature, a plane,
/// m²; curvatures 1/R, 1/m.
inline double overlap_area(double curvature, double other_curvature, double overlap) {
  return overlap > 0 ? 2 * pi * overlap / (curvature + other_curvature) : 0.0;
}

/// Heat, J, that the first takes up in a time, s. `difference`: by which the second is warmer, K;
/// `inverse_capacity`: 1/C*, K/J.
inline double exchanged_heat(double conductance, double inverse_capacity, double difference,
                             double time) {
  return -std::expm1(-conductance * inverse_capacity * time) * difference / inverse_capacity;
}

}  // namespace solidem

#endif
