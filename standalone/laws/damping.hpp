// SPDX-License-Identifier: GPL-2.0-or-later
//
// Damping of motion against the frame of reference: viscous damping, and Cundall's local
// non-viscous damping (P. A. Cundall, Distinct element models of rock and soil structure, 1987).
//
//   viscous  F = −c m v      M = −c I ω      c in 1/s
//   local    F = −α |F_i| sgn(v_i)            along each axis; F_i all other forces
//
// Local damping of a free fall leaves (1 − α) g; at rest neither leaves a force.
#ifndef SOLIDEM_LAWS_DAMPING_HPP
#define SOLIDEM_LAWS_DAMPING_HPP

#include <cmath>

#include "laws/algebra.hpp"

namespace solidem {

/// What viscous damping leaves of a velocity after a time: exp(−c t), exact for a constant c.
inline double viscous_decay(double rate, double time) {
  return std::exp(-rate * time);
}

/// The change that local damping makes to a component of velocity which other forces bring from
/// `before` to `after` in a kick, m/s; the sign is that of the velocity in the middle of the kick,
/// as in YADE's NewtonIntegrator.
template <class Real>
Real local_damping(const Real& coefficient, const Real& before, const Real& after) {
  using std::abs;
  const Real none{0.0}, middle = before + after, change = coefficient * abs(after - before);
  return select(greater(middle, none), -change, select(greater(none, middle), change, none));
}

}  // namespace solidem

#endif
