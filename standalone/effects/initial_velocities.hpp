// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of velocities at the start: plain data in SI units, filled by the scene
// reader and read by the effect.
#ifndef SOLIDEM_EFFECTS_INITIAL_VELOCITIES_HPP
#define SOLIDEM_EFFECTS_INITIAL_VELOCITIES_HPP

#include "model/region.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// Elements that start with a velocity.
struct InitialVelocity {
  Region region;
  Vector velocity;      ///< m/s
  Vector stretching{};  ///< 1/s: besides, along x, y, z as far as from the middle of the body
};

}  // namespace solidem

#endif
