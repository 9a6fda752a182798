// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_PLAN_HPP
#define SOLIDEM_ENGINE_PLAN_HPP

#include <string>
#include <vector>

#include "effects/beams.hpp"
#include "engine/setup.hpp"
#include "model/columns.hpp"

namespace solidem {

/// An effect that acts, and why.
struct PlannedEffect {
  std::string name;
  std::string reason;  ///< which section of the scene asks for it
  std::string kernel;  ///< hot loop that it runs in each step; empty: none
};

/// A column that is allocated, and for which effects.
struct PlannedColumn {
  const Column* column;
  std::vector<std::string> asked_by;
};

/// What a setup calls for: these effects act and these columns exist, and nothing else.
struct Plan {
  std::vector<PlannedEffect> effects;
  std::vector<PlannedColumn> columns;
};

/// What a setup asks of its bonds; it must have some.
BeamDemands demands_of(const Setup& setup);

/// The plan of a setup; `periodic`: the specimen is, in some direction.
Plan make_plan(const Setup& setup, bool periodic);

}  // namespace solidem

#endif
