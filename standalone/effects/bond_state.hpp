// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a bond keeps in its slot. One table says of each column who needs it, what an empty slot
// holds and what a bond holds when it is made; one function reads a bond, for the hot loops (Real:
// a pack) and for who looks (double).
#ifndef SOLIDEM_EFFECTS_BOND_STATE_HPP
#define SOLIDEM_EFFECTS_BOND_STATE_HPP

#include <cmath>

#include "laws/beam_flow.hpp"

namespace solidem {

/// How bonds are read: known when it is compiled or when it runs.
struct BondKind {
  bool has_rotation, per_bond_rigidity, remembers;
};

/// A bond as it stands before any flow.
template <class Real>
struct BondNow {
  BeamRigidity<Real> rigidity;
  Real rest_length;
  BeamPose<Real> pose;
  BeamDeformation<Real> deformation;  ///< elastic
  BeamHistory<Real> history;          ///< without the plastic strain and the last deformation
};

/// What a pose is to the shape that a bond remembers.
template <class Kind, class Real>
inline BeamDeformation<Real> deformation_in(Kind kind, const BondNow<Real>& bond,
                                            const BeamPose<Real>& pose) {
  BeamDeformation<Real> deformation = kind.has_rotation
                                          ? beam_deformation(bond.rest_length, pose)
                                          : spring_deformation(bond.rest_length, pose.chord);
  if (!kind.remembers) return deformation;
  deformation.extension = deformation.extension - bond.history.extension;
  if (kind.has_rotation) deformation.twist = deformation.twist - bond.history.twist;
  return deformation;
}

/// The limits of the bond in a slot over those of the laws.
template <class Real, class Motion, class Slot>
inline LimitScale<Real> limit_scale(const Motion& m, const Slot& slot) {
  if (m.bond_limits == nullptr) return {};
  return {false, slot.number(m.bond_limits, 3, 0), slot.number(m.bond_limits, 3, 1),
          slot.number(m.bond_limits, 3, 2)};
}

/// The yield curve of the bond in a slot, which has flowed to the plastic strain. `temperature`: of
/// the bond, K; 0 where none counts. The rate of a bond is averaged over the time that is past, the
/// less the longer ago: what is left of it fades while the bond does not flow.
template <class Law, class Real, class Motion, class Slot>
inline YieldCurve<Law, Real> yield_curve(const Law& law, const Motion& m, const Slot& slot,
                                         const Real& temperature, const Real& plastic_strain) {
  YieldCurve<Law, Real> curve{law};
  if constexpr (depends_on_state<Law>) {
    using std::exp;
    curve.state.temperature = temperature;
    if (m.flow_rate == nullptr) return curve;
    const Real since = Real(m.time) - slot.number(m.flow_time);
    curve.state.rate = slot.number(m.flow_rate) * exp(-since / Real(m.rate_time));
    curve.flow_start = plastic_strain;
    curve.rate_per_flow = Real(m.rate_per_flow);
  }
  return curve;
}

/// The rigidity of the bond in a slot, which is that of all where they are alike.
template <class Real, class Motion, class Slot>
inline BeamRigidity<Real> rigidity_in(const Motion& m, const Slot& slot) {
  if (m.bond_rigidity == nullptr)
    return {Real(m.rigidity.axial), Real(m.rigidity.bending), Real(m.rigidity.shear),
            Real(m.rigidity.torsion)};
  return {slot.number(m.bond_rigidity, 4, 0), slot.number(m.bond_rigidity, 4, 1),
          slot.number(m.bond_rigidity, 4, 2), slot.number(m.bond_rigidity, 4, 3)};
}

/// Reads the bond in a slot. `Motion`: its columns, see BeamMotion; `Slot`: reads a number or a
/// vector of a column. `has_shape`: of those that remember, whether one may have a shape of its
/// own, by flow or since it was made anew; both normals are else those of one direction. `turned`:
/// of the element, as a quaternion or as a rotation; `turned_back` its conjugate.
template <class Kind, class Motion, class Slot, class Real, class Turned>
inline BondNow<Real> load_bond(Kind kind, const Motion& m, const Slot& slot, bool has_shape,
                               const Vector3<Real>& chord, const Turned& turned,
                               const Quaternion<Real>& turned_back,
                               const Quaternion<Real>& other_turned) {
  BondNow<Real> bond{};
  bond.rigidity = {Real(m.rigidity.axial), Real(m.rigidity.bending), Real(m.rigidity.shear),
                   Real(m.rigidity.torsion)};
  if (kind.per_bond_rigidity)
    bond.rigidity = {slot.number(m.bond_rigidity, 4, 0), slot.number(m.bond_rigidity, 4, 1),
                     slot.number(m.bond_rigidity, 4, 2), slot.number(m.bond_rigidity, 4, 3)};
  bond.rest_length = slot.number(m.rest_length);
  BeamHistory<Real>& history = bond.history;
  if (kind.remembers && has_shape) history.extension = slot.number(m.plastic_extension);
  bond.pose.chord = chord;
  if (kind.has_rotation) {
    history.normal_i = history.normal_j =
        slot.vector(kind.remembers ? m.section_normal : m.rest_direction);
    if (kind.remembers && has_shape) {
      history.normal_j = slot.vector(m.far_section_normal);
      history.twist = slot.number(m.plastic_twist);
    }
    bond.pose = {chord, rotate(turned, history.normal_i), rotate(other_turned, history.normal_j),
                 other_turned * turned_back};
  }
  bond.deformation = deformation_in(kind, bond, bond.pose);
  return bond;
}

/// Of the shape that the bond was made with.
template <class Kind, class Motion, class Slot, class Real, class Turned>
inline BeamState<Real> since_made(Kind kind, const Motion& m, const Slot& slot,
                                  const BondNow<Real>& bond, const Turned& turned,
                                  const Quaternion<Real>& other_turned) {
  BeamPose<Real> pose = bond.pose;
  if (!kind.has_rotation) return {pose, spring_deformation(bond.rest_length, pose.chord)};
  const Vector3<Real> rest_direction = slot.vector(m.rest_direction);
  pose.normal_i = rotate(turned, rest_direction);
  pose.normal_j = rotate(other_turned, rest_direction);
  return {pose, beam_deformation(bond.rest_length, pose)};
}

/// The bond as rules of flow look at it.
template <class Kind, class Motion, class Slot, class Real, class Turned>
inline PosedBeam<Real, Turned> posed_beam(Kind kind, const Motion& m, const Slot& slot,
                                          FlowRule rule, const BondNow<Real>& bond,
                                          const Turned& turned,
                                          const Quaternion<Real>& other_turned) {
  return {{bond.pose, bond.deformation},
          rule == FlowRule::scaled_offset ? since_made(kind, m, slot, bond, turned, other_turned)
                                          : BeamState<Real>{},
          turned,
          other_turned};
}

/// The bond in the last pose, of the shape that it remembers now. `chord`, `other_turned`: chord
/// and orientation of the neighbour then, turned with the element to where it stands now.
template <class Kind, class Real>
inline LastBeam<Real> last_beam(Kind kind, const BondNow<Real>& bond,
                                const Quaternion<Real>& turned, const Vector3<Real>& chord,
                                const Quaternion<Real>& other_turned) {
  BeamPose<Real> pose = bond.pose;
  pose.chord = chord;
  if (kind.has_rotation) {
    pose.normal_j = rotate(other_turned, bond.history.normal_j);
    pose.relative_turn = other_turned * conjugate(turned);
  }
  return {detail::world_modes<Real>({pose, deformation_in(kind, bond, pose)}), pose.relative_turn};
}

}  // namespace solidem

#endif
