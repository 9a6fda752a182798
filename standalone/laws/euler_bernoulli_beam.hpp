// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elastic Euler–Bernoulli beam between the centres of two elements.
//
// Source: Terreros 2013, section 3.2 (end loads of a beam bond, with its three misprinted signs put
// right); vector measures of the end rotations as in Kuzkin & Asonov, Phys. Rev. E 86, 051301
// (2012).
//
// Symbols
//   x      unit chord from element i to element j; L its length now, l at rest        [m]
//   a_i,j  rest direction of the beam, carried along by either element: its end section's normal
//   w + u  relative orientation q_j q_i* of the two elements (unit quaternion)
//   k_a = E S / l, k_b = 2 E I / l, k_t = G I_0 / l   axial [N/m], bending, torsional [N·m]
//   S = pi r², I = pi r⁴ / 4, I_0 = 2 I
//
// Derivation. Let θ_i, θ_j be the rotations of the end sections against the chord. The beam stores
//   U = ½ k_a (L − l)² + k_b (θ_i² + θ_i·θ_j + θ_j²) + ½ k_t φ²,
// θ transverse and φ = θ_jx − θ_ix. Replace the squares by products of unit vectors, equal to them
// up to fourth order: θ_i² = 2 (1 − x·a_i), θ_j² = 2 (1 − x·a_j), |θ_i − θ_j|² = 2 (1 − a_i·a_j),
// and φ = 2 u·a_i. Then
//   U = ½ k_a (L − l)² + k_b [3 (1 − x·a_i) + 3 (1 − x·a_j) − (1 − a_i·a_j)] + 2 k_t (u·a_i)²,
// and the loads are its exact gradient:
//   F_i = k_a (L − l) x − (3 k_b / L) P (a_i + a_j),   P = 1 − x xᵀ,   F_j = −F_i,
//   M_i = k_b (3 a_i × x − a_i × a_j) + m,   M_j = k_b (3 a_j × x + a_i × a_j) − m,
//   m = 2 k_t (u·a_i) (w a_i + u × a_i).
// In small motion these are the thesis' end loads; M_i + M_j + L x × F_j = 0 holds exactly; U sees
// nothing but relative motion, so a rigid motion of any size gives no load, a closed cycle gives no
// work, and swapping i and j changes nothing. For finite section rotations θ the bending moment
// differs from linear by θ²/6: 0.2 % at θ = 0.1.
#ifndef SOLIDEM_LAWS_EULER_BERNOULLI_BEAM_HPP
#define SOLIDEM_LAWS_EULER_BERNOULLI_BEAM_HPP

#include "laws/algebra.hpp"

