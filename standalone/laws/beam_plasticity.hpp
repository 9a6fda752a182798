// SPDX-License-Identifier: GPL-2.0-or-later
//
// Plasticity of a beam bond.
//
// Source: Terreros 2013, sections 3.2.1 and 3.2.2 (von Mises stress at mid-length, yield;
// with the printed M_i + M_j, which vanishes in pure bending, put right to M_i − M_j).
//
// Equivalent stress at the edge of the section at mid-length:
//   σ_e = sqrt(σ² + 3 τ²),   σ = |F_x| / S + ½ |M_i − M_j| r / I,   τ = M_x r / I_0.
// With the loads of laws/beam.hpp, ½ |M_i − M_j| = E I / l |a_j − a_i| and M_x = G I_0 / l φ, so
// that
//   ε_e = σ_e / E = sqrt((|e| + r |a_j − a_i|)² + 3 (G/E · r φ)²) / l,
// e the elastic extension and φ the elastic twist: everything below is written in this strain.
//
// Plastic deformation moves the shape in which the beam is free of load: the normals of its end
// sections in the elements' body axes, its length and its twist. The elastic law then holds as it
// stands, and rigid motion gives no load however much has flowed.
//
// A beam may be judged at its ends instead: there the larger of |M_i| and |M_j|, without torsion,
// stands for ½ |M_i − M_j|, which is never above it.
//
// The yield strain ε_y(κ) at a plastic strain κ is that of a yield law (yield_law.hpp); when and
// how far a bond flows is told in beam_flow.hpp.
#ifndef SOLIDEM_LAWS_BEAM_PLASTICITY_HPP
#define SOLIDEM_LAWS_BEAM_PLASTICITY_HPP

#include "laws/beam.hpp"
#include "laws/bond_law.hpp"

