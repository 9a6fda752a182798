// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_BEAMS_HPP
#define SOLIDEM_EFFECTS_BEAMS_HPP

#include <vector>

#include "effects/effect.hpp"
#include "effects/parameters.hpp"
#include "laws/beam.hpp"

namespace solidem {

/// Elements in motion under elastic beam bonds: laws/beam.hpp, velocity Verlet with
/// rotations.
class Beams : public Effect {
 public:
  /// Columns that the effect needs.
  static std::vector<const Column*> columns(const BeamParameters& parameters, bool periodic);

  /// Bonds are made at the specimen's rest positions, elements at rest. `mass` per element, kg.
  Beams(const BeamParameters& parameters, const std::vector<double>& mass, Model& model);

  /// min over bonds of sqrt(m/k_axial), sqrt(J/k_bend), sqrt(J/k_tors), with m and J of the lighter
  /// end, k_axial = ES/l, k_bend = EI/l, k_tors = GI_0/l.
  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const;

  void advance(Model& model, const Step& step) override;

  /// Loads, velocities and elastic energy.
  void observe(const Model& model, Observation& observation) const override;

  /// A bond at one instant, seen from element i.
  struct Bond {
    std::int32_t i, j;
    BeamRigidity<double> rigidity;
    double rest_length;
    BeamPose<double> pose;
    BeamLoad<double> load() const { return beam_load(rigidity, rest_length, pose); }
    double energy() const { return beam_energy(rigidity, rest_length, pose); }
  };

  /// The bond in a slot.
  Bond bond(const Model& model, std::int32_t i, std::int32_t j, std::size_t row, int lane) const;

 private:
  BeamRigidity<double>
      rigidity_;  ///< of every beam, or of radius 1 m where radii depend on the pair
};

}  // namespace solidem

#endif
