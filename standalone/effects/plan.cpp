// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/plan.hpp"

#include <algorithm>

#include "effects/effect_kind.hpp"

namespace solidem {

bool Plan::has(const Column& column) const {
  return std::any_of(columns.begin(), columns.end(),
                     [&column](const PlannedColumn& present) { return present.column == &column; });
}

void Plan::ask(const std::string& effect, const std::vector<const Column*>& asked) {
  for (const Column* column : asked) {
    auto planned =
        std::find_if(columns.begin(), columns.end(),
                     [column](const PlannedColumn& present) { return present.column == column; });
    if (planned == columns.end()) planned = columns.insert(planned, {column, {}});
    planned->asked_by.push_back(effect);
  }
}

Plan make_plan(const Setup& setup, bool periodic) {
  Plan plan;
  plan.periodic = periodic;
  for (const EffectKind& kind : effect_kinds())
    if (kind.plan) kind.plan(setup, plan);
  return plan;
}

}  // namespace solidem
