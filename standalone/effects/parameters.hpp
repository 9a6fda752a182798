// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of each effect: plain data, in SI units, filled by the scene reader and read
// by the effects.
#ifndef SOLIDEM_EFFECTS_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_PARAMETERS_HPP

#include <array>
#include <string>

#include "model/region.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// Elastic beam bonds.
struct BeamParameters {
  /// What the radius of a beam is a multiple of.
  enum class RadiusFrom {
    mean,  ///< the mean radius R_m of the specimen
    pair   ///< (R_i + R_j) / 2 of the two elements
  };
  double young_modulus = 0;  ///< E of the beams (microscopic), Pa
  double shear_modulus = 0;  ///< G of the beams (microscopic), Pa
  double radius_ratio = 0;   ///< r̃
  RadiusFrom radius_from = RadiusFrom::mean;
};

/// Heat conduction between bonded elements.
struct ConductionParameters {
  enum class Law { platonic };
  Law law = Law::platonic;
  double initial_temperature = 0;  ///< K
};

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

/// Elements whose temperature is imposed.
struct ImposedTemperatureParameters {
  std::string name;
  Region region;
  TimeFunction temperature;  ///< K
};

/// Elements that start with a velocity.
struct InitialVelocity {
  Region region;
  Vector velocity;  ///< m/s
};

}  // namespace solidem

#endif
