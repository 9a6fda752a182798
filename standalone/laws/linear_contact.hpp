// SPDX-License-Identifier: GPL-2.0-or-later
//
// Linear spring–dashpot contact with Coulomb friction.
//
// Source: P. A. Cundall, O. D. L. Strack, Géotechnique 29, 47 (1979).
//
//   F_n = max(0, k_n δ + c_n δ')         the push between i and j; δ their overlap
//   F_t = k_t s,  |F_t| ≤ μ F_n          s: how far j has slid along the surface of i, elastically
//   F_i = −F_n n + F_t,  F_j = −F_i      n from i to j
//
// A contact never pulls: where the dashpot would hold two together that part, the force is none.
// The contact then ends before the overlap does, and the coefficient of restitution e of two free
// spheres, or of a sphere and a tool, which counts as infinitely heavy, is
//   e = exp(−2 ζ arccos ζ / √(1 − ζ²)),  c_n = 2 ζ √(m* k_n),  1/m* = 1/m_i + 1/m_j
// (T. Schwager, T. Pöschel, Granular Matter 9, 465 (2007)). The ratio ζ = −ln e / √(π² + ln² e)
// that is often given holds for a dashpot that pulls until the overlap is gone: with it and no
// pull, spheres part faster than e says.
//
// The spring s is a vector in the tangent plane. It turns with the contact and keeps its length:
// with the normal by the shortest rotation, and about it by the mean spin of the two. Where
// Coulomb's limit cuts it, what is cut off is slip, whose work ½ (F_t,before + F_t,after) · slip is
// friction. In the step in which two meet the tangential motion of the whole step counts, as in
// YADE and LIGGGHTS.
//
// Scheme: leapfrog. The velocity is that half a step before the pose, as in both of these codes, so
// springs and friction are second order in the step. The dashpot acts on the velocity at the time
// of the pose, which is implicit in the pair's own force, and in the step in which two meet for as
// long as they have touched: the restitution is second order as well.
#ifndef SOLIDEM_LAWS_LINEAR_CONTACT_HPP
#define SOLIDEM_LAWS_LINEAR_CONTACT_HPP

#include <cmath>

#include "laws/algebra.hpp"

