// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PAIR_LOADS_HPP
#define SOLIDEM_EFFECTS_PAIR_LOADS_HPP

#include <cstdint>
#include <functional>

#include "model/model.hpp"

namespace solidem {

/// What two neighbours do to each other. An element and its own image are a pair.
struct PairLoad {
  std::int32_t i, j;
  Vector chord;  ///< at rest, from the centre of i to that of j, or to the image of it that acts, m
  Vector force;  ///< on i, N; on j the opposite
  Vector moment;  ///< on i, N·m
};

/// Called for one pair.
using PairVisit = std::function<void(const PairLoad&)>;

/// An effect that acts between elements.
class ActsBetweenElements {
 public:
  ActsBetweenElements() = default;
  ActsBetweenElements(const ActsBetweenElements&) = default;
  ActsBetweenElements& operator=(const ActsBetweenElements&) = default;
  virtual ~ActsBetweenElements() = default;

  /// Calls visit once for each pair that acts.
  virtual void for_each_pair(const Model& model, const PairVisit& visit) const = 0;

  /// Whether elements that no pair joins yet may meet by it.
  virtual bool lets_elements_meet() const { return false; }
};

}  // namespace solidem

#endif