namespace solidem {

/// How a beam stood in the last pose, turned with element i.
template <class Real>
struct LastBeam {
  BeamModes<Real> modes;    ///< its elastic deformation
  Quaternion<Real> turn{};  ///< q_j q_i*
};

/// What a beam remembers: the shape in which it is free of load, and how much it has flowed.
template <class Real>
struct BeamHistory {
  Vector3<Real> normal_i;  ///< of the end section, in body axes of i; at first the rest direction
  Vector3<Real> normal_j;  ///< the same in body axes of j
  Real extension;          ///< plastic part, m
  Real twist;              ///< plastic part, rad
  Real strain;             ///< κ: equivalent plastic strain, never decreasing
  LastBeam<Real> last;     ///< in body axes of i
};

/// The history of a beam that has not flowed.
template <class Real>
constexpr BeamHistory<Real> unyielded(const Vector3<Real>& rest_direction) {
  const Real none{0.0};
  return {rest_direction, rest_direction, none, none, none, {}};
}

/// Deformation of a beam since it last flowed.
template <class Real>
constexpr BeamDeformation<Real> elastic_deformation(const Real& rest_length,
                                                    const BeamPose<Real>& pose,
                                                    const BeamHistory<Real>& history) {
  BeamDeformation<Real> deformation = beam_deformation(rest_length, pose);
  deformation.extension = deformation.extension - history.extension;
  deformation.twist = deformation.twist - history.twist;
  return deformation;
}

/// σ_e / E. `shear_ratio`: G / E.
template <class Real>
constexpr Real equivalent_strain(const Real& radius, const Real& shear_ratio,
                                 const BeamPose<Real>& pose,
                                 const BeamDeformation<Real>& deformation) {
  using std::abs;
  using std::sqrt;
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real edge = abs(deformation.extension) + radius * sqrt(dot(bend, bend));
  const Real slip = shear_ratio * radius * deformation.twist;
  return sqrt(edge * edge + Real{3.0} * slip * slip) * deformation.inverse_rest_length;
}

/// A beam bond that may flow.
template <class Real>
struct YieldingBeam {
  BeamRigidity<Real> rigidity;
  Real rest_length;                                       ///< m
  Real radius;                                            ///< m
  Real shear_ratio;                                       ///< G / E
  JudgedSection yield_section = JudgedSection::middle;    ///< where it flows
  JudgedSection rupture_section = JudgedSection::middle;  ///< where it breaks
};

namespace detail {

/// Strain by bending at the edge of the section at the end whose normal is `here`, times l.
template <class Real>
constexpr Real end_bending(const YieldingBeam<Real>& beam, const Vector3<Real>& here,
                           const Vector3<Real>& there, const Vector3<Real>& direction) {
  using std::sqrt;
  const Real half{0.5}, one{1.0}, two{2.0}, three{3.0}, none{0.0};
  const BeamRigidity<Real>& rigidity = beam.rigidity;
  const Vector3<Real> moment =
      (three * rigidity.shear) * cross(here, direction) -
      (half * (three * rigidity.shear - rigidity.bending)) * cross(here, there);
  const Vector3<Real> across = moment - dot(moment, direction) * direction;
  const auto bends = greater(rigidity.bending, none);
  const Real per_moment = two * beam.radius / select(bends, rigidity.bending, one);  // r / E I
  return select(bends, per_moment * sqrt(dot(across, across)), none);
}

}  // namespace detail

/// Strain by bending at the edge of the judged section.
template <class Real>
constexpr Real bending_strain(JudgedSection section, const YieldingBeam<Real>& beam,
                              const BeamPose<Real>& pose,
                              const BeamDeformation<Real>& deformation) {
  using std::sqrt;
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real& per_length = deformation.inverse_rest_length;
  const Real middle = per_length * (beam.radius * sqrt(dot(bend, bend)));
  if (section == JudgedSection::middle) return middle;
  const Vector3<Real>& x = deformation.direction;
  const Real at_i = detail::end_bending(beam, pose.normal_i, pose.normal_j, x);
  const Real at_j = detail::end_bending(beam, pose.normal_j, pose.normal_i, x);
  const Real ends = per_length * select(greater(at_i, at_j), at_i, at_j);
  if (section == JudgedSection::ends) return ends;
  return select(greater(ends, middle), ends, middle);
}

/// σ_e / E in the judged section.
template <class Real>
constexpr Real equivalent_strain(JudgedSection section, const YieldingBeam<Real>& beam,
                                 const BeamPose<Real>& pose,
                                 const BeamDeformation<Real>& deformation) {
  using std::abs;
  using std::sqrt;
  if (section == JudgedSection::middle)
    return equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation);
  const Real& per_length = deformation.inverse_rest_length;
  const Real edge =
      per_length * abs(deformation.extension) + bending_strain(section, beam, pose, deformation);
  const Real slip = per_length * (beam.shear_ratio * beam.radius * deformation.twist);
  return sqrt(edge * edge + Real{3.0} * slip * slip);
}

/// The strains by which a bond breaks that is deformed so and has flowed to the plastic strain κ.
/// `equivalent`: σ_e / E where it flows.
template <class Real>
constexpr BondStrain<Real> bond_strain(const YieldingBeam<Real>& beam, const BeamPose<Real>& pose,
                                       const BeamDeformation<Real>& deformation,
                                       const Real& equivalent, const Real& plastic_strain) {
  const Real& per_length = deformation.inverse_rest_length;
  const JudgedSection section = beam.rupture_section;
  return {section == beam.yield_section ? equivalent
                                        : equivalent_strain(section, beam, pose, deformation),
          plastic_strain, per_length * deformation.extension,
          bending_strain(section, beam, pose, deformation),
          per_length * (beam.shear_ratio * beam.radius * deformation.twist)};
}

/// Twice the largest that (ε_e l)² can be, without a root: below it a bond cannot have reached
/// its limit.
template <class Real>
constexpr Real bound_of_squared_extension(const Real& radius, const Real& shear_ratio,
                                          const BeamPose<Real>& pose,
                                          const BeamDeformation<Real>& deformation) {
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real slip = shear_ratio * radius * deformation.twist;
  return Real{2.0} *
             (deformation.extension * deformation.extension + radius * radius * dot(bend, bend)) +
         Real{3.0} * slip * slip;
}

}  // namespace solidem

#endif
