// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elastic beam between the centres of two elements: Euler–Bernoulli, Timoshenko or plain spring.
//
// Source: Terreros 2013, section 3.2 (end loads of a beam bond, with its three misprinted signs put
// right); vector measures of the end rotations as in Kuzkin & Asonov, Phys. Rev. E 86, 051301
// (2012).
//
// Symbols
//   x      unit chord from element i to element j; L its length now, l at rest        [m]
//   a_i,j  normals of the end sections: unit vectors carried along by either element, both equal to
//          x where the beam is free of load
//   w + u  relative orientation q_j q_i* of the two elements (unit quaternion)
//   k_a = E S / l, k_t = G I_0 / l                    axial [N/m], torsional [N·m]
//   k_b = 2 E I / l                                   uniform bending [N·m]
//   k_s = k_b / (1 + Φ), Φ = 12 E I / (κ G S l²)      bending by shear, κ the shear coefficient;
//                                                     Φ = 0 for Euler–Bernoulli
//   S = pi r², I = pi r⁴ / 4, I_0 = 2 I
//
// Derivation. Let θ_i, θ_j be the rotations of the end sections against the chord. The beam stores
//   U = ½ k_a (L − l)² + ¾ k_s (θ_i + θ_j)² + ¼ k_b (θ_j − θ_i)² + ½ k_t φ²,
// θ transverse and φ = θ_jx − θ_ix; k_s = k_b gives the k_b (θ_i² + θ_i·θ_j + θ_j²) of Euler and
// Bernoulli. Replace the squares by products of unit vectors, equal to them up to fourth order:
// θ_i² = 2 (1 − x·a_i), θ_j² = 2 (1 − x·a_j), |θ_i − θ_j|² = 2 (1 − a_i·a_j), and
// φ = u·(a_i + a_j). Then
//   U = ½ k_a (L − l)² + 3 k_s [(1 − x·a_i) + (1 − x·a_j)] − c (1 − a_i·a_j) + ½ k_t φ²,
//   c = ½ (3 k_s − k_b),
// and the loads are its exact gradient:
//   F_i = k_a (L − l) x − (3 k_s / L) P (a_i + a_j),   P = 1 − x xᵀ,   F_j = −F_i,
//   M_i = 3 k_s a_i × x − c a_i × a_j + m,   M_j = 3 k_s a_j × x + c a_i × a_j − m,
//   m = ½ k_t φ [w (a_i + a_j) + (a_j − a_i) × u].
// In small motion these are the thesis' end loads; M_i + M_j + L x × F_j = 0 holds exactly; U sees
// nothing but relative motion, so a rigid motion of any size gives no load, a closed cycle gives no
// work, and swapping i and j changes nothing. For finite section rotations θ the bending moment
// differs from linear by θ²/6: 0.2 % at θ = 0.1.
#ifndef SOLIDEM_LAWS_BEAM_HPP
#define SOLIDEM_LAWS_BEAM_HPP

#include "laws/algebra.hpp"
#include "laws/constants.hpp"

