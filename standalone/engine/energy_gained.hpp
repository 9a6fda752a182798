// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_ENERGY_GAINED_HPP
#define SOLIDEM_ENGINE_ENERGY_GAINED_HPP

#include <optional>
#include <string>

#include "engine/simulation.hpp"

namespace solidem {

/// A note on energy that came from nothing: where the balance of a row shows more than a fiftieth
/// of the largest energy in it. None for what is lost, which cracks between elements that attract
/// each other may take, and below `round_off`, J.
std::optional<std::string> note_on_gained_energy(const HistoryRow& row, double round_off);

}  // namespace solidem

#endif
