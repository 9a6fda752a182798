// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_MODES_HPP
#define SOLIDEM_SOLVE_STATICS_MODES_HPP

#include <vector>

#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

/// A natural vibration of a body.
struct Mode {
  double frequency;                  ///< Hz
  std::vector<Vector> displacement;  ///< of each element; the largest of all is 1
  std::vector<Vector> rotation;      ///< of each element, rad for a largest displacement of 1 m
  double residual;                   ///< |K x − ω² M x| / |K x|
};

struct ModesOptions {
  double tolerance = 1e-9;  ///< of the squared frequencies, relative
  LinearMethod method = LinearMethod::automatic;
};

/// The `count` lowest natural vibrations of a body about rest, or about an equilibrium. What is
/// constrained stands still. `mass` (kg) and `inertia` (kg·m²) of each element are lumped at its
/// centre. By a block Krylov space of K⁻¹ M with full orthogonalisation, and Ritz values in it; a
/// frequency may be found several times only by as many as a block is wide (4).
///
/// Throws InputError when the body is not held or has fewer vibrations than asked for, RunError
/// when the state is no stable equilibrium or the search does not settle.
std::vector<Mode> lowest_modes(const BeamNetwork& network,
                               const std::vector<Constraint>& constraints,
                               const std::vector<double>& mass, const std::vector<double>& inertia,
                               int count, const Equilibrium* about = nullptr,
                               const ModesOptions& options = {});

}  // namespace solidem

#endif
