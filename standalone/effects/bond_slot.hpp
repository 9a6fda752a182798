// SPDX-License-Identifier: GPL-2.0-or-later
//
// One bond, read by who looks: not for hot loops, which read packs of them.
#ifndef SOLIDEM_EFFECTS_BOND_SLOT_HPP
#define SOLIDEM_EFFECTS_BOND_SLOT_HPP

#include <cstddef>
#include <cstdint>

#include "effects/bond_state.hpp"
#include "effects/kernels/kernels.hpp"
#include "model/slots.hpp"

namespace solidem {

inline Vector pose_centre(const double* row) {
  return {row[0], row[1], row[2]};
}
inline Quaternion<double> pose_orientation(const double* row) {
  return {row[4], {row[5], row[6], row[7]}};
}

/// A slot of a bond, as load_bond() reads it: 0 of a column that nobody asked for.
struct SlotReader {
  std::size_t row;
  int lane;
  double number(const double* column, int components = 1, int component = 0) const {
    if (column == nullptr) return 0;
    return column[(static_cast<std::size_t>(components) * row +
                   static_cast<std::size_t>(component)) *
                      lanes +
                  static_cast<std::size_t>(lane)];
  }
  Vector vector(const double* column) const {
    return {number(column, 3, 0), number(column, 3, 1), number(column, 3, 2)};
  }
};

/// Where the ends of a bond stand in a buffer of poses.
inline BeamEnds<double> ends_in(const double* poses, const BeamMotion& m, const SlotReader& slot,
                                std::int32_t i, std::int32_t j) {
  const double* row_i = poses + std::ptrdiff_t{8} * i;
  const double* row_j = poses + std::ptrdiff_t{8} * j;
  Vector chord = pose_centre(row_j) - pose_centre(row_i);
  if (m.image_shift != nullptr) chord += slot.vector(m.image_shift);
  return {chord, pose_orientation(row_i), pose_orientation(row_j)};
}

/// How the bonds of some columns are read.
inline BondKind bond_kind(const BeamMotion& m) {
  return {m.has_rotation, m.bond_rigidity != nullptr, m.watch == Watch::remembering};
}

/// A bond as it stands before any flow, whose ends are those.
inline BondNow<double> bond_in(const BeamMotion& m, const SlotReader& slot,
                               const BeamEnds<double>& ends) {
  const auto& [chord, q_i, q_j] = ends;
  return load_bond(bond_kind(m), m, slot, true, chord, q_i, conjugate(q_i), q_j);
}

/// What elements feel of a bond, and energies, J.
struct BondEffort {
  BeamLoad<double> load;
  double energy, plastic_work;
};

/// The same of a bond that keeps its shape.
inline BondEffort elastic_effort(const BondNow<double>& bond) {
  return {beam_load(bond.rigidity, bond.pose, bond.deformation),
          beam_energy(bond.rigidity, bond.pose, bond.deformation), 0};
}

}  // namespace solidem

#endif
