// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_CLOSING_HPP
#define SOLIDEM_APP_CLOSING_HPP

#include <string>

#include "engine/run.hpp"

namespace solidem {

/// What a run ends with on the terminal, some lines: steps and time taken, what came out (peak
/// stress or what was observed last, broken bonds), what to open next. `seconds`: that it took.
std::string closing_lines(const Simulation& simulation, const RunOutcome& outcome,
                          const std::string& directory, double seconds);

}  // namespace solidem

#endif
