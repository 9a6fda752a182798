// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_HELD_BODY_HPP
#define SOLIDEM_SOLVE_STATICS_HELD_BODY_HPP

#include <string>
#include <vector>

#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

/// The rigid motions that are left to a body when some of its degrees of freedom (`held`, six for
/// each element) are held: "it can shift along x; it can turn about (0, 0.6, 0.8)". Empty when
/// there are none.
std::string free_rigid_motions(const BeamNetwork& network, const std::vector<char>& held);

}  // namespace solidem

#endif
