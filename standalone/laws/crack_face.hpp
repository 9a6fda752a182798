// SPDX-License-Identifier: GPL-2.0-or-later
//
// Micro-cracks between elements that central forces hold together.
//
// Source: Terreros 2013, section 3.1.5. An element stands on the face of a crack when its
// neighbours stand on one side of it: when the barycentre of the elements within its range lies
// farther from it than C R_i. Two elements on opposite faces only push each other. Free surfaces
// are crack faces, too: there nothing stands opposite. Which faces are opposite the source leaves
// open; here both barycentres point away from the other element.
//
// Between a third and a half of the elements of a sound packing stand on faces by that rule, and a
// tenth of the pairs within a flat free face are told to be opposite. Free faces may be left out:
// then only who has fewer neighbours than at the start stands on the face of a crack.
#ifndef SOLIDEM_LAWS_CRACK_LIP_HPP
#define SOLIDEM_LAWS_CRACK_LIP_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// What an element shows of its neighbourhood: the barycentre of its neighbours, from the element,
/// m, where that puts it on a crack face; else nothing. An element without neighbours is on none.
/// `sum` of the chords to the neighbours; `bound` C R_i.
template <class Real>
constexpr Vector3<Real> crack_face_barycentre(const Vector3<Real>& sum, const Real& neighbours,
                                              const Real& bound) {
  const Real none{0.0}, one{1.0};
  const Real fraction = one / select(greater(neighbours, none), neighbours, one);
  const Vector3<Real> barycentre = fraction * sum;
  const Real kept = select(greater(dot(barycentre, barycentre), bound * bound), one, none);
  return kept * barycentre;
}

/// The same where free faces are left out. `at_start`: neighbours that it had then.
template <class Real>
constexpr Vector3<Real> crack_face_barycentre(const Vector3<Real>& sum, const Real& neighbours,
                                              const Real& bound, const Real& at_start) {
  const Real none{0.0}, one{1.0};
  return select(greater(at_start, neighbours), one, none) *
         crack_face_barycentre(sum, neighbours, bound);
}

/// Whether two elements stand on opposite faces, from what they show; `chord` from i to j.
template <class Real>
constexpr auto on_opposite_faces(const Vector3<Real>& barycentre_i,
                                 const Vector3<Real>& barycentre_j, const Vector3<Real>& chord) {
  const Real none{0.0};
  const Real back_i = -dot(barycentre_i, chord), back_j = dot(barycentre_j, chord);
  // Both above zero: the smaller is.
  return greater(select(greater(back_i, back_j), back_j, back_i), none);
}

}  // namespace solidem

#endif
