// SPDX-License-Identifier: GPL-2.0-or-later
//
// Conductances of heat paths, in W/K: between two elements, and between an element and what is
// outside the body.
//
//   between elements   G = λ S / d                     Terreros 2013, equation 2.1, with S and d
//   from
//                                                      the transmission law
//   two materials      λ = 2 λ_i λ_j / (λ_i + λ_j)     two halves of the way in series
//   a contact          1/G = d / (λ S) + 1 / (h_c S)   h_c the contact conductance, W/(m² K)
//   a wall             G = λ A / s                     s from the centre to the wall face of area A
//   convection         1/G = s / (λ A) + 1 / (h A)     h the coefficient of convection, W/(m² K)
#ifndef SOLIDEM_LAWS_HEAT_EXCHANGE_HPP
#define SOLIDEM_LAWS_HEAT_EXCHANGE_HPP

namespace solidem {

/// Conductance, W/K, of a path of a length (m) and a section (m²) in one material (W/(m K)).
template <class Scalar>
inline Scalar path_conductance(const Scalar& conductivity, double section, double length) {
  return section * conductivity / length;
}

/// Conductivity of a path half in one material and half in another, W/(m K).
template <class Scalar>
inline Scalar series_conductivity(const Scalar& a, const Scalar& b) {
  return (Scalar(2) * a) * b / (a + b);
}

/// Conductance of a path and a surface one after the other, W/K. `surface` is h A.
inline double series_conductance(double path, double surface) {
  return surface > 0 ? path * surface / (path + surface) : 0.0;
}

}  // namespace solidem

#endif
