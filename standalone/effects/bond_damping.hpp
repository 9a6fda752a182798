// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_BOND_DAMPING_HPP
#define SOLIDEM_EFFECTS_BOND_DAMPING_HPP

#include "effects/plan.hpp"

namespace solidem {

/// Plans dashpots beside the modes of every beam, laws/bond_damping.hpp, of this critical ratio; a
/// setup with beams.
void plan_bond_damping(double critical_ratio, const Setup& setup, Plan& plan);

}  // namespace solidem

#endif
