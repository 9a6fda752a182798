// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/bond_tangent.hpp"

namespace solidem {

namespace {

Vector3<Dual> dual(const Vector3<double>& value, const Vector3<double>& derivative) {
  return {{value.x, derivative.x}, {value.y, derivative.y}, {value.z, derivative.z}};
}

/// An orientation that turns by a small `spin` in world axes.
Quaternion<Dual> dual(const Quaternion<double>& orientation, const Vector3<double>& spin) {
  const Quaternion<double> rate = Quaternion<double>{0.0, 0.5 * spin} * orientation;
  return {{orientation.w, rate.w}, dual(orientation.v, rate.v)};
}

Vector3<double> derivative(const Vector3<Dual>& v) {
  return {v.x.derivative, v.y.derivative, v.z.derivative};
}

Eigen::Vector3d as_eigen(const Vector3<double>& v) {
  return {v.x, v.y, v.z};
}

Vector3<double> unit(int axis) {
  Vector3<double> v{};
  component(v, axis) = 1;
  return v;
}

}  // namespace

BeamLoad<double> load_rate(const BondState& bond, const BondMotion& motion) {
  const BeamRigidity<Dual> rigidity{bond.rigidity.axial, bond.rigidity.bending, bond.rigidity.shear,
                                    bond.rigidity.torsion};
  const BeamPose<Dual> pose =
      beam_pose(dual(bond.chord, motion.chord), dual(bond.rest_direction, Vector3<double>{}),
                dual(bond.orientation_i, motion.spin_i), dual(bond.orientation_j, motion.spin_j));
  const BeamLoad<Dual> load = beam_load(rigidity, Dual{bond.rest_length}, pose);
  return {derivative(load.force), derivative(load.moment_i), derivative(load.moment_j)};
}

BondTangent tangent(const BondState& bond) {
  BondTangent k;
  for (int axis = 0; axis < 3; ++axis) {
    const BondMotion motions[] = {{unit(axis), {}, {}}, {{}, unit(axis), {}}, {{}, {}, unit(axis)}};
    const int columns[] = {6, 3, 9};
    for (int m = 0; m < 3; ++m) {
      const BeamLoad<double> rate = load_rate(bond, motions[m]);
      k.col(columns[m] + axis) << -as_eigen(rate.force), -as_eigen(rate.moment_i),
          as_eigen(rate.force), -as_eigen(rate.moment_j);
    }
  }
  k.leftCols<3>() = -k.middleCols<3>(6);  // moving i is moving j the other way
  // Moments change with the order of turns by what they are themselves; half of it either way is
  // the second derivative along a turn about one axis.
  return 0.5 * (k + k.transpose());
}

}  // namespace solidem
