// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_TESTS_SUPPORT_AXIS_CONTROLS_HPP
#define SOLIDEM_TESTS_SUPPORT_AXIS_CONTROLS_HPP

#include "effects/grip_parameters.hpp"

namespace solidem {

inline AxisControl held() {
  return {AxisControl::Kind::displacement, TimeFunction::constant(0)};
}

/// At v m/s.
inline AxisControl moving(double v) {
  return {AxisControl::Kind::velocity, TimeFunction::constant(v)};
}

}  // namespace solidem

#endif
