// SPDX-License-Identifier: GPL-2.0-or-later
//
// What two elements do to each other, whichever central law acts between them:
//   F(δ) = 0                                        δ ≥ δ_lim = α (R_i + R_j)
//   F(δ) = F_law(δ)                                 δ_min ≤ δ < δ_lim
//   F(δ) = F_law(δ_min) + K(δ_min) (δ_min − δ)      δ < δ_min = (1 − a) δ_eq
// Source: Gado 2017, section 2.4 takes the stiffness at the deepest overlap a that a run allows for
// the time step. Going on with that stiffness where a run exceeds it keeps the step stable however
// near two elements come, and the force finite where a law has a pole. Runs say how deep they went.
// K = −dF_law/dδ, by a dual number. Potentials are counted from the range, where they end.
//
// Dissipation (Gado 2017, equation 4): −c (n · ΔV) n within the range, n the unit vector from j to
// i, ΔV = V_i − V_j.
#ifndef SOLIDEM_LAWS_CENTRAL_INTERACTION_HPP
#define SOLIDEM_LAWS_CENTRAL_INTERACTION_HPP

#include "laws/central_law.hpp"
#include "laws/dual.hpp"

namespace solidem {

/// Force of a law and its stiffness −dF/dδ.
struct ForceAndStiffness {
  double force;      ///< N
  double stiffness;  ///< N/m
};

/// Of a law at a distance, m, that is taken as it is.
template <class Law>
ForceAndStiffness bare_force(const Law& law, double distance, double equilibrium) {
  const Dual force = law.force(separation(Dual(distance, 1), Dual(equilibrium)));
  return {force.value, -force.derivative};
}

/// The same inside the range, with the continuation below (1 − interpenetration) δ_eq.
template <class Law>
ForceAndStiffness central_force(const Law& law, double interpenetration, double distance,
                                double equilibrium) {
  const double nearest = (1 - interpenetration) * equilibrium;
  if (distance >= nearest) return bare_force(law, distance, equilibrium);
  ForceAndStiffness there = bare_force(law, nearest, equilibrium);
  there.force += there.stiffness * (nearest - distance);
  return there;
}

/// Whether a law pushes apart all the way down to this overlap, as it must to be followed so far; a
/// shifted law may have a pole before.
template <class Law>
bool repels_down_to(const Law& law, double interpenetration) {
  constexpr int places = 64;
  for (int k = 1; k <= places; ++k) {
    const double force = law.force(separation(1 - interpenetration * k / places, 1.0));
    if (interpenetration > 0 && !(force > 0 && force < 1e300)) return false;
  }
  return true;
}

/// Potential inside the range, J, counted from the range δ_lim, m.
template <class Law>
double central_potential(const Law& law, double interpenetration, double range, double distance,
                         double equilibrium) {
  const double end = law.potential(separation(range, equilibrium));
  const double nearest = (1 - interpenetration) * equilibrium;
  if (distance >= nearest) return law.potential(separation(distance, equilibrium)) - end;
  const ForceAndStiffness there = bare_force(law, nearest, equilibrium);
  const double deeper = nearest - distance;
  return law.potential(separation(nearest, equilibrium)) - end +
         deeper * (there.force + 0.5 * there.stiffness * deeper);
}

/// F/δ-like factor of dissipation: n · ΔV times −c is a force along n. `chord` from i to j,
/// `approach` = V_i − V_j; result: scalar force on i along n, N, positive when it pushes apart.
template <class Real>
constexpr Real dissipative_force(const Real& coefficient, const Vector3<Real>& chord,
                                 const Real& inverse_distance, const Vector3<Real>& approach) {
  // n = −chord/δ, so −c (n · ΔV) = c (chord · ΔV)/δ.
  return coefficient * inverse_distance * dot(chord, approach);
}

}  // namespace solidem

#endif