namespace solidem {

/// What a beam is made of and how thick it is.
template <class Real>
struct BeamSection {
  Real young_modulus;  ///< E of the beam (microscopic), Pa
  Real shear_modulus;  ///< G of the beam (microscopic), Pa
  Real radius;         ///< r, m
};

/// Stiffness of a beam times its rest length; divide by the rest length for k_a, k_b, k_s, k_t.
template <class Real>
struct BeamRigidity {
  Real axial;    ///< E S, N
  Real bending;  ///< 2 E I, N·m²
  Real shear;    ///< 2 E I / (1 + Φ), N·m²
  Real torsion;  ///< G I_0, N·m²
};

/// S = pi r², m².
template <class Real>
constexpr Real beam_area(const BeamSection<Real>& section) {
  return Real{pi} * section.radius * section.radius;
}

/// An Euler–Bernoulli beam of circular section: it does not shear.
template <class Real>
constexpr BeamRigidity<Real> euler_bernoulli_rigidity(const BeamSection<Real>& section) {
  const Real area = beam_area(section);
  const Real twice_second_moment = area * section.radius * section.radius * Real{0.5};
  const Real bending = section.young_modulus * twice_second_moment;
  return {section.young_modulus * area, bending, bending,
          section.shear_modulus * twice_second_moment};
}

/// A Timoshenko beam of circular section, which also shears. `shear_coefficient` κ: the shear force
/// is κ G S times the shear angle (6/7 to 9/10 for a full circle).
template <class Real>
constexpr BeamRigidity<Real> timoshenko_rigidity(const BeamSection<Real>& section,
                                                 const Real& rest_length,
                                                 const Real& shear_coefficient) {
  BeamRigidity<Real> rigidity = euler_bernoulli_rigidity(section);
  const Real shear_stiffness = shear_coefficient * section.shear_modulus * beam_area(section);
  const Real flexibility =
      Real{6.0} * rigidity.bending / (shear_stiffness * rest_length * rest_length);
  rigidity.shear = rigidity.bending / (Real{1.0} + flexibility);
  return rigidity;
}

/// A beam that resists nothing but a change of length.
template <class Real>
constexpr BeamRigidity<Real> spring_rigidity(const BeamSection<Real>& section) {
  const Real none{0.0};
  return {euler_bernoulli_rigidity(section).axial, none, none, none};
}

/// Where the two ends of a beam stand.
template <class Real>
struct BeamPose {
  Vector3<Real> chord;             ///< from centre i to centre j, m
  Vector3<Real> normal_i;          ///< a_i: normal of the section at i, in world axes
  Vector3<Real> normal_j;          ///< a_j: the same at j
  Quaternion<Real> relative_turn;  ///< q_j q_i*
};

/// The pose of a beam whose section normals are given in the body axes of either element
/// (orientations are relative to the moment the bond was made).
template <class Real>
constexpr BeamPose<Real> beam_pose(const Vector3<Real>& chord, const Vector3<Real>& normal_i,
                                   const Vector3<Real>& normal_j,
                                   const Quaternion<Real>& orientation_i,
                                   const Quaternion<Real>& orientation_j) {
  return {chord, rotate(orientation_i, normal_i), rotate(orientation_j, normal_j),
          orientation_j * conjugate(orientation_i)};
}

/// The pose of a beam that has yielded nowhere: both normals are its rest direction.
template <class Real>
constexpr BeamPose<Real> beam_pose(const Vector3<Real>& chord, const Vector3<Real>& rest_direction,
                                   const Quaternion<Real>& orientation_i,
                                   const Quaternion<Real>& orientation_j) {
  return beam_pose(chord, rest_direction, rest_direction, orientation_i, orientation_j);
}

/// How a beam is deformed.
template <class Real>
struct BeamDeformation {
  Vector3<Real> direction;   ///< x
  Real inverse_length;       ///< 1 / L, 1/m
  Real inverse_rest_length;  ///< 1 / l, 1/m
  Real extension;            ///< L − l, less the plastic extension, m
  Real twist;                ///< φ, less the plastic twist, rad
};

/// The deformation of a chord alone, without twist; a chord of length zero gives finite figures.
template <class Real>
constexpr BeamDeformation<Real> spring_deformation(const Real& rest_length,
                                                   const Vector3<Real>& chord) {
  const auto [length, inverse_length, inverse_rest_length] =
      length_and_inverses(dot(chord, chord) + Real{tiny_square}, rest_length);
  return {inverse_length * chord, inverse_length, inverse_rest_length, length - rest_length,
          Real{0.0}};
}

/// The deformation in a pose.
template <class Real>
constexpr BeamDeformation<Real> beam_deformation(const Real& rest_length,
                                                 const BeamPose<Real>& pose) {
  BeamDeformation<Real> deformation = spring_deformation(rest_length, pose.chord);
  deformation.twist = dot(pose.relative_turn.v, pose.normal_i + pose.normal_j);
  return deformation;
}

/// What the beam does to element i; element j receives −force and moment_j.
template <class Real>
struct BeamLoad {
  Vector3<Real> force;     ///< on i, N
  Vector3<Real> moment_i;  ///< on i, N·m
  Vector3<Real> moment_j;  ///< on j, N·m
};

/// Force on element i of a beam that is a spring, N.
template <class Real>
constexpr Vector3<Real> spring_force(const BeamRigidity<Real>& rigidity,
                                     const BeamDeformation<Real>& deformation) {
  return (rigidity.axial * deformation.inverse_rest_length * deformation.extension) *
         deformation.direction;
}

/// End loads of a beam in a pose with a deformation.
template <class Real>
constexpr BeamLoad<Real> beam_load(const BeamRigidity<Real>& rigidity, const BeamPose<Real>& pose,
                                   const BeamDeformation<Real>& deformation) {
  const Vector3<Real>& x = deformation.direction;
  const Vector3<Real>& a_i = pose.normal_i;
  const Vector3<Real>& a_j = pose.normal_j;
  const Vector3<Real>& u = pose.relative_turn.v;
  const Real& per_length = deformation.inverse_rest_length;
  const Vector3<Real> sum = a_i + a_j;
  const Real tension = rigidity.axial * per_length * deformation.extension;
  const Real bending = Real{3.0} * rigidity.shear * per_length;
  const Real opening_stiffness =
      Real{0.5} * (Real{3.0} * rigidity.shear - rigidity.bending) * per_length;
  const Real half_torque = Real{0.5} * rigidity.torsion * per_length * deformation.twist;

  const Real shear = bending * deformation.inverse_length;
  const Vector3<Real> force = (tension + shear * dot(sum, x)) * x - shear * sum;
  const Vector3<Real> torque = half_torque * (pose.relative_turn.w * sum + cross(a_j - a_i, u));
  const Vector3<Real> bent = bending * x;
  return {force, cross(a_i, bent - opening_stiffness * a_j) + torque,
          cross(a_j, bent - opening_stiffness * a_i) - torque};
}

/// End loads of a beam that has yielded nowhere.
template <class Real>
constexpr BeamLoad<Real> beam_load(const BeamRigidity<Real>& rigidity, const Real& rest_length,
                                   const BeamPose<Real>& pose) {
  return beam_load(rigidity, pose, beam_deformation(rest_length, pose));
}

/// Elastic energy U of a beam, J; squares of differences keep it accurate in the smallest motion.
template <class Real>
constexpr Real beam_energy(const BeamRigidity<Real>& rigidity, const BeamPose<Real>& pose,
                           const BeamDeformation<Real>& deformation) {
  const Vector3<Real> e_i = pose.normal_i - deformation.direction;
  const Vector3<Real> e_j = pose.normal_j - deformation.direction;
  const Vector3<Real> e_ij = pose.normal_j - pose.normal_i;
  const Real half{0.5}, three{3.0};
  return half * deformation.inverse_rest_length *
         (rigidity.axial * deformation.extension * deformation.extension +
          three * rigidity.shear * (dot(e_i, e_i) + dot(e_j, e_j)) -
          half * (three * rigidity.shear - rigidity.bending) * dot(e_ij, e_ij) +
          rigidity.torsion * deformation.twist * deformation.twist);
}

/// The elastic deformation of a beam in the measures of which its energy is the square, in body
/// axes of element i: rigid motion does not change it.
template <class Real>
struct BeamModes {
  Vector3<Real> lean_i;  ///< a_i − x
  Vector3<Real> lean_j;  ///< a_j − x
  Real extension;        ///< m
  Real twist;            ///< rad
};

template <class Real>
constexpr BeamModes<Real> beam_modes(const BeamPose<Real>& pose,
                                     const BeamDeformation<Real>& deformation,
                                     const Quaternion<Real>& orientation_i) {
  const Quaternion<Real> back = conjugate(orientation_i);
  return {rotate(back, pose.normal_i - deformation.direction),
          rotate(back, pose.normal_j - deformation.direction), deformation.extension,
          deformation.twist};
}

/// Mutual energy of two deformations of a beam, J: half of what the load of one does along the
/// other. That of one and the same is its energy.
template <class Real>
constexpr Real mutual_energy(const BeamRigidity<Real>& rigidity, const Real& inverse_rest_length,
                             const BeamModes<Real>& a, const BeamModes<Real>& b) {
  const Real half{0.5}, three{3.0};
  const Real leaning = dot(a.lean_i, b.lean_i) + dot(a.lean_j, b.lean_j);
  const Real bending = dot(a.lean_j - a.lean_i, b.lean_j - b.lean_i);
  return half * inverse_rest_length *
         (rigidity.axial * a.extension * b.extension + three * rigidity.shear * leaning -
          half * (three * rigidity.shear - rigidity.bending) * bending +
          rigidity.torsion * a.twist * b.twist);
}

/// Elastic energy of a beam that has yielded nowhere.
template <class Real>
constexpr Real beam_energy(const BeamRigidity<Real>& rigidity, const Real& rest_length,
                           const BeamPose<Real>& pose) {
  return beam_energy(rigidity, pose, beam_deformation(rest_length, pose));
}

}  // namespace solidem

#endif
