// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/damage.hpp"

#include <algorithm>

namespace solidem {

Damage::Damage(const DamageParameters& parameters, CentralForces& forces, Model& model)
    : parameters_(parameters), forces_(forces), model_(model) {
  if (parameters_.minimal_neighbours > 0) had_ = forces_.neighbours_within_range();
  if (parameters_.lip) forces_.find_crack_lips(*parameters_.lip);
}

void Damage::look() {
  ++steps_;
  const bool looks = parameters_.lip && steps_ % parameters_.every == 0;
  const bool removes =
      parameters_.minimal_neighbours > 0 && steps_ % parameters_.removal_every == 0;
  if (!looks && !removes) return;
  forces_.keep_neighbours();
  if (removes) remove_lonely();
  if (looks) forces_.find_crack_lips(*parameters_.lip);
}

void Damage::remove_lonely() {
  const std::vector<int> have = forces_.neighbours_within_range();
  for (std::size_t i = 0; i < have.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    if (have[i] >= std::min(parameters_.minimal_neighbours, had_[i]) || is_removed(element))
      continue;
    removed_.insert(std::upper_bound(removed_.begin(), removed_.end(), element), element);
    forces_.exclude(element);
    model_.data(columns::inverse_mass)[i] = 0;
    for (int axis = 0; axis < 3; ++axis)
      model_.data(columns::velocity)[Model::at(columns::velocity, i, axis)] = 0;
  }
}

bool Damage::is_removed(std::int32_t element) const {
  return std::binary_search(removed_.begin(), removed_.end(), element);
}

void Damage::observe(const Model& model, Observation& observation) const {
  if (parameters_.lip) {
    const double* barycentre = model.data(columns::barycentre);
    double lips = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) {
      const double* b = barycentre + 4 * i;
      if (b[0] != 0 || b[1] != 0 || b[2] != 0) ++lips;
    }
    observation.add("lips", lips);
  }
  if (parameters_.minimal_neighbours > 0)
    observation.add("removed", static_cast<double>(removed_.size()));
}

std::vector<double> Damage::save() const {
  std::vector<double> saved{static_cast<double>(steps_)};
  saved.insert(saved.end(), removed_.begin(), removed_.end());
  return saved;
}

void Damage::restore(const std::vector<double>& saved) {
  steps_ = static_cast<std::int64_t>(saved.at(0));
  removed_.clear();
  for (std::size_t k = 1; k < saved.size(); ++k) {
    const auto element = static_cast<std::int32_t>(saved[k]);
    removed_.push_back(element);
    model_.data(columns::inverse_mass)[static_cast<std::size_t>(element)] = 0;
  }
}

}  // namespace solidem
