// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_REMOVED_ELEMENTS_HPP
#define SOLIDEM_EFFECTS_REMOVED_ELEMENTS_HPP

#include "model/columns.hpp"
#include "model/model.hpp"

namespace solidem {

/// Tells elements that were not removed: those that were stand still, whatever pushes them, as
/// nothing accelerates them.
class PresentElements {
 public:
  explicit PresentElements(const Model& model) : inverse_mass_(model.data(columns::inverse_mass)) {}
  template <class Index>
  bool operator()(Index element) const {
    return inverse_mass_[element] > 0;
  }

 private:
  const double* inverse_mass_;
};

}  // namespace solidem

#endif
