// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_BOND_SECTIONS_HPP
#define SOLIDEM_APP_BOND_SECTIONS_HPP

#include <string>

#include "effects/beam_parameters.hpp"
#include "engine/tension_test.hpp"

namespace solidem {

/// ν of the beams along the grain, from E and G.
double poisson_ratio_of(const BeamParameters& beams);

/// The sections of a scene that hold the parameters of bonds: [beams], [plasticity], [rupture].
std::string bond_sections(const BondParameters& bonds);

}  // namespace solidem

#endif
