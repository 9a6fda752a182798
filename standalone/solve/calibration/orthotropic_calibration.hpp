// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which beams, oriented by a grain and reinforced by fibres, make a body with the elastic constants
// of an orthotropic material.
//
// Method: Levenberg and Marquardt on the logarithms of the parameters. The residual of a modulus is
// the logarithm of reached over wanted, that of a Poisson ratio their difference over the wanted;
// each times a weight. Derivatives are exact and cost no equilibrium (stiffness_rate), so an
// iteration is six static strains of each specimen.
#ifndef SOLIDEM_SOLVE_CALIBRATION_ORTHOTROPIC_CALIBRATION_HPP
#define SOLIDEM_SOLVE_CALIBRATION_ORTHOTROPIC_CALIBRATION_HPP

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "solve/calibration/orthotropic_constants.hpp"

namespace solidem {

/// The nine constants in the order E_L, E_R, E_T, G_LR, G_LT, G_RT, ν_LR, ν_LT, ν_RT.
using NineConstants = std::array<double, 9>;
NineConstants nine_constants(const OrthotropicConstants& constants);
inline constexpr std::array<const char*, 9> constant_names{"E_L",  "E_R",   "E_T",   "G_LR", "G_LT",
                                                           "G_RT", "nu_LR", "nu_LT", "nu_RT"};

/// What the body shall have.
struct OrthotropicRequest {
  std::array<std::optional<double>, 9> target;  ///< Pa; Poisson ratios ≠ 0
  /// How much a relative miss of a Young's modulus, a shear modulus, a Poisson ratio counts. The
  /// nine are not free of each other in a network of beams: weights say what gives way.
  std::array<double, 3> weight{4, 1, 0.5};
  double tolerance = 0.02;  ///< a target counts as met when it is missed by less, relative
  int specimens = 1;        ///< packings of one recipe, of which the mean meets the targets
  int iterations = 30;      ///< at most
};

/// One set of parameters that was tried.
struct OrthotropicTrial {
  BeamParameters beams;
  std::vector<OrthotropicConstants> reached;  ///< of each specimen
  double misfit;                              ///< root of the sum of squared weighted residuals
};

struct OrthotropicCalibration {
  BeamParameters beams;     ///< the best found
  NineConstants mean;       ///< of the specimens
  NineConstants deviation;  ///< standard deviation of one specimen; 0 for a single one
  double coupling;          ///< the largest, see OrthotropicConstants
  std::vector<OrthotropicTrial> trials;
  std::vector<std::string> misses;  ///< targets not met, each with what was reached
};

/// Finds E_L, E_R, E_T and the exponent of the beams, their radius ratio and, where the beams have
/// fibres, the fibres' stiffness ratio; all else stays as in `start`, which has an anisotropy. The
/// specimens have their fibres already. `tell` hears of each trial. Throws InputError when no
/// target is given or a specimen is not periodic.
OrthotropicCalibration calibrate_orthotropic(
    const OrthotropicRequest& request, const BeamParameters& start,
    const std::vector<Specimen>& specimens,
    const std::function<void(const OrthotropicTrial&)>& tell = {});

}  // namespace solidem

#endif
