// SPDX-License-Identifier: GPL-2.0-or-later
//
// A row of slots as the loops of beams see it: where it stands, what its bonds are, what they do.
#ifndef SOLIDEM_EFFECTS_KERNELS_BEAM_SLOTS_HPP
#define SOLIDEM_EFFECTS_KERNELS_BEAM_SLOTS_HPP

#include <cstddef>
#include <utility>

#include "effects/bond_state.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"
#include "effects/kernels/pack_vector.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

/// Where a pack of slots stands in the columns of slots.
struct SlotPlace {
  std::size_t row, lane;
  std::size_t of(std::size_t components, std::size_t component = 0) const {
    return (components * row + component) * lanes + lane;
  }
  Pack number(const double* column, std::size_t components = 1, std::size_t component = 0) const {
    return Pack::load(column + of(components, component));
  }
  PackVector vector(const double* column) const { return load_vector(column + of(3)); }
};

using BondPack = BondNow<Pack>;

/// What is known of all bonds when the loop is compiled.
template <bool rotation, bool per_bond, Watch kind>
struct CompiledFor {
  static constexpr bool has_rotation = rotation;
  static constexpr bool per_bond_rigidity = per_bond;
  static constexpr bool remembers = kind == Watch::remembering;
};

/// What is known of bonds that reach a limit: the rest is asked for when they do.
template <bool rotation, bool history, bool own_limits>
struct LimitedKind {
  static constexpr bool has_own_limits = own_limits;  ///< materials differ in them
  static constexpr bool has_rotation = rotation;
  static constexpr bool remembers = history;
  bool per_bond_rigidity;
};

template <class Kind>
inline BeamLoad<Pack> load_of(Kind kind, const BondPack& bond) {
  if (kind.has_rotation) return beam_load(bond.rigidity, bond.pose, bond.deformation);
  return {spring_force(bond.rigidity, bond.deformation), {}, {}};
}

/// Radius and G / E of the bonds of a pack of slots.
template <class Kind>
inline std::pair<Pack, Pack> radius_and_shear_ratio(Kind kind, const BeamMotion& m,
                                                    const SlotPlace& slot, const BondPack& bond) {
  if (!kind.per_bond_rigidity) return {Pack(m.radius), Pack(m.shear_ratio)};
  const Pack radius = Pack::load(m.bond_radius + slot.of(1));
  // G I_0 / (E S) = G / E r² / 2, whatever the moduli of a bond are.
  return {radius, Pack(2.0) * bond.rigidity.torsion / (bond.rigidity.axial * radius * radius)};
}

inline Mask is_bond(const BondPack& bond) {
  const PackVector& x = bond.deformation.direction;
  return greater(dot(x, x), Pack(0.5));
}

/// Whether bonds of a pack may have a shape of their own: the sign of their limit tells.
template <class Kind>
inline bool has_shape(Kind kind, const BeamMotion& m, const SlotPlace& slot) {
  if (!kind.remembers) return false;
  constexpr double least = 1e-300;  // of none nothing can be told
  return any(greater(Pack(least), Pack::load(m.limit_strain + slot.of(1))));
}

/// Lanes that may have reached the limit of their bond.
template <class Kind>
inline Mask limited(Kind kind, const BeamMotion& m, const SlotPlace& slot, const BondPack& bond) {
  const auto [radius, shear_ratio] = radius_and_shear_ratio(kind, m, slot, bond);
  const Pack limit =
      kind.remembers ? Pack::load(m.limit_strain + slot.of(1)) : Pack(m.common_limit_strain);
  const Pack safe = limit * bond.rest_length;
  const Pack reached = bound_of_squared_extension(radius, shear_ratio, bond.pose, bond.deformation);
  const Mask reaching = greater(reached, safe * safe);
  // An empty slot without a limit of its own is as much shorter than at rest.
  return kind.remembers ? reaching : both(reaching, is_bond(bond));
}

/// What slots do to their elements.
struct SlotLoad {
  PackVector force, moment;
  Pack work;  ///< half of the plastic work of this step
};

inline SlotLoad operator+(const SlotLoad& a, const SlotLoad& b) {
  return {a.force + b.force, a.moment + b.moment, a.work + b.work};
}

/// The elements of a pack, as their bonds see them.
struct OwnEnds {
  std::size_t element;  ///< the first
  PackVector position;
  Quaternion<Pack> turned, turned_back;
  Rotation<Pack> rotation;
  OwnEnds(std::size_t first, const Row& row)
      : element(first),
        position(centre(row)),
        turned(orientation(row)),
        turned_back(conjugate(turned)),
        rotation(turned) {}
};

inline PackVector chord_to(const BeamMotion& m, const SlotPlace& slot, const PackVector& position,
                           const Row& other) {
  PackVector chord = centre(other) - position;
  if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
  return chord;
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
