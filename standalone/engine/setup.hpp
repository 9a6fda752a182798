// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_SETUP_HPP
#define SOLIDEM_ENGINE_SETUP_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "effects/parameters.hpp"
#include "model/material.hpp"

namespace solidem {

/// A section of the specimen whose stress and strain are measured.
struct Gauge {
  int axis = 0;
  double lower = 0, upper = 0;  ///< along the axis, m
};

/// A quantity followed at a point.
struct Sensor {
  /// Of the nearest element, or from a linear fit through the elements round the point.
  enum class Sampling { nearest, fit };
  enum class Quantity { temperature, position, displacement, velocity };
  std::string name;
  Vector point;  ///< m
  Quantity quantity = Quantity::temperature;
  Sampling sampling = Sampling::nearest;
};

/// How long to run and how finely. One of `duration` and `steps` is given; of `time_step` and
/// `time_step_ratio` at most one.
struct RunControl {
  std::optional<double> duration;         ///< s
  std::optional<std::int64_t> steps;      ///< number of time steps
  std::optional<double> time_step;        ///< s
  std::optional<double> time_step_ratio;  ///< of the stiffness criteria; default 0.3
  std::optional<std::int64_t>
      observe_every;  ///< steps between two observations; default: 200 in all
};

/// What is written besides the history and the summary.
struct OutputControl {
  std::int64_t frames = 10;           ///< trajectory frames besides the first
  std::int64_t checkpoint_every = 0;  ///< steps; 0: only at the end and when interrupted
};

/// Everything a simulation does to a specimen: the effects the scene names and nothing else.
struct Setup {
  std::vector<Material> materials;
  std::optional<BeamParameters> beams;
  std::optional<PlasticityParameters> plasticity;
  std::optional<RuptureParameters> rupture;
  std::optional<ContactParameters> contact;
  std::optional<CentralForceParameters> central_forces;
  std::optional<DamageParameters> damage;
  std::optional<ConductionParameters> conduction;
  std::vector<GripParameters> grips;
  std::vector<ImposedTemperatureParameters> temperatures;
  std::vector<HeatFluxParameters> heat_fluxes;
  std::vector<ConvectionParameters> convections;
  std::vector<HeatSourceParameters> heat_sources;
  std::vector<InitialVelocity> initial_velocities;
  std::vector<Sensor> sensors;
  std::optional<Gauge> gauge;
  RunControl run;
  OutputControl output;

  /// Whether elements move.
  bool has_motion() const { return beams || central_forces; }
};

}  // namespace solidem

#endif
