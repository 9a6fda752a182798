// SPDX-License-Identifier: GPL-2.0-or-later
//
// Virial stress of an element, without its kinetic part:
//   V σ = ½ Σ_j sym(f_j ⊗ x_j) + Σ_t sym(f_t ⊗ a_t),
// f_j the force of neighbour j on the element, x_j the chord from its centre to that of j; f_t the
// force of what touches it from outside of the body, at a_t from its centre; V its volume.
// Source: Love–Weber; Thompson, Plimpton and Mattson 2009, 10.1063/1.3245303
#ifndef SOLIDEM_LAWS_VIRIAL_STRESS_HPP
#define SOLIDEM_LAWS_VIRIAL_STRESS_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// In the order of VTK.
template <class Real>
struct SymmetricTensor {
  Real xx{}, yy{}, zz{}, xy{}, yz{}, xz{};

  friend constexpr SymmetricTensor operator*(const Real& s, const SymmetricTensor& a) {
    return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.yz, s * a.xz};
  }
  friend constexpr SymmetricTensor operator/(const SymmetricTensor& a, const Real& s) {
    return {a.xx / s, a.yy / s, a.zz / s, a.xy / s, a.yz / s, a.xz / s};
  }
  constexpr SymmetricTensor& operator+=(const SymmetricTensor& b) {
    return *this = {xx + b.xx, yy + b.yy, zz + b.zz, xy + b.xy, yz + b.yz, xz + b.xz};
  }
};

/// sym(f ⊗ a): what a force that acts on an element at a lever from its centre adds to V σ.
template <class Real>
constexpr SymmetricTensor<Real> virial_of_force(const Vector3<Real>& f, const Vector3<Real>& a) {
  const Real half{0.5};
  return {f.x * a.x,
          f.y * a.y,
          f.z * a.z,
          half * (f.x * a.y + f.y * a.x),
          half * (f.y * a.z + f.z * a.y),
          half * (f.z * a.x + f.x * a.z)};
}

/// What a pair adds to V σ of each of its two elements. `force`: on the one, `chord`: from there to
/// the other.
template <class Real>
constexpr SymmetricTensor<Real> virial_of_pair(const Vector3<Real>& force,
                                               const Vector3<Real>& chord) {
  return Real{0.5} * virial_of_force(force, chord);
}

}  // namespace solidem

#endif
