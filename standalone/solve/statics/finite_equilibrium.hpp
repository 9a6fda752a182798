// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_FINITE_EQUILIBRIUM_HPP
#define SOLIDEM_SOLVE_STATICS_FINITE_EQUILIBRIUM_HPP

#include <functional>

#include "solve/statics/static_equilibrium.hpp"

namespace solidem {

struct FiniteOptions : EquilibriumOptions {
  double first_step = 0.25;        ///< fraction of the loads and displacements in the first step
  double least_step = 1.0 / 4096;  ///< below which the search gives up
  int most_corrections = 40;       ///< in a step, before it is halved
  /// Told after each step: share of the loads, corrections so far, residual.
  std::function<void(double fraction, int corrections, double residual)> report;
};

/// Displacements and turns of any size, elastic beams. Loads, displacements and turns grow in
/// proportion from rest; each step is corrected by Newton's method with the exact tangent, and no
/// correction is accepted that raises the potential energy. Forces and moments keep their
/// direction. Where all turns of an element are held, `value` is its rotation vector; where some
/// are, the turn about a held axis is that of its spin.
///
/// Throws InputError as small_equilibrium does, and RunError, which says how far it came, where no
/// equilibrium was found.
Equilibrium finite_equilibrium(const BeamNetwork& network,
                               const std::vector<Constraint>& constraints,
                               const std::vector<ElementLoad>& loads,
                               const FiniteOptions& options = {});

}  // namespace solidem

#endif
