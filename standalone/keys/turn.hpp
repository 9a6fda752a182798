// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_TURN_HPP
#define SOLIDEM_KEYS_TURN_HPP

#include "keys/section.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// A turn about an axis: {axis = [x, y, z], angle}, by the right hand.
Rule turn(Quaternion<double>& target);

}  // namespace solidem

#endif
