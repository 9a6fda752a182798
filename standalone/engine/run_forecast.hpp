// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_RUN_FORECAST_HPP
#define SOLIDEM_ENGINE_RUN_FORECAST_HPP

#include "engine/grip_strain.hpp"
#include "engine/run_costs.hpp"
#include "engine/simulation.hpp"

namespace solidem {

/// What a run will take, s.
struct RunForecast {
  RunCounts counts;
  RunCosts costs;
  double flowing_step = 0;   ///< a step while bonds flow, s; that of the start where none will
  double flowing_share = 0;  ///< of the steps

  double steps() const {
    return static_cast<double>(counts.steps) *
           ((1 - flowing_share) * costs.step + flowing_share * flowing_step);
  }
  double rows() const { return static_cast<double>(counts.rows) * costs.row; }
  double files() const {
    return costs.files + static_cast<double>(counts.frames) * costs.frame +
           static_cast<double>(counts.checkpoints) * costs.checkpoint;
  }
  double total() const { return steps() + rows() + files(); }
};

/// Foretells a run from its beginning, tried here in a folder of its own that goes again, and from
/// steps of the same body in plastic flow where the grips will bring it there. The simulation is
/// spent: what it holds then is of no use.
RunForecast foretell_run(Simulation& simulation, const StrainForecast& strain);

}  // namespace solidem

#endif
