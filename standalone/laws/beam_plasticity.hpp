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
// stands, and rigid motion gives no load however much has flowed. A flow that leaves the share p of
// the elastic deformation does the work Q·(1 − p)/p q = 2 (sqrt(U U') − U') on the way, with Q, q
// and U' after and U before it: the work of the load that remains, which is the one that acts.
//
// The yield strain ε_y(κ) at a plastic strain κ is that of a yield law (yield_law.hpp). Two rules
// say when and how far a bond flows. Both leave the share p of the elastic deformation, in every
// mode alike, so that the stress returns to σ_y along the ray to the origin:
//   radial return   when the strain since the last flow exceeds ε_y(κ):  p ε_e = ε_y(κ'),
//                   κ' = κ + (1 − p) ε_e the plastic strain;
//   scaled offset   (the thesis) when the strain ε since the bond was made exceeds its largest
//                   before, ε_y(κ) + κ: the stress is then that of the same monotonic curve,
//                   p ε = ε_y(κ'), κ' = (1 − p) ε; below it everything stays elastic, so reverse
//                   flow comes late and is a jump of the stress, whose work is the energy that it
//                   loses, U − U'.
#ifndef SOLIDEM_LAWS_BEAM_PLASTICITY_HPP
#define SOLIDEM_LAWS_BEAM_PLASTICITY_HPP

#include "laws/beam.hpp"
#include "laws/bond_law.hpp"
#include "laws/yield_law.hpp"