namespace solidem {

/// What a beam is made of and how thick it is.
template <class Real>
struct BeamSection {
  Real young_modulus;  ///< E of the beam (microscopic), Pa
  Real shear_modulus;  ///< G of the beam (microscopic), Pa
  Real radius;         ///< r, m
};

/// Stiffness of a beam times its rest length; divide by the rest length for k_a, k_b, k_t.
template <class Real>
struct BeamRigidity {
  Real axial;    ///< E S, N
  Real bending;  ///< 2 E I, N·m²
  Real torsion;  ///< G I_0, N·m²
};

/// E S, 2 E I and G I_0 of a circular section.
template <class Real>
constexpr BeamRigidity<Real> beam_rigidity(const BeamSection<Real>& section) {
  const Real pi{3.14159265358979323846};
  const Real area = pi * section.radius * section.radius;
  const Real twice_second_moment = area * section.radius * section.radius * Real{0.5};
  return {section.young_modulus * area, section.young_modulus * twice_second_moment,
          section.shear_modulus * twice_second_moment};
}

/// Rigidity of a beam of some radius from that of the same beam of radius 1: S grows as r², I and
/// I_0 as r⁴.
template <class Real>
constexpr BeamRigidity<Real> beam_rigidity_of_radius(const BeamRigidity<Real>& unit,
                                                     const Real& radius) {
  const Real r2 = radius * radius, r4 = r2 * r2;
  return {r2 * unit.axial, r4 * unit.bending, r4 * unit.torsion};
}

/// Where the two ends of a beam stand.
template <class Real>
struct BeamPose {
  Vector3<Real> chord;             ///< from centre i to centre j, m
  Vector3<Real> normal_i;          ///< a_i: the rest direction turned with element i
  Vector3<Real> normal_j;          ///< a_j: the rest direction turned with element j
  Quaternion<Real> relative_turn;  ///< q_j q_i*
};

/// The pose of a beam whose rest direction is given in the body axes of both elements (orientations
/// are relative to the moment the bond was made).
template <class Real>
constexpr BeamPose<Real> beam_pose(const Vector3<Real>& chord, const Vector3<Real>& rest_direction,
                                   const Quaternion<Real>& orientation_i,
                                   const Quaternion<Real>& orientation_j) {
  return {chord, rotate(orientation_i, rest_direction), rotate(orientation_j, rest_direction),
          orientation_j * conjugate(orientation_i)};
}

/// What the beam does to element i; element j receives −force and moment_j.
template <class Real>
struct BeamLoad {
  Vector3<Real> force;     ///< on i, N
  Vector3<Real> moment_i;  ///< on i, N·m
  Vector3<Real> moment_j;  ///< on j, N·m
};

/// End loads of the beam. A chord of length zero gives finite loads.
template <class Real>
constexpr BeamLoad<Real> beam_load(const BeamRigidity<Real>& rigidity, const Real& rest_length,
                                   const BeamPose<Real>& pose) {
  using std::sqrt;
  const Real tiny{1e-300};
  const Real length = sqrt(dot(pose.chord, pose.chord) + tiny);
  // One division, the slowest thing here, serves both reciprocals.
  const Real inverse_of_both = Real{1.0} / (length * rest_length);
  const Real inverse_length = inverse_of_both * rest_length;
  const Real inverse_rest_length = inverse_of_both * length;
  const Vector3<Real> x = inverse_length * pose.chord;
  const Real tension = rigidity.axial * (length - rest_length) * inverse_rest_length;
  const Real bending = rigidity.bending * inverse_rest_length;
  const Real torsion = rigidity.torsion * inverse_rest_length;

  const Vector3<Real>& a_i = pose.normal_i;
  const Vector3<Real>& a_j = pose.normal_j;
  const Vector3<Real> sum = a_i + a_j;
  const Real shear = Real{3.0} * bending * inverse_length;
  const Vector3<Real> force = (tension + shear * dot(sum, x)) * x - shear * sum;

  const Vector3<Real>& u = pose.relative_turn.v;
  const Vector3<Real> twist =
      (Real{2.0} * torsion * dot(u, a_i)) * (pose.relative_turn.w * a_i + cross(u, a_i));
  const Vector3<Real> opening = bending * cross(a_i, a_j) - twist;
  const Vector3<Real> x3 = (Real{3.0} * bending) * x;
  return {force, cross(a_i, x3) - opening, cross(a_j, x3) + opening};
}

/// Elastic energy U of the beam, J; squares of differences keep it accurate in the smallest motion.
template <class Real>
constexpr Real beam_energy(const BeamRigidity<Real>& rigidity, const Real& rest_length,
                           const BeamPose<Real>& pose) {
  using std::sqrt;
  const Real tiny{1e-300};
  const Real length = sqrt(dot(pose.chord, pose.chord) + tiny);
  const Vector3<Real> x = (Real{1.0} / length) * pose.chord;
  const Real stretch = length - rest_length;
  const Vector3<Real> e_i = pose.normal_i - x, e_j = pose.normal_j - x;
  const Vector3<Real> e_ij = pose.normal_j - pose.normal_i;
  const Real half_twist = dot(pose.relative_turn.v, pose.normal_i);
  const Real half{0.5};
  return Real{1.0} / rest_length *
         (half * rigidity.axial * stretch * stretch +
          half * rigidity.bending *
              (Real{3.0} * (dot(e_i, e_i) + dot(e_j, e_j)) - dot(e_ij, e_ij)) +
          Real{2.0} * rigidity.torsion * half_twist * half_twist);
}

}  // namespace solidem

#endif
