// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonds of several materials share the form of their laws of yield and rupture. What differs is
// scale: with s of stresses, t of plastic strains and u of the strains of rupture, a bond flows at
//   ε_y(κ) = s ε_law(κ / t)
// and breaks where the law says so of its strains over u.
#ifndef SOLIDEM_LAWS_LIMIT_SCALE_HPP
#define SOLIDEM_LAWS_LIMIT_SCALE_HPP

namespace solidem {

/// The limits of a bond over those of the laws.
template <class Real>
struct LimitScale {
  bool is_one = true;  ///< the laws hold as they stand
  Real yield{1.0};     ///< s
  Real plastic{1.0};   ///< t
  Real rupture{1.0};   ///< u
};

}  // namespace solidem

#endif
