// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_TENSION_TEST_HPP
#define SOLIDEM_ENGINE_TENSION_TEST_HPP

#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/setup.hpp"
#include "solve/calibration/tensile_bar.hpp"

namespace solidem {

/// What the bonds of a body are.
struct BondParameters {
  BeamParameters beams;
  std::optional<PlasticityParameters> plasticity;
  std::optional<RuptureParameters> rupture;
  std::optional<ContactParameters> contact;
};

/// The hardening of bonds, if they flow and it is linear; else null.
inline const LinearHardening* linear_hardening(const BondParameters& bonds) {
  return bonds.plasticity ? std::get_if<LinearHardening>(&bonds.plasticity->hardening) : nullptr;
}

/// The strain at which bonds break, if there is one.
inline std::optional<double> rupture_strain(const BondParameters& bonds) {
  const auto* law = bonds.rupture ? std::get_if<StrainLimit>(&bonds.rupture->law) : nullptr;
  return law != nullptr && law->strain < unlimited ? std::optional<double>(law->strain)
                                                   : std::nullopt;
}

/// How a bar is pulled until it breaks, or compressed.
struct TensionTest {
  TensileBar bar;
  std::vector<Material> materials;
  ElasticConstants elastic;  ///< of the bar, from the static test
  double speed = 0;          ///< of one end away from the other, m/s; below 0: towards it
  double time_step_ratio = 0.5;
  double fine_elongation = 0;     ///< up to which the curve has a point every 1e-4, then every 1e-3
  double longest_elongation = 0;  ///< at which the test ends, if the bar has not broken before
  double longest_strain = HUGE_VAL;  ///< of the gauge section, at which it ends as well
};

/// One instant of a test; of a bar that is compressed all count above 0.
struct TensionPoint {
  double elongation;  ///< of the length between the ends that are held
  double strain;      ///< of the gauge section
  double stress;      ///< engineering, of the gauge section, Pa
};

/// What a test has shown; none: the test ended before.
struct TensionFigures {
  std::optional<double> yield_stress;    ///< σ_0.2, at 0.2 % of lasting strain, Pa
  std::optional<double> peak_stress;     ///< largest engineering stress, Pa
  std::optional<double> rupture_strain;  ///< elongation at which half of the peak is left
};

struct TensionCurve {
  std::vector<TensionPoint> points;
  TensionFigures figures;
};

/// Pulls a bar, which starts in steady stretching (every centre at the velocity of a uniform
/// deformation) so that no wave runs through it, until it has lost half of its largest stress.
/// Throws what Simulation throws.
TensionCurve pull(const BondParameters& bonds, const Specimen& specimen, const TensionTest& test);

/// The figures of a curve of points in order.
TensionFigures figures_of(const std::vector<TensionPoint>& points, double young_modulus);

}  // namespace solidem

#endif