namespace solidem {

/// What a beam remembers: the shape in which it is free of load, and how much it has flowed.
template <class Real>
struct BeamHistory {
  Vector3<Real> normal_i;  ///< of the end section, in body axes of i; at first the rest direction
  Vector3<Real> normal_j;  ///< the same in body axes of j
  Real extension;          ///< plastic part, m
  Real twist;              ///< plastic part, rad
  Real strain;             ///< κ: equivalent plastic strain, never decreasing
};

/// The history of a beam that has not flowed.
template <class Real>
constexpr BeamHistory<Real> unyielded(const Vector3<Real>& rest_direction) {
  return {rest_direction, rest_direction, Real{0.0}, Real{0.0}, Real{0.0}};
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

/// The strains of a bond that is deformed so and has flowed to the plastic strain κ.
/// `equivalent`: σ_e / E.
template <class Real>
constexpr BondStrain<Real> bond_strain(const Real& radius, const Real& shear_ratio,
                                       const BeamPose<Real>& pose,
                                       const BeamDeformation<Real>& deformation,
                                       const Real& equivalent, const Real& plastic_strain) {
  using std::sqrt;
  const Vector3<Real> bend = pose.normal_j - pose.normal_i;
  const Real& per_length = deformation.inverse_rest_length;
  return {equivalent, plastic_strain, per_length * deformation.extension,
          per_length * (radius * sqrt(dot(bend, bend))),
          per_length * (shear_ratio * radius * deformation.twist)};
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

/// How far a beam flows.
template <class Real>
struct PlasticFlow {
  Real fraction;        ///< p: what remains of the elastic deformation, 1 where nothing flows
  Real strain;          ///< κ afterwards
  Real elastic_strain;  ///< σ_e / E afterwards
};

/// Radial return: `strain` is ε_e since the last flow, `plastic_strain` κ before.
template <class Law, class Real>
constexpr PlasticFlow<Real> radial_return(const YieldCurve<Law, Real>& yield, const Real& strain,
                                          const Real& plastic_strain) {
  const Real one{1.0};
  const Real limit = yield.limit(plastic_strain);
  const Real after = returned_strain(yield, strain, plastic_strain);
  const auto flows = greater(strain, limit);
  return {select(flows, after / select(flows, strain, one), one),
          select(flows, plastic_strain + (strain - after), plastic_strain),
          select(flows, after, strain)};
}

/// Scaled offset: `strain` is ε since the bond was made, `plastic_strain` κ before.
template <class Law, class Real>
constexpr PlasticFlow<Real> scaled_offset(const YieldCurve<Law, Real>& yield, const Real& strain,
                                          const Real& plastic_strain) {
  const Real one{1.0};
  const Real largest = yield.total_limit(plastic_strain);
  const Real after = returned_strain(yield, strain, Real{0.0});
  const auto flows = greater(strain, largest);
  return {select(flows, after / select(flows, strain, one), one),
          select(flows, strain - after, plastic_strain), after};
}

/// The pose of a beam of whose elastic deformation the share p remains: its section normals lean
/// towards the chord.
template <class Real>
constexpr BeamPose<Real> relaxed(const BeamPose<Real>& pose, const Vector3<Real>& direction,
                                 const Real& fraction) {
  const auto lean = [&](const Vector3<Real>& normal) {
    Vector3<Real> leant = direction + fraction * (normal - direction);
    // Newton's steps for 1 / length from 1: the length is short of that by p (1 − p) θ² / 2.
    for (int n = 0; n < 2; ++n) leant = (Real{1.5} - Real{0.5} * dot(leant, leant)) * leant;
    return leant;
  };
  return {pose.chord, lean(pose.normal_i), lean(pose.normal_j), pose.relative_turn};
}

/// A beam bond that may flow.
template <class Real>
struct YieldingBeam {
  BeamRigidity<Real> rigidity;
  Real rest_length;  ///< m
  Real radius;       ///< m
  Real shear_ratio;  ///< G / E
};

/// What a bond does in a pose, and what it will remember if the pose is accepted.
template <class Real>
struct BeamResponse {
  BeamLoad<Real> load;
  BeamHistory<Real> history;  ///< to be kept when the time step is
  Real strain;                ///< σ_e / E after any flow
  Real energy;                ///< elastic, after any flow, J
  Real plastic_work;          ///< taken by this flow, J
  BondStrain<Real> strains;   ///< after any flow
};

namespace detail {

/// Flow from a pose with a deformation to the share of it that remains. `plastic_strain`: κ before.
/// `energy_before`: of the deformation against the shape that the bond remembers, of which the
/// share `remaining` is left in every mode.
template <class Law, class Real>
constexpr BeamResponse<Real> flowed(const YieldCurve<Law, Real>& yield,
                                    const YieldingBeam<Real>& beam, const BeamPose<Real>& from,
                                    const BeamDeformation<Real>& deformation,
                                    const PlasticFlow<Real>& flow, const Real& plastic_strain,
                                    const Real& plastic_extension, const Real& energy_before,
                                    const Real& remaining, const Quaternion<Real>& orientation_i,
                                    const Quaternion<Real>& orientation_j) {
  const BeamPose<Real> pose = relaxed(from, deformation.direction, flow.fraction);
  BeamDeformation<Real> left = deformation;
  left.extension = flow.fraction * deformation.extension;
  left.twist = flow.fraction * deformation.twist;
  const Real one{1.0};
  const Real twist = dot(pose.relative_turn.v, pose.normal_i + pose.normal_j);
  const Real stress_before = yield.limit(plastic_strain);
  const Real stress_after = yield.limit(flow.strain);
  return {beam_load(beam.rigidity, pose, left),
          {rotate(conjugate(orientation_i), pose.normal_i),
           rotate(conjugate(orientation_j), pose.normal_j),
           plastic_extension + (deformation.extension - left.extension), twist - left.twist,
           flow.strain},
          flow.elastic_strain,
          beam_energy(beam.rigidity, pose, left),
          (one + stress_before / stress_after) * remaining * (one - remaining) * energy_before,
          bond_strain(beam.radius, beam.shear_ratio, pose, left, flow.elastic_strain, flow.strain)};
}

/// What a bond does that does not flow. `strain`: σ_e / E.
template <class Real>
constexpr BeamResponse<Real> unflowed(const YieldingBeam<Real>& beam,
                                      const BeamHistory<Real>& history, const BeamPose<Real>& pose,
                                      const BeamDeformation<Real>& deformation, const Real& strain,
                                      const Real& energy) {
  return {beam_load(beam.rigidity, pose, deformation),
          history,
          strain,
          energy,
          Real{0.0},
          bond_strain(beam.radius, beam.shear_ratio, pose, deformation, strain, history.strain)};
}

}  // namespace detail

/// A bond that keeps its shape, in a pose and with the deformation of it.
template <class Real>
constexpr BeamResponse<Real> elastic_response(const YieldingBeam<Real>& beam,
                                              const BeamHistory<Real>& history,
                                              const BeamPose<Real>& pose,
                                              const BeamDeformation<Real>& deformation) {
  return detail::unflowed(beam, history, pose, deformation,
                          equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation),
                          beam_energy(beam.rigidity, pose, deformation));
}

/// A bond under radial return, in a pose and with the deformation of it since the bond last flowed.
/// Nothing that is passed in changes: keep the history of the response to accept the pose.
template <class Law, class Real>
constexpr BeamResponse<Real> radial_return_response(const YieldCurve<Law, Real>& yield,
                                                    const YieldingBeam<Real>& beam,
                                                    const BeamHistory<Real>& history,
                                                    const BeamPose<Real>& pose,
                                                    const BeamDeformation<Real>& deformation,
                                                    const Quaternion<Real>& orientation_i,
                                                    const Quaternion<Real>& orientation_j) {
  const Real strain = equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation);
  const PlasticFlow<Real> flow = radial_return(yield, strain, history.strain);
  const Real energy = beam_energy(beam.rigidity, pose, deformation);
  if (!any(greater(flow.strain, history.strain)))
    return detail::unflowed(beam, history, pose, deformation, strain, energy);
  return detail::flowed(yield, beam, pose, deformation, flow, history.strain, history.extension,
                        energy, flow.fraction, orientation_i, orientation_j);
}

/// The same from where the ends stand.
template <class Law, class Real>
constexpr BeamResponse<Real> radial_return_response(const YieldCurve<Law, Real>& yield,
                                                    const YieldingBeam<Real>& beam,
                                                    const BeamHistory<Real>& history,
                                                    const Vector3<Real>& chord,
                                                    const Quaternion<Real>& orientation_i,
                                                    const Quaternion<Real>& orientation_j) {
  const BeamPose<Real> pose =
      beam_pose(chord, history.normal_i, history.normal_j, orientation_i, orientation_j);
  return radial_return_response(yield, beam, history, pose,
                                elastic_deformation(beam.rest_length, pose, history), orientation_i,
                                orientation_j);
}

/// A bond under the scaled offset of the thesis. `whole`, `whole_deformation`: pose and deformation
/// since the bond was made; the others as above.
template <class Law, class Real>
constexpr BeamResponse<Real> scaled_offset_response(
    const YieldCurve<Law, Real>& yield, const YieldingBeam<Real>& beam,
    const BeamHistory<Real>& history, const BeamPose<Real>& pose,
    const BeamDeformation<Real>& deformation, const BeamPose<Real>& whole,
    const BeamDeformation<Real>& whole_deformation, const Quaternion<Real>& orientation_i,
    const Quaternion<Real>& orientation_j) {
  const Real strain = equivalent_strain(beam.radius, beam.shear_ratio, whole, whole_deformation);
  const PlasticFlow<Real> flow = scaled_offset(yield, strain, history.strain);
  const Real energy = beam_energy(beam.rigidity, pose, deformation);
  if (!any(greater(flow.strain, history.strain)))
    return detail::unflowed(beam, history, pose, deformation,
                            equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation),
                            energy);
  BeamResponse<Real> response =
      detail::flowed(yield, beam, whole, whole_deformation, flow, history.strain, Real{0.0}, energy,
                     Real{1.0}, orientation_i, orientation_j);
  // Flow in reverse, or back again, is a fall from beyond the yield stress, in which all that the
  // bond loses is lost; but not what this step strained it beyond the largest strain, which flowed.
  const Real largest = yield.total_limit(history.strain);
  const Real elastic = equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation);
  const Real beyond = (strain - largest) / select(greater(elastic, Real{0.0}), elastic, Real{1.0});
  response.plastic_work = energy - response.energy - beyond * beyond * energy;
  return response;
}

/// The same from where the ends stand. `rest_direction`: of the bond when it was made, in body
/// axes.
template <class Law, class Real>
constexpr BeamResponse<Real> scaled_offset_response(const YieldCurve<Law, Real>& yield,
                                                    const YieldingBeam<Real>& beam,
                                                    const BeamHistory<Real>& history,
                                                    const Vector3<Real>& rest_direction,
                                                    const Vector3<Real>& chord,
                                                    const Quaternion<Real>& orientation_i,
                                                    const Quaternion<Real>& orientation_j) {
  const BeamPose<Real> pose =
      beam_pose(chord, history.normal_i, history.normal_j, orientation_i, orientation_j);
  const BeamPose<Real> whole = beam_pose(chord, rest_direction, orientation_i, orientation_j);
  return scaled_offset_response(
      yield, beam, history, pose, elastic_deformation(beam.rest_length, pose, history), whole,
      beam_deformation(beam.rest_length, whole), orientation_i, orientation_j);
}

}  // namespace solidem

#endif
