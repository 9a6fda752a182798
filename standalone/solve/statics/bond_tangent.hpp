// SPDX-License-Identifier: GPL-2.0-or-later
//
// How the loads of a bond change with the motion of its ends: exact derivatives of laws/beam.hpp by
// dual numbers. There is no second, hand-written stiffness.
#ifndef SOLIDEM_SOLVE_STATICS_BOND_TANGENT_HPP
#define SOLIDEM_SOLVE_STATICS_BOND_TANGENT_HPP

#include <Eigen/Core>

#include "laws/beam.hpp"
#include "laws/dual.hpp"

namespace solidem {

/// A bond in a state: what it is and where its ends stand.
struct BondState {
  BeamRigidity<double> rigidity;
  double rest_length;              ///< m
  Vector3<double> rest_direction;  ///< unit, from i to j
  Vector3<double> chord;           ///< now, m
  Quaternion<double> orientation_i, orientation_j;

  BeamPose<double> pose() const {
    return beam_pose(chord, rest_direction, orientation_i, orientation_j);
  }
  BeamLoad<double> load() const { return beam_load(rigidity, rest_length, pose()); }
  double energy() const { return beam_energy(rigidity, rest_length, pose()); }
};

/// An infinitesimal motion of the ends, or a derivative along one.
struct BondMotion {
  Vector3<double> chord;           ///< displacement of j less that of i, m
  Vector3<double> spin_i, spin_j;  ///< turns of the ends in world axes, rad
};

/// The derivative of the bond's loads along a motion of its ends.
BeamLoad<double> load_rate(const BondState& bond, const BondMotion& motion);

/// The second derivatives of the bond's energy by the motion of its ends, symmetric and free of the
/// order of turns: rows and columns are displacement and turn of i, then of j. N/m, N, N·m.
using BondTangent = Eigen::Matrix<double, 12, 12>;
BondTangent tangent(const BondState& bond);

}  // namespace solidem

#endif
