// SPDX-License-Identifier: GPL-2.0-or-later
//
// The table of rupture laws of bonds: a new law is a header like these and a line here. Keys of
// scenes, kernels and words of the bond style are made from it.
#ifndef SOLIDEM_LAWS_RUPTURE_LAWS_HPP
#define SOLIDEM_LAWS_RUPTURE_LAWS_HPP

#include "laws/law_table.hpp"
#include "laws/mohr_coulomb_rupture.hpp"
#include "laws/strain_limit.hpp"

namespace solidem {

using RuptureLaws = LawTable<StrainLimit,  //
                             MohrCoulombRupture>;

/// Any of them, with its parameters.
using RuptureLaw = RuptureLaws::Any;

}  // namespace solidem

#endif
