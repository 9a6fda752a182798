// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_REMOVED_ELEMENTS_HPP
#define SOLIDEM_EFFECTS_REMOVED_ELEMENTS_HPP

#include "model/columns.hpp"
#include "model/model.hpp"

namespace solidem {

/// Whether an element was not removed: those that were stand still, whatever pushes them, as
/// nothing accelerates them.
template <class Index>
bool is_present(const Model& model, Index element) {
  return model.data(columns::inverse_mass)[element] > 0;
}

}  // namespace solidem

#endif
