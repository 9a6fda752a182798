// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat that motion makes in each step and elements are given when heat steps: what every such
// effect has in common.
#ifndef SOLIDEM_EFFECTS_DELIVERED_HEAT_HPP
#define SOLIDEM_EFFECTS_DELIVERED_HEAT_HPP

#include "effects/conduction.hpp"

namespace solidem {

/// Gives elements `fraction` times what stands in the column `made`, J, as far as they were not
/// given it before, and counts what their temperatures rose by in the column `given`. What a
/// temperature cannot show of it, for it has no such digits, waits on, so that heat is
/// fraction × made after any number of steps.
void deliver_heat(Model& model, const Conduction& conduction, double fraction, const Column& made,
                  const Column& given);

/// The sum of a column of elements, J.
double sum_of(const Model& model, const Column& column);

/// Enters heat that waits beside that of others: one column of the history, `waiting_heat`.
void observe_waiting_heat(Observation& observation, double heat);

}  // namespace solidem

#endif
