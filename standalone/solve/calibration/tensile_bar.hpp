// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bar pulled at its ends: what is held and where it is measured. The static and the dynamic
// tension test share it.
#ifndef SOLIDEM_SOLVE_CALIBRATION_TENSILE_BAR_HPP
#define SOLIDEM_SOLVE_CALIBRATION_TENSILE_BAR_HPP

#include <optional>

#include "effects/beam_parameters.hpp"
#include "effects/setup.hpp"
#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

/// How a specimen is pulled. The centres within one mean diameter of either end move along the
/// axis as they are told and are free in all else, so that the bar may thin everywhere.
struct TensileBar {
  Gauge gauge;        ///< axis of the bar; section in which stress and strain are measured
  double grip_depth;  ///< m: one mean diameter
};

/// The bar that a specimen makes: along its longest side, measured in the middle 40 % of it, unless
/// `gauge` says otherwise. Throws InputError when the specimen is periodic (it could not thin) or
/// the gauge reaches into the grips.
TensileBar tensile_bar(const Specimen& specimen, const std::optional<Gauge>& gauge);

/// What a body answers to a pull, in small motion.
struct ElasticConstants {
  double young_modulus;  ///< E, Pa
  double poisson_ratio;  ///< ν, mean of the two lateral directions
};

/// Young's modulus and Poisson's ratio of a bar by one static tension test. `state`, if given, is
/// where the search for equilibrium begins, and receives it: a test with other beams then takes
/// fewer iterations. Throws RunError when the ends do not hang together.
ElasticConstants elastic_constants(const BeamParameters& beams, const Specimen& specimen,
                                   const TensileBar& bar,
                                   std::optional<Equilibrium>* state = nullptr);

}  // namespace solidem

#endif
