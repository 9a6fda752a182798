// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_RUN_COSTS_HPP
#define SOLIDEM_ENGINE_RUN_COSTS_HPP

#include <cstdint>
#include <ctime>

#include "engine/simulation.hpp"

namespace solidem {

/// How many steps a run takes and how often it looks and writes.
struct RunCounts {
  std::int64_t steps = 0;
  std::int64_t observe_every = 1;     ///< steps
  std::int64_t rows = 0;              ///< of the history
  std::int64_t frames = 0;            ///< of the trajectory
  std::int64_t checkpoint_every = 0;  ///< steps
  std::int64_t checkpoints = 0;
};

RunCounts counts_of(const Simulation& simulation);

/// Of all threads of this program, since it began.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// What the parts of a run cost, s.
struct RunCosts {
  double step = 0;            ///< at the start of the run
  double processor_step = 0;  ///< the same, of processors, which does not see a busy machine
  double row = 0;
  double frame = 0;
  double checkpoint = 0;
  double files = 0;  ///< to begin them and to end them
};

}  // namespace solidem

#endif
