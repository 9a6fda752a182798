// SPDX-License-Identifier: GPL-2.0-or-later
//
// Damping of a beam bond by dashpots beside each of its modes, all with one critical ratio.
//
// Source: the modes are those of laws/beam.hpp in small motion; a dashpot c = 2 ζ √(k m*) beside a
// spring k that holds a mass m* lets it swing as e^(−ζωt), ω² = k/m*.
//
// Symbols
//   n      unit chord from element i to element j, L its length                       [m]
//   v_j − v_i, ω_i, ω_j    motion of the two elements                                 [m/s, rad/s]
//   mode     rate                                stiffness k      1/m*
//   axial    l' = n·(v_j − v_i)                  k_a              1/m_i + 1/m_j
//   opening  φ' = P (ω_j − ω_i)                  k_b/2 = E I/l    1/J_i + 1/J_j
//   shear    ψ' = ½ P (ω_i + ω_j) − n × (v_j − v_i)/L
//                                                6 k_s            (1/J_i + 1/J_j)/4
//                                                                 + (1/m_i + 1/m_j)/l²
//   twist    τ' = n·(ω_j − ω_i)                  k_t              1/J_i + 1/J_j
// with P = 1 − n nᵀ and k_a, k_b, k_s, k_t as in laws/beam.hpp.
//
// The loads are the gradient of half the power c_a l'² + c_o φ'² + c_s ψ'² + c_t τ'² that they
// take: they sum to no force and no moment, and a rigid motion meets none. Between two equal
// elements the modes are apart, and each decays as it should.
//
// Velocities that are known half a step before a pose alone are led on to it along their last
// change (velocity_at_pose), so that the whole is of second order in the step. A step Δt is stable
// when Δt² ω² + 4 Δt γ <= 4 for the largest rate γ of all dashpots together.
#ifndef SOLIDEM_LAWS_BOND_DAMPING_HPP
#define SOLIDEM_LAWS_BOND_DAMPING_HPP

#include "laws/beam.hpp"

namespace solidem {

/// One number for each mode of a bond: stiffness [N/m, N·m] or dashpot [N·s/m, N·m·s].
template <class Real>
struct BondModeFactors {
  Real axial, opening, shear, twist;
};

/// How light the two elements of a bond are, together.
template <class Real>
struct BondInertia {
  Real inverse_mass;     ///< 1/m_i + 1/m_j, 1/kg
  Real inverse_inertia;  ///< 1/J_i + 1/J_j, 1/(kg·m²)
};

/// Stiffness of each mode.
template <class Real>
constexpr BondModeFactors<Real> bond_mode_stiffness(const BeamRigidity<Real>& rigidity,
                                                    const Real& rest_length) {
  const Real per_length = Real{1.0} / rest_length;
  return {rigidity.axial * per_length, Real{0.5} * rigidity.bending * per_length,
          Real{6.0} * rigidity.shear * per_length, rigidity.torsion * per_length};
}

/// 1/m* of each mode.
template <class Real>
constexpr BondModeFactors<Real> bond_mode_lightness(const BondInertia<Real>& inertia,
                                                    const Real& rest_length) {
  const Real per_length = Real{1.0} / rest_length;
  return {inertia.inverse_mass, inertia.inverse_inertia,
          Real{0.25} * inertia.inverse_inertia + inertia.inverse_mass * per_length * per_length,
          inertia.inverse_inertia};
}

/// The dashpot of a mode whose damping has this critical ratio: 2 ζ k / ω, ω² = k/m*.
template <class Real>
Real dashpot(const Real& critical_ratio, const Real& stiffness, const Real& lightness) {
  return Real{2.0} * critical_ratio * stiffness *
         inverse_sqrt(stiffness * lightness + Real{tiny_square});
}

/// The dashpots of a bond whose damping has this critical ratio.
template <class Real>
BondModeFactors<Real> bond_dashpots(const Real& critical_ratio, const BeamRigidity<Real>& rigidity,
                                    const Real& rest_length, const BondInertia<Real>& inertia) {
  const BondModeFactors<Real> k = bond_mode_stiffness(rigidity, rest_length);
  const BondModeFactors<Real> light = bond_mode_lightness(inertia, rest_length);
  return {dashpot(critical_ratio, k.axial, light.axial),
          dashpot(critical_ratio, k.opening, light.opening),
          dashpot(critical_ratio, k.shear, light.shear),
          dashpot(critical_ratio, k.twist, light.twist)};
}

/// Motion of the two elements of a bond.
template <class Real>
struct BondMotion {
  Vector3<Real> approach;        ///< v_j − v_i, m/s
  Vector3<Real> spin_i, spin_j;  ///< ω_i, ω_j, rad/s
};

/// What dashpots do.
template <class Real>
struct DashpotAction {
  BeamLoad<Real> load;
  Real power;  ///< that they take, W
};

template <class Real>
constexpr DashpotAction<Real> bond_damping(const BondModeFactors<Real>& dashpots,
                                           const Vector3<Real>& chord,
                                           const BondMotion<Real>& motion) {
  const Real half{0.5};
  const Real inverse_length = inverse_sqrt(dot(chord, chord) + Real{tiny_square});
  const Vector3<Real> n = inverse_length * chord;
  const Vector3<Real> difference = motion.spin_j - motion.spin_i;
  const Vector3<Real> mean = half * (motion.spin_i + motion.spin_j);
  const Real lengthening = dot(n, motion.approach);
  const Real twisting = dot(n, difference);
  const Vector3<Real> opening = difference - twisting * n;
  const Vector3<Real> shearing =
      mean - dot(n, mean) * n - inverse_length * cross(n, motion.approach);

  const Real tension = dashpots.axial * lengthening, torque = dashpots.twist * twisting;
  const Vector3<Real> bent = dashpots.opening * opening + torque * n;
  const Vector3<Real> sheared = dashpots.shear * shearing;
  return {{tension * n - inverse_length * cross(sheared, n), bent - half * sheared,
           -bent - half * sheared},
          tension * lengthening + torque * twisting + dot(dashpots.opening * opening, opening) +
              dot(sheared, shearing)};
}

/// Weight of the last change by which velocities in the middle of a step, `kick` after those
/// before, are led on to its end.
constexpr double lead_to_pose(double time_step, double kick) {
  return 0.5 * time_step / kick;
}

/// By how much dashpots of a largest rate γ shorten the longest stable step 2/ω.
inline double damping_shortens(double rate, double frequency) {
  const double ratio = rate / frequency;
  return std::sqrt(1 + ratio * ratio) + ratio;
}

}  // namespace solidem

#endif
