// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a bond keeps in its slot. One table says of each column who needs it, what an empty slot
// holds and what a bond holds when it is made; one function reads a bond, for the hot loops (Real:
// a pack) and for who looks (double).
#ifndef SOLIDEM_EFFECTS_BOND_STATE_HPP
#define SOLIDEM_EFFECTS_BOND_STATE_HPP

#include "laws/beam_plasticity.hpp"

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

/// Reads the bond in a slot. `Motion`: its columns, see BeamMotion; `Slot`: reads a number or a
/// vector of a column. `turned`: of the element, as a quaternion or as a rotation; `turned_back`
/// its conjugate.
template <class Kind, class Motion, class Slot, class Real, class Turned>
inline BondNow<Real> load_bond(Kind kind, const Motion& m, const Slot& slot,
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
  if (kind.remembers) history.extension = slot.number(m.plastic_extension);
  if (kind.has_rotation) {
    if (kind.remembers) {
      history.normal_i = slot.vector(m.section_normal);
      history.normal_j = slot.vector(m.far_section_normal);
      history.twist = slot.number(m.plastic_twist);
    } else {
      history.normal_i = history.normal_j = slot.vector(m.rest_direction);
    }
    bond.pose = {chord, rotate(turned, history.normal_i), rotate(other_turned, history.normal_j),
                 other_turned * turned_back};
    bond.deformation = beam_deformation(bond.rest_length, bond.pose);
  } else {
    bond.pose.chord = chord;
    bond.deformation = spring_deformation(bond.rest_length, chord);
  }
  if (kind.remembers) {
    bond.deformation.extension = bond.deformation.extension - history.extension;
    if (kind.has_rotation) bond.deformation.twist = bond.deformation.twist - history.twist;
  }
  return bond;
}

/// The pose of a bond and its deformation since it was made.
template <class Real>
struct BondSinceMade {
  BeamPose<Real> pose;
  BeamDeformation<Real> deformation;
};

template <class Kind, class Motion, class Slot, class Real, class Turned>
inline BondSinceMade<Real> since_made(Kind kind, const Motion& m, const Slot& slot,
                                      const BondNow<Real>& bond, const Turned& turned,
                                      const Quaternion<Real>& other_turned) {
  BondSinceMade<Real> whole{bond.pose, {}};
  if (kind.has_rotation) {
    const Vector3<Real> rest_direction = slot.vector(m.rest_direction);
    whole.pose.normal_i = rotate(turned, rest_direction);
    whole.pose.normal_j = rotate(other_turned, rest_direction);
    whole.deformation = beam_deformation(bond.rest_length, whole.pose);
  } else {
    whole.deformation = spring_deformation(bond.rest_length, bond.pose.chord);
  }
  return whole;
}

}  // namespace solidem

#endif
