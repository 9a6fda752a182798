// SPDX-License-Identifier: GPL-2.0-or-later
//
// Tunnelling: an element that moves further than its radius in a step passes others unseen.
#ifndef SOLIDEM_ENGINE_LEAP_HPP
#define SOLIDEM_ENGINE_LEAP_HPP

#include <cstddef>
#include <optional>

#include "model/model.hpp"

namespace solidem {

/// An element that leaps.
struct Leap {
  std::size_t element;
  double radii;  ///< that it moves in a step, against the mean motion of all
};

/// The longest leap of a step, beyond the element's radius, against the mean velocity by mass: a
/// body that flies as a whole leaps past nothing. None where no element leaps.
std::optional<Leap> longest_leap(const Model& model, double time_step);

}  // namespace solidem

#endif
