// SPDX-License-Identifier: GPL-2.0-or-later
//
// Contact of two elements that no bond joins: a linear spring that only pushes,
//   F_i = −k (d_c − L) x   while L < d_c,
// x the unit chord from i to j, L its length. Two elements that were bonded touch at the distance
// they had then if they overlapped (else they would be thrown apart when the bond breaks), or so
// much nearer that the contact pushes no harder than the bond did; all others where their spheres
// meet.
#ifndef SOLIDEM_LAWS_CONTACT_HPP
#define SOLIDEM_LAWS_CONTACT_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// d_c of two elements whose bond broke, m. `rest_length`: of the bond when it was made.
/// `plastic_extension`: negative where it was shortened. `radii`: sum of both.
template <class Real>
constexpr Real contact_distance(const Real& rest_length, const Real& plastic_extension,
                                const Real& radii) {
  const Real shortened = rest_length + plastic_extension;
  const Real length = select(greater(rest_length, shortened), shortened, rest_length);
  return select(greater(radii, length), length, radii);
}

/// The same of a bond that breaks while it is `length` long and pushes its elements apart with
/// `push`, N: no farther than where a contact of this stiffness, N/m, pushes as much, so that it
/// takes over what the bond bears, and no more. `free_distance`: d_c without a push.
template <class Real>
constexpr Real contact_distance(const Real& free_distance, const Real& length, const Real& push,
                                const Real& stiffness) {
  const Real taken_over = length + push / stiffness;
  return select(greater(free_distance, taken_over), taken_over, free_distance);
}

/// The same where nothing has flowed.
template <class Real>
constexpr Real contact_distance(const Real& rest_length, const Real& radii) {
  return contact_distance(rest_length, Real{0.0}, radii);
}

/// Whether a pair under pressure may be bonded anew: not where it is shorter than half of the sum
/// of its radii. Each bond that is pressed until it breaks leaves the pair shorter, and the next
/// one begins there free of load; without an end to this two elements would pass through each
/// other.
template <class Real>
constexpr bool may_be_bonded_anew(const Real& length, const Real& radii) {
  return length > Real{0.5} * radii;
}

/// Force on i, N; `stiffness` k in N/m, chord from i to j. A chord of length zero gives no force.
template <class Real>
constexpr Vector3<Real> contact_force(const Real& stiffness, const Real& distance,
                                      const Vector3<Real>& chord) {
  using std::sqrt;
  const Real tiny{1e-300}, none{0.0};
  const Real length = sqrt(dot(chord, chord) + tiny);
  const Real push = select(greater(distance, length), stiffness * (distance - length), none);
  return (-push / length) * chord;
}

/// Energy stored in a contact, J.
template <class Real>
constexpr Real contact_energy(const Real& stiffness, const Real& distance,
                              const Vector3<Real>& chord) {
  using std::sqrt;
  const Real length = sqrt(dot(chord, chord)), none{0.0}, half{0.5};
  const Real depth = select(greater(distance, length), distance - length, none);
  return half * stiffness * depth * depth;
}

}  // namespace solidem

#endif
