// SPDX-License-Identifier: GPL-2.0-or-later
//
// The hot loops, compiled once for each instruction set and chosen at run time.
#ifndef SOLIDEM_EFFECTS_KERNELS_KERNELS_HPP
#define SOLIDEM_EFFECTS_KERNELS_KERNELS_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "laws/beam.hpp"

namespace solidem {

/// Columns of beam-bonded elements in motion, as the kernels read and write them.
struct BeamMotion {
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double* pose;
  double* next_pose;
  double* velocity;
  double* angular_velocity;
  const double* inverse_mass;
  const double* inverse_inertia;
  const double* rest_direction;
  const double* rest_length;
  const double* bond_radius;      ///< null: `rigidity` holds for every bond
  const double* image_shift;      ///< null: no periodic direction
  BeamRigidity<double> rigidity;  ///< of a beam of radius 1 m where `bond_radius` is given
  double kick;                    ///< s, by which the velocities move on
  double drift;                   ///< s, by which the poses move on
};

/// Columns of conducting elements.
struct HeatFlow {
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double* temperature;
  double* next_temperature;
  const double* inverse_heat_capacity;
  const double* conductance;
  double time_step;
};

/// Columns of conducting elements whose power is asked for, and not a step.
struct HeatPower {
  const std::uint32_t* first_row;
  const std::int32_t* neighbour;
  const double* temperature;
  double* power;
  const double* conductance;         ///< null: from the conductivities of the elements
  const double* conductivity;        ///< of each element
  const double* conduction_length;   ///< of each pair
  const double* contact_resistance;  ///< of each pair; null: none
};

/// One instruction set's kernels. Each treats the blocks [first, last).
struct Kernels {
  const char* instruction_set;
  /// Beam loads on every element, then velocity += kick · load / mass, pose += drift · velocity.
  void (*move_beams)(const BeamMotion&, std::size_t first, std::size_t last);
  /// Explicit Euler step of the temperatures.
  void (*conduct)(const HeatFlow&, std::size_t first, std::size_t last);
  /// Power conducted into each element.
  void (*conducted_power)(const HeatPower&, std::size_t first, std::size_t last);
};

/// The kernels that this machine can run, the best first.
std::vector<const Kernels*> usable_kernels();

/// The kernels for this machine's best instruction set; the environment variable
/// SOLIDEM_INSTRUCTION_SET (baseline, x86_64_v3, x86_64_v4) asks for another.
/// Throws InputError when it names one that is unknown or that this machine lacks.
const Kernels& kernels();

}  // namespace solidem

#endif
