// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_HEAT_AT_REST_HPP
#define SOLIDEM_ENGINE_HEAT_AT_REST_HPP

#include <vector>

#include "engine/simulation.hpp"

namespace solidem {

/// Temperature of each element, K, at a time, s, of a simulation that has just been made, if
/// nothing moves: heat alone, by implicit steps. Its conduction, sources, fluxes, convections and
/// imposed temperatures count, what motion makes of heat does not.
std::vector<double> temperature_at_rest(const Simulation& simulation, double time);

/// By how much each bond is longer free of load, over its rest length, at temperatures of the
/// elements and with [expansion].
std::vector<double> thermal_strain(const Simulation& simulation, const std::vector<Pair>& bonds,
                                   const std::vector<double>& temperature);

}  // namespace solidem

#endif