namespace solidem {

/// What a contact is made of.
template <class Real>
struct LinearContact {
  Real normal_stiffness;      ///< k_n, N/m
  Real tangential_stiffness;  ///< k_t, N/m; 0: no friction
  Real friction;              ///< μ
  Real damping;               ///< c_n, N·s/m: damping_coefficient()
  Real inverse_mass;          ///< 1/m*, 1/kg: sum of those of both; 0 of a tool, or of what is held
};

/// How two bodies stand and move at their contact.
template <class Real>
struct ContactMotion {
  Vector3<Real> normal;    ///< n, unit, from i to j
  Real overlap;            ///< δ, m; negative: apart
  Vector3<Real> velocity;  ///< of j relative to i at the contact point, half a step before, m/s
  Real spin;               ///< mean of both angular velocities, along n, rad/s
  Real time_step;          ///< since the pose before, s; 0 where a run begins
};

/// What a contact remembers from step to step; new where all is zero.
template <class Real>
struct ContactHistory {
  Vector3<Real> normal{};  ///< n of the step before
  Vector3<Real> spring{};  ///< s, m
  Real dashpot{0.0};       ///< part of F_n that is not the spring's, N
};

template <class Real>
struct ContactResponse {
  Vector3<Real> force;           ///< on i, N; on j the opposite, both at the contact point
  ContactHistory<Real> history;  ///< to be kept; all but the normal is zero once they are apart
  Real normal_energy;            ///< ½ k_n δ², J
  Real tangential_energy;        ///< ½ k_t s², J
  Real friction_work;            ///< dissipated since the pose before by slip, J
  Real damping_work;             ///< and by the dashpot, J
};

/// ζ of a coefficient of restitution, 0 < e ≤ 1.
inline double restitution_damping_ratio(double restitution) {
  const double wanted = -std::log(restitution);
  const auto decay = [](double ratio) {
    const double rest = 1 - ratio * ratio;
    if (std::fabs(rest) < 1e-8) return 2 + 4.0 / 3 * (ratio - 1);
    const double root = std::sqrt(std::fabs(rest));
    return 2 * ratio / root * (rest > 0 ? std::acos(ratio) : std::acosh(ratio));
  };
  double low = 0, high = 1;
  while (decay(high) < wanted) high *= 2;
  for (int bisections = 0; bisections < 64; ++bisections) {
    const double middle = 0.5 * (low + high);
    (decay(middle) < wanted ? low : high) = middle;
  }
  return wanted > 0 ? 0.5 * (low + high) : 0;
}

/// c_n, N·s/m, of a damping ratio; `inverse_mass` 1/m*.
template <class Real>
Real damping_coefficient(const Real& ratio, const Real& stiffness, const Real& inverse_mass) {
  using std::sqrt;
  return Real{2.0} * ratio * sqrt(stiffness / inverse_mass);
}

/// A vector of the tangent plane of a normal, turned onto that of another by the shortest rotation.
template <class Real>
constexpr Vector3<Real> onto_tangent_plane(const Vector3<Real>& spring, const Vector3<Real>& before,
                                           const Vector3<Real>& normal) {
  const Real tiny{tiny_square}, one{1.0};
  return spring - (dot(normal, spring) / (one + dot(before, normal) + tiny)) * (before + normal);
}

/// A vector of the tangent plane turned about the normal; the angle, rad, is right to its cube
/// / 12.
template <class Real>
constexpr Vector3<Real> about_normal(const Vector3<Real>& spring, const Vector3<Real>& normal,
                                     const Real& angle) {
  const Real one{1.0}, tangent = Real{0.5} * angle, square = tangent * tangent;
  const Vector3<Real> turned =
      (one - square) * spring + (tangent + tangent) * cross(normal, spring);
  return (one / (one + square)) * turned;
}

/// What the dashpot adds to a spring's push, N, so that both do not pull.
template <class Real>
constexpr Real contact_dashpot(const LinearContact<Real>& contact, const ContactMotion<Real>& at,
                               const Real& closing, const Real& push) {
  const Real none{0.0}, one{1.0}, half{0.5};
  const Real passed = closing * at.time_step;
  // Forces act from half a step before the pose to half a step after. Those that met since the pose
  // before have touched for the second half and for overlap / closing before the pose.
  const auto meets = greater(passed, at.overlap);
  const Real touched =
      select(meets, half + at.overlap / select(meets, passed, one), one) * contact.damping;
  const Real kick = half * at.time_step * contact.inverse_mass;
  const Real dashpot = touched * (closing - kick * push) / (one + kick * touched);
  return select(greater(none, push + dashpot), -push, dashpot);
}

/// Work of slip since the pose before, J. `turned`: the spring of that pose, turned with the
/// contact; `trial`: what it would be now without Coulomb's limit, which keeps the part `kept`.
template <class Real>
constexpr Real slip_work(const Real& tangential_stiffness, const Real& kept,
                         const Vector3<Real>& turned, const Vector3<Real>& trial) {
  const Real half_stiffness = Real{0.5} * tangential_stiffness;
  return half_stiffness * (Real{1.0} - kept) * dot(turned + kept * trial, trial);
}

/// Force of a contact in a pose, and the history that the pose brings. Also to be asked, once, of
/// two that touched before and are apart now: the spring's last energy goes into friction.
template <class Real>
constexpr ContactResponse<Real> linear_contact(const LinearContact<Real>& contact,
                                               const ContactMotion<Real>& at,
                                               const ContactHistory<Real>& before) {
  using std::sqrt;
  const Real tiny{tiny_square}, none{0.0}, one{1.0}, half{0.5};
  const auto touches = greater(at.overlap, none);
  const Real opening = dot(at.velocity, at.normal);
  const Real push = select(touches, contact.normal_stiffness * at.overlap, none);
  const Real dashpot = select(touches, contact_dashpot(contact, at, -opening, push), none);
  const Real normal_force = push + dashpot;

  const Vector3<Real> turned =
      about_normal(onto_tangent_plane(before.spring, before.normal, at.normal), at.normal,
                   at.spin * at.time_step);
  const Vector3<Real> trial = turned + at.time_step * (at.velocity - opening * at.normal);
  const Real trial_force = contact.tangential_stiffness * sqrt(dot(trial, trial));
  const Real limit = contact.friction * normal_force;
  const Real kept = select(greater(trial_force, limit), limit / (trial_force + tiny), one);
  const Vector3<Real> spring = kept * trial;

  const Real half_stiffness = half * contact.tangential_stiffness;
  return {contact.tangential_stiffness * spring - normal_force * at.normal,
          {at.normal, spring, dashpot},
          half * push * at.overlap,
          half_stiffness * dot(spring, spring),
          slip_work(contact.tangential_stiffness, kept, turned, trial),
          half * (before.dashpot + dashpot) * -opening * at.time_step};
}

}  // namespace solidem

#endif
