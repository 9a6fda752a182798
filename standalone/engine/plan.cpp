// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/plan.hpp"

#include "effects/beams.hpp"
#include "effects/conduction.hpp"

namespace solidem {

namespace {

void ask(Plan& plan, const std::string& effect, const std::vector<const Column*>& asked) {
  for (const Column* column : asked) {
    PlannedColumn* planned = nullptr;
    for (PlannedColumn& present : plan.columns)
      if (present.column == column) planned = &present;
    if (planned == nullptr) {
      plan.columns.push_back({column, {}});
      planned = &plan.columns.back();
    }
    planned->asked_by.push_back(effect);
  }
}

std::string beam_kernel(const BeamParameters& beams, bool periodic) {
  std::string kernel = "move_beams";
  if (beams.radius_from == BeamParameters::RadiusFrom::pair) kernel += ", radius from the pair";
  if (periodic) kernel += ", periodic";
  return kernel;
}

}  // namespace

Plan make_plan(const Setup& setup, bool periodic) {
  Plan plan;
  if (setup.beams) {
    plan.effects.push_back({"beams", "[beams]", beam_kernel(*setup.beams, periodic)});
    ask(plan, "beams", Beams::columns(*setup.beams, periodic));
  }
  for (const GripParameters& grip : setup.grips)
    plan.effects.push_back({"grip " + grip.name, "[[grips]]", ""});
  if (setup.conduction) {
    plan.effects.push_back({"conduction", "[conduction]", "conduct"});
    ask(plan, "conduction", Conduction::columns());
  }
  for (const ImposedTemperatureParameters& imposed : setup.temperatures)
    plan.effects.push_back({"temperature " + imposed.name, "[[temperatures]]", ""});
  return plan;
}

}  // namespace solidem
