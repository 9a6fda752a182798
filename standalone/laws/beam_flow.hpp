// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a beam bond that may flow (beam_plasticity.hpp) does in a pose, by each rule of flow
// (flow_rule.hpp).
//
// Plastic work of a flow is that of the mean load: half of what the load Q_n of the last pose does
// along the change of shape, half of what the load Q' that is left does. So it is too where the
// bond stood below the yield surface in the last pose: all energies of a step then add up, in
// second order of the step. Each load works along what the change of shape means in its own pose:
// in between j has turned against i, and with it the normal of its section. With q_n and q_n' the
// elastic deformations of the old and the new shape in the last pose, q and q' those in this one,
// and W(a, b) their mutual energy, half of what the load of a does along b, it is
//   W(q_n, q_n − q_n') + W(q', q − q').
#ifndef SOLIDEM_LAWS_BEAM_FLOW_HPP
#define SOLIDEM_LAWS_BEAM_FLOW_HPP

#include "laws/associated_flow.hpp"
#include "laws/beam_plasticity.hpp"
#include "laws/flow_rule.hpp"

namespace solidem {

namespace detail {

/// A vector made a unit vector that is short of one by the square of an angle: the series of
/// 1 / length.
template <class Real>
constexpr Vector3<Real> nearly_unit(const Vector3<Real>& v) {
  const Real one{1.0};
  const Real g = one - dot(v, v);
  return (one + g * (Real{0.5} + g * (Real{0.375} + g * Real{0.3125}))) * v;
}

}  // namespace detail

/// The pose of a beam of whose elastic deformation the share p remains: its section normals lean
/// towards the chord.
template <class Real>
constexpr BeamPose<Real> relaxed(const BeamPose<Real>& pose, const Vector3<Real>& direction,
                                 const Real& fraction) {
  const auto lean = [&](const Vector3<Real>& normal) {
    return detail::nearly_unit(direction + fraction * (normal - direction));
  };
  return {pose.chord, lean(pose.normal_i), lean(pose.normal_j), pose.relative_turn};
}

/// The pose of a beam of whose bending the share p remains; how much it is sheared does not change.
template <class Real>
constexpr BeamPose<Real> straightened(const BeamPose<Real>& pose, const Real& fraction) {
  const Vector3<Real> back = (Real{0.5} * (Real{1.0} - fraction)) * (pose.normal_j - pose.normal_i);
  return {pose.chord, detail::nearly_unit(pose.normal_i + back),
          detail::nearly_unit(pose.normal_j - back), pose.relative_turn};
}

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

/// Where the ends of a bond stand.
template <class Real>
struct BeamEnds {
  Vector3<Real> chord;  ///< from centre i to centre j, m
  Quaternion<Real> orientation_i, orientation_j;
};

/// A beam in a pose.
template <class Real>
struct BeamState {
  BeamPose<Real> pose;
  BeamDeformation<Real> deformation;
};

/// A bond in a pose, as the rules of flow look at it. `Turned`: the orientation of i, a quaternion
/// or a rotation.
template <class Real, class Turned = Quaternion<Real>>
struct PosedBeam {
  BeamState<Real> now;    ///< of the shape that the bond remembers
  BeamState<Real> whole;  ///< of the shape that it was made with; scaled offset alone looks at it
  Turned orientation_i;
  Quaternion<Real> orientation_j;
};

/// A flow in a pose.
template <class Real>
struct BeamFlow {
  BeamState<Real> left;  ///< of the shape that it leads to
  Real strain;           ///< κ afterwards: more than before where it flows
  Real elastic_strain;   ///< σ_e / E afterwards
};

namespace detail {

/// Elastic deformation, in world axes.
template <class Real>
constexpr BeamModes<Real> world_modes(const BeamState<Real>& state) {
  const auto& [pose, deformation] = state;
  return {pose.normal_i - deformation.direction, pose.normal_j - deformation.direction,
          deformation.extension, deformation.twist};
}

template <class Real>
constexpr LastBeam<Real> turned(const Quaternion<Real>& rotation, const LastBeam<Real>& last) {
  const auto& [modes, turn] = last;
  return {{rotate(rotation, modes.lean_i), rotate(rotation, modes.lean_j), modes.extension,
           modes.twist},
          {turn.w, rotate(rotation, turn.v)}};
}

/// What a flow takes from the elastic deformation in a pose, in the last pose: there j stood turned
/// against i otherwise than `now`, and its section with it.
template <class Real>
constexpr BeamModes<Real> in_last_pose(const BeamModes<Real>& flown, const Quaternion<Real>& now,
                                       const Quaternion<Real>& then) {
  const Vector3<Real> of_j = rotate(then * conjugate(now), flown.lean_j);
  return {flown.lean_i, of_j, flown.extension,
          flown.twist + dot(then.v, flown.lean_i + of_j) - dot(now.v, flown.lean_i + flown.lean_j)};
}

/// A deformation of which shares remain.
template <class Real>
constexpr BeamDeformation<Real> remaining(const BeamDeformation<Real>& deformation,
                                          const Real& of_extension, const Real& of_twist) {
  BeamDeformation<Real> left = deformation;
  left.extension = of_extension * deformation.extension;
  left.twist = of_twist * deformation.twist;
  return left;
}

/// A pose and a deformation of which the same share remains in every mode.
template <class Real>
constexpr BeamState<Real> remaining(const BeamState<Real>& state, const Real& fraction) {
  return {relaxed(state.pose, state.deformation.direction, fraction),
          remaining(state.deformation, fraction, fraction)};
}

template <class Real>
constexpr Real judged_strain(const YieldingBeam<Real>& beam, const BeamState<Real>& state) {
  return equivalent_strain(beam.yield_section, beam, state.pose, state.deformation);
}

template <class Law, class Real>
constexpr BeamFlow<Real> radial_flow(const YieldCurve<Law, Real>& yield,
                                     const YieldingBeam<Real>& beam, const Real& plastic_strain,
                                     const BeamState<Real>& now) {
  const Real strain = judged_strain(beam, now);
  const PlasticFlow<Real> flow = radial_return(yield, strain, plastic_strain);
  return {remaining(now, flow.fraction), flow.strain, flow.elastic_strain};
}

template <class Law, class Real>
constexpr BeamFlow<Real> offset_flow(const YieldCurve<Law, Real>& yield,
                                     const YieldingBeam<Real>& beam, const Real& plastic_strain,
                                     const BeamState<Real>& whole) {
  const Real strain = judged_strain(beam, whole);
  const PlasticFlow<Real> flow = scaled_offset(yield, strain, plastic_strain);
  return {remaining(whole, flow.fraction), flow.strain, flow.elastic_strain};
}

/// Of the section at mid-length.
template <class Law, class Real>
constexpr BeamFlow<Real> normal_flow(const YieldCurve<Law, Real>& yield,
                                     const YieldingBeam<Real>& beam, const Real& plastic_strain,
                                     const BeamState<Real>& now) {
  using std::abs;
  const auto& [pose, deformation] = now;
  const Real strain = equivalent_strain(beam.radius, beam.shear_ratio, pose, deformation);
  const Real& per_length = deformation.inverse_rest_length;
  const ResultantStrain<Real> resultants{
      per_length * abs(deformation.extension),
      bending_strain(JudgedSection::middle, beam, pose, deformation),
      per_length * (beam.shear_ratio * beam.radius * deformation.twist)};
  const AssociatedFlow<Real> flow =
      associated_flow(yield, resultants, beam.shear_ratio, strain, plastic_strain);
  return {{straightened(pose, flow.bending), remaining(deformation, flow.normal, flow.twist)},
          flow.strain,
          flow.elastic_strain};
}

/// A bond that keeps its shape. `strain`: σ_e / E.
template <class Real>
constexpr BeamResponse<Real> unflowed(const YieldingBeam<Real>& beam,
                                      const BeamHistory<Real>& history, const BeamState<Real>& now,
                                      const Real& strain) {
  return {beam_load(beam.rigidity, now.pose, now.deformation),
          history,
          strain,
          beam_energy(beam.rigidity, now.pose, now.deformation),
          Real{0.0},
          bond_strain(beam, now.pose, now.deformation, strain, history.strain)};
}

}  // namespace detail

/// What would flow by a rule. Nothing that is passed in changes.
template <FlowRule rule, class Law, class Real, class Turned>
constexpr BeamFlow<Real> beam_flow(const YieldCurve<Law, Real>& yield,
                                   const YieldingBeam<Real>& beam, const Real& plastic_strain,
                                   const PosedBeam<Real, Turned>& at) {
  if constexpr (rule == FlowRule::scaled_offset)
    return detail::offset_flow(yield, beam, plastic_strain, at.whole);
  else if constexpr (rule == FlowRule::associated)
    return detail::normal_flow(yield, beam, plastic_strain, at.now);
  else
    return detail::radial_flow(yield, beam, plastic_strain, at.now);
}

/// Strains of a bond after a flow.
template <class Real>
constexpr BondStrain<Real> strains_after(const YieldingBeam<Real>& beam,
                                         const BeamFlow<Real>& flow) {
  return bond_strain(beam, flow.left.pose, flow.left.deformation, flow.elastic_strain, flow.strain);
}

/// What a bond does that flows, and its history if the pose is accepted; without its strains, which
/// cost roots that few ask for. `last`: turned with element i to where it stands now.
template <class Real, class Turned>
constexpr BeamResponse<Real> flowed_response(const YieldingBeam<Real>& beam,
                                             const BeamHistory<Real>& history,
                                             const PosedBeam<Real, Turned>& at,
                                             const BeamFlow<Real>& flow,
                                             const LastBeam<Real>& last) {
  const auto& [pose, left] = flow.left;
  const Real twist = dot(pose.relative_turn.v, pose.normal_i + pose.normal_j);
  const BeamModes<Real> flown{
      at.now.pose.normal_i - pose.normal_i, at.now.pose.normal_j - pose.normal_j,
      at.now.deformation.extension - left.extension, at.now.deformation.twist - left.twist};
  return {
      beam_load(beam.rigidity, pose, left),
      {rotate_back(at.orientation_i, pose.normal_i), rotate_back(at.orientation_j, pose.normal_j),
       history.extension + flown.extension, twist - left.twist, flow.strain, history.last},
      flow.elastic_strain,
      beam_energy(beam.rigidity, pose, left),
      mutual_energy(beam.rigidity, left.inverse_rest_length, last.modes,
                    detail::in_last_pose(flown, pose.relative_turn, last.turn)) +
          mutual_energy(beam.rigidity, left.inverse_rest_length, detail::world_modes(flow.left),
                        flown),
      {}};
}

/// A bond that keeps its shape, in a pose and with the deformation of it.
template <class Real>
constexpr BeamResponse<Real> elastic_response(const YieldingBeam<Real>& beam,
                                              const BeamHistory<Real>& history,
                                              const BeamState<Real>& now) {
  return detail::unflowed(beam, history, now, detail::judged_strain(beam, now));
}

/// What a bond does that may flow, and its history if the pose is accepted: of that the last pose
/// in world axes.
template <class Law, class Real>
constexpr BeamResponse<Real> flow_response(FlowRule rule, const YieldCurve<Law, Real>& yield,
                                           const YieldingBeam<Real>& beam,
                                           const BeamHistory<Real>& history,
                                           const PosedBeam<Real>& at, const LastBeam<Real>& last) {
  return by_rule(rule, [&](auto known) {
    const BeamFlow<Real> flow = beam_flow<decltype(known)::value>(yield, beam, history.strain, at);
    const bool flows = any(greater(flow.strain, history.strain));
    BeamResponse<Real> response = flows ? flowed_response(beam, history, at, flow, last)
                                        : elastic_response(beam, history, at.now);
    if (flows) response.strains = strains_after(beam, flow);
    response.history.last = {detail::world_modes(flows ? flow.left : at.now),
                             at.now.pose.relative_turn};
    return response;
  });
}

/// The same from where the ends stand. `rest_direction`: of the bond when it was made, in body
/// axes.
template <class Law, class Real>
constexpr BeamResponse<Real> flow_response(FlowRule rule, const YieldCurve<Law, Real>& yield,
                                           const YieldingBeam<Real>& beam,
                                           const BeamHistory<Real>& history,
                                           const Vector3<Real>& rest_direction,
                                           const BeamEnds<Real>& ends) {
  const auto& [chord, i, j] = ends;
  const BeamPose<Real> pose = beam_pose(chord, history.normal_i, history.normal_j, i, j);
  const BeamPose<Real> whole = beam_pose(chord, rest_direction, i, j);
  const PosedBeam<Real> at{{pose, elastic_deformation(beam.rest_length, pose, history)},
                           {whole, beam_deformation(beam.rest_length, whole)},
                           i,
                           j};
  BeamResponse<Real> response =
      flow_response<Law, Real>(rule, yield, beam, history, at, detail::turned(i, history.last));
  response.history.last = detail::turned(conjugate(i), response.history.last);
  return response;
}

}  // namespace solidem

#endif
