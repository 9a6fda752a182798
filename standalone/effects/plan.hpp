// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PLAN_HPP
#define SOLIDEM_EFFECTS_PLAN_HPP

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "effects/effect.hpp"
#include "effects/setup.hpp"
#include "model/columns.hpp"

namespace solidem {

class Assembly;

/// An effect that acts, and why.
struct PlannedEffect {
  std::string name;
  std::string reason;  ///< which section of the scene asks for it
  std::string kernel;  ///< hot loop that it runs in each step; empty: none
  Phase phase;
  std::function<std::unique_ptr<Effect>(Assembly&)> make;
};

/// A column that is allocated, and for which effects.
struct PlannedColumn {
  const Column* column;
  std::vector<std::string> asked_by;
};

/// What a setup calls for: these effects act and these columns exist, and nothing else.
struct Plan {
  bool periodic = false;  ///< the specimen is, in some direction
  std::vector<PlannedEffect> effects;
  std::vector<PlannedColumn> columns;
  /// What a user may expect of these effects together and would not get: told by run and explain.
  std::vector<std::string> notes;

  bool has(const Column& column) const;
  /// Columns that an effect of this name works on.
  void ask(const std::string& effect, const std::vector<const Column*>& columns);
};

/// The plan of a setup; `periodic`: the specimen is, in some direction.
Plan make_plan(const Setup& setup, bool periodic);

}  // namespace solidem

#endif
