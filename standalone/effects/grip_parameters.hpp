// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of a grip: plain data in SI units, filled by the scene reader and read by
// the effect.
#ifndef SOLIDEM_EFFECTS_GRIP_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_GRIP_PARAMETERS_HPP

#include <array>
#include <string>

#include "model/region.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// What a grip imposes on its elements along one axis.
struct AxisControl {
  enum class Kind { free, displacement, velocity, force };
  Kind kind = Kind::free;
  TimeFunction function;  ///< m, m/s, or N for the whole grip (shared by mass)
};

/// Elements held, moved or loaded together.
struct GripParameters {
  std::string name;
  Region region;
  std::array<AxisControl, 3> axis;
  bool rotation_fixed = true;
};

}  // namespace solidem

#endif
