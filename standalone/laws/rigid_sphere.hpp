// SPDX-License-Identifier: GPL-2.0-or-later
//
// Motion of a rigid sphere: its inertia is isotropic, so its angular velocity obeys J dω/dt = M in
// world axes, and a constant ω turns it by exactly exp(ω Δt).
#ifndef SOLIDEM_LAWS_RIGID_SPHERE_HPP
#define SOLIDEM_LAWS_RIGID_SPHERE_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// Moment of inertia of a homogeneous sphere about its centre, kg·m².
template <class Real>
constexpr Real sphere_inertia(const Real& mass, const Real& radius) {
  return Real{0.4} * mass * radius * radius;
}

/// The orientation after a time step at constant angular velocity ω (world axes, rad/s).
/// Power series of cos and sin(φ)/φ of the half angle φ: accurate to round-off for turns of up to
/// 0.8 rad a step; the result is normalised, so it stays a rotation for any ω.
template <class Real>
constexpr Quaternion<Real> turn(const Quaternion<Real>& orientation, const Vector3<Real>& omega,
                                const Real& time_step) {
  using std::sqrt;
  const Vector3<Real> half = (Real{0.5} * time_step) * omega;
  const Real y = dot(half, half);
  const Real one{1.0};
  const Real cosine =
      one -
      y * (Real{1.0 / 2} -
           y * (Real{1.0 / 24} -
                y * (Real{1.0 / 720} - y * (Real{1.0 / 40320} - y * (Real{1.0 / 3628800} -
                                                                     y * Real{1.0 / 479001600})))));
  const Real sine_over_angle =
      one - y * (Real{1.0 / 6} -
                 y * (Real{1.0 / 120} -
                      y * (Real{1.0 / 5040} -
                           y * (Real{1.0 / 362880} -
                                y * (Real{1.0 / 39916800} - y * Real{1.0 / 6227020800.0})))));
  const Quaternion<Real> q = Quaternion<Real>{cosine, sine_over_angle * half} * orientation;
  const Real scale = one / sqrt(q.w * q.w + dot(q.v, q.v));
  return {scale * q.w, scale * q.v};
}

}  // namespace solidem

#endif
