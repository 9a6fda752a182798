// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_RUN_HPP
#define SOLIDEM_ENGINE_RUN_HPP

#include <atomic>
#include <map>
#include <string>

#include "engine/run_costs.hpp"
#include "engine/simulation.hpp"

namespace solidem {

/// Where and how a simulation is run and recorded.
struct RunOptions {
  std::string
      directory;  ///< for summary.json, history.csv, trajectory.h5, checkpoint.h5; made if absent
  std::string scene;             ///< path of the scene file, for the summary
  std::vector<std::string> set;  ///< what held instead of values in it, for the summary
  std::string fingerprint;       ///< of the scene: a checkpoint of another is refused
  bool resume = false;           ///< go on from the directory's checkpoint
  bool quiet = false;            ///< no progress bar
  bool ends_program = true;  ///< where a long step is interrupted, the program may end within it
  const std::atomic<bool>* interrupted = nullptr;  ///< set from outside: stop after this step
  std::map<std::string, double> wall_seconds;      ///< of earlier phases, by name, for the summary
};

/// How a run ended.
struct RunOutcome {
  bool completed;   ///< it came to its end; false: it was interrupted
  HistoryRow last;  ///< of the history
  HistoryRow peak;  ///< of this call, with the largest stress in the gauge; else empty
};

/// Runs a simulation to its end and writes its results as it goes. An interrupted or diverging run
/// leaves a readable result and a summary; an interrupted one also a checkpoint to resume from.
/// Throws InputError (an unusable checkpoint) and RunError (divergence, a file that cannot be
/// written).
RunOutcome run(Simulation& simulation, const RunOptions& options);

/// Takes the first steps of a run, half a second of them at most, writes each kind of file once,
/// and tells what it all cost.
RunCosts try_run(Simulation& simulation, const RunOptions& options);

}  // namespace solidem

#endif
