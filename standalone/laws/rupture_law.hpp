// SPDX-License-Identifier: GPL-2.0-or-later
//
// What every rupture law of bonds has: a name, parameters that say themselves what they are
// (bond_law.hpp), `complaint()` about parameters that do not go together (null: none), and two pure
// functions,
//   breaks(strain)   whether a bond breaks that is strained so (BondStrain), after any flow
//   lower_bound(κ)   an equivalent strain up to which no bond of the plastic strain κ breaks
#ifndef SOLIDEM_LAWS_RUPTURE_LAW_HPP
#define SOLIDEM_LAWS_RUPTURE_LAW_HPP

#include <cmath>

#include "laws/algebra.hpp"
#include "laws/bond_law.hpp"

namespace solidem {

/// A limit that is never reached.
inline constexpr double unlimited = HUGE_VAL;

template <class Real>
constexpr Real smaller_of(const Real& a, const Real& b) {
  return select(greater(a, b), b, a);
}

}  // namespace solidem

#endif
