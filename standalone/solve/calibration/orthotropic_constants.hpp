// SPDX-License-Identifier: GPL-2.0-or-later
//
// The elastic constants of a periodic bonded body, from six static strains.
//
// A periodic cell is strained by one unit component after the other; its elements move and turn
// until they are at rest, and the mean stress is a column of the body's stiffness. The cell has no
// surface, so nothing is averaged away and nothing depends on a gauge.
#ifndef SOLIDEM_SOLVE_CALIBRATION_ORTHOTROPIC_CONSTANTS_HPP
#define SOLIDEM_SOLVE_CALIBRATION_ORTHOTROPIC_CONSTANTS_HPP

#include <array>

#include "laws/oriented_modulus.hpp"
#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

/// A tensor of fourth order in Voigt's notation: LL, RR, TT, RT, LT, LR; shear strains are
/// engineering ones (twice the tensor's).
using Matrix6 = std::array<std::array<double, 6>, 6>;

/// The inverse of a matrix that is symmetric and positive definite; throws RunError when it is not.
Matrix6 inverse(const Matrix6& matrix);

/// Stiffness of a body in the axes of its grain, and the six states that it was measured in.
struct EffectiveStiffness {
  GrainAxes<double> axes;
  Matrix6 stiffness;                    ///< symmetric, Pa
  std::array<Equilibrium, 6> strained;  ///< under a unit strain each
  double asymmetry;  ///< before it was made symmetric: largest difference over largest entry
};

/// Strains the body six times. `guess`: the states of a body that differs little. Throws InputError
/// when the specimen is not periodic along all three axes, RunError when the body has no stiffness.
EffectiveStiffness effective_stiffness(const BeamNetwork& network, const GrainAxes<double>& axes,
                                       const EffectiveStiffness* guess = nullptr);

/// The derivative of a body's stiffness by a parameter of its beams, exact, without another
/// equilibrium: in the states measured the energy is stationary, so only the bonds' own stiffness
/// changes. `rigidity_rate`: derivative of each bond's rigidity by the parameter. Pa per unit of
/// the parameter.
Matrix6 stiffness_rate(const BeamNetwork& network, const EffectiveStiffness& measured,
                       const std::vector<BeamRigidity<double>>& rigidity_rate);

/// What engineers call a material of three perpendicular planes of symmetry.
struct OrthotropicConstants {
  std::array<double, 3> young_modulus;  ///< E_L, E_R, E_T, Pa
  std::array<double, 3> shear_modulus;  ///< G_LR, G_LT, G_RT, Pa
  /// ν_LR, ν_LT, ν_RT: contraction along the second axis over extension along the first, under
  /// tension along the first.
  std::array<double, 3> poisson_ratio;
  /// How far the body is from such a material: the largest |S_ab| / sqrt(S_aa S_bb) that would be
  /// zero in one; 0 to 1.
  double coupling;
};
OrthotropicConstants orthotropic_constants(const Matrix6& stiffness);

/// Young's modulus along a unit direction given in the axes (L, R, T): 1 / (v · S v), v = (n_L²,
/// n_R², n_T², n_R n_T, n_L n_T, n_L n_R). Exact for any anisotropy.
double young_modulus_along(const Vector& direction, const Matrix6& compliance);

}  // namespace solidem

#endif
