// SPDX-License-Identifier: GPL-2.0-or-later
//
// Loads of bonds gathered element by element, fused with the time step: flow, force, kick and drift
// in one pass. Specialised at compile time on what a scene asks for.
#ifndef SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP
#define SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP

#include <type_traits>
#include <utility>
#include <variant>

#include "effects/bond_state.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/kernels/pack.hpp"
#include "effects/kernels/pack_vector.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

inline PackVector centre(const Row& row) {
  return {row.component[0], row.component[1], row.component[2]};
}

inline Quaternion<Pack> orientation(const Row& row) {
  return {row.component[4], {row.component[5], row.component[6], row.component[7]}};
}

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
template <bool rotation, bool history>
struct LimitedKind {
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

/// What a pack of slots does to its elements.
struct SlotLoad {
  PackVector force, moment;
  Pack work;  ///< half of the plastic work of this step
};

/// A law by which no bond flows.
struct NoFlow {};

/// The ends of a pack of bonds and what their laws need.
struct LimitedBonds {
  BondPack bond;
  YieldingBeam<Pack> beam;
  Rotation<Pack> rotation;
  Quaternion<Pack> turned, other_turned;
};

template <class Kind>
inline LimitedBonds limited_bonds(Kind kind, const BeamMotion& m, const double* poses,
                                  std::size_t element, const SlotPlace& slot) {
  const Row own = Row::load(poses + 8 * element);
  const Row other = Row::gather(poses, m.neighbour + slot.of(1));
  PackVector chord = centre(other) - centre(own);
  if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
  const Quaternion<Pack> turned = orientation(own), other_turned = orientation(other);
  const Rotation<Pack> rotation(turned);
  const BondPack bond = load_bond(kind, m, slot, chord, rotation, conjugate(turned), other_turned);
  const auto [radius, shear_ratio] = radius_and_shear_ratio(kind, m, slot, bond);
  return {
      bond,
      {bond.rigidity, bond.rest_length, radius, shear_ratio, m.yield_section, m.rupture_section},
      rotation,
      turned,
      other_turned};
}

/// What bonds do under the scaled offset, which looks at the deformation since they were made.
template <class Kind, class Law>
inline BeamResponse<Pack> scaled_offset_of(Kind kind, const YieldCurve<Law, Pack>& yield,
                                           const BeamMotion& m, const SlotPlace& slot,
                                           const LimitedBonds& at) {
  const BondPack& bond = at.bond;
  const auto whole = since_made(kind, m, slot, bond, at.rotation, at.other_turned);
  return scaled_offset_response(yield, at.beam, bond.history, bond.pose, bond.deformation,
                                whole.pose, whole.deformation, at.turned, at.other_turned);
}

/// What bonds remember of the last pose.
template <class Kind>
inline void remember_last(Kind kind, const BeamMotion& m, const SlotPlace& slot,
                          const LimitedBonds& last, BeamHistory<Pack>& history) {
  history.last = beam_modes(last.bond.pose, last.bond.deformation, last.turned);
  const JudgedSection section = last.beam.yield_section;
  if (m.flow_rule != FlowRule::scaled_offset) {
    history.last_strain =
        equivalent_strain(section, last.beam, last.bond.pose, last.bond.deformation);
    return;
  }
  const auto whole = since_made(kind, m, slot, last.bond, last.rotation, last.other_turned);
  history.last_strain = equivalent_strain(section, last.beam, whole.pose, whole.deformation);
}

/// What bonds do by the rule that the scene names.
template <class Kind, class Law>
inline BeamResponse<Pack> response_of(Kind kind, const YieldCurve<Law, Pack>& yield,
                                      const BeamMotion& m, const SlotPlace& slot,
                                      const LimitedBonds& at) {
  const auto& [bond, beam, rotation, turned, other_turned] = at;
  switch (m.flow_rule) {
    case FlowRule::scaled_offset:
      return scaled_offset_of(kind, yield, m, slot, at);
    case FlowRule::associated:
      return associated_response(yield, beam, bond.history, bond.pose, bond.deformation, turned,
                                 other_turned);
    case FlowRule::radial_return:
      break;
  }
  return radial_return_response(yield, beam, bond.history, bond.pose, bond.deformation, turned,
                                other_turned);
}

/// Keeps the history of lanes that flow.
template <class Kind>
inline void keep(Kind kind, const BeamMotion& m, const SlotPlace& slot, Mask flowing,
                 const BeamHistory<Pack>& before, const BeamHistory<Pack>& after) {
  select(flowing, after.strain, before.strain).store(m.plastic_strain + slot.of(1));
  select(flowing, after.extension, before.extension).store(m.plastic_extension + slot.of(1));
  if (!kind.has_rotation) return;
  store_vector(select(flowing, after.normal_i, before.normal_i), m.section_normal + slot.of(3));
  store_vector(select(flowing, after.normal_j, before.normal_j), m.far_section_normal + slot.of(3));
  select(flowing, after.twist, before.twist).store(m.plastic_twist + slot.of(1));
}

template <class Law>
inline void refresh_limit(const Law& law, const BeamMotion& m, const SlotPlace& slot, Mask flowing,
                          const Pack& plastic_strain) {
  if (m.look_at_all) return;
  const Pack limit = smaller_of(strain_before_flow(law, m.flow_rule, plastic_strain),
                                strain_before_rupture(m.rupture, plastic_strain));
  double* column = m.limit_strain + slot.of(1);
  select(flowing, limit, Pack::load(column)).store(column);
}

/// Reports the lanes that break.
inline void report(const BeamMotion& m, const SlotPlace& slot, Mask present,
                   const BondStrain<Pack>& strain) {
  const Mask breaking = both(present, breaks(*m.rupture, strain));
  if (!any(breaking)) return;
  for (int k = 0; k < width; ++k)
    if (breaking[k])
      m.breaking->push_back(static_cast<std::uint32_t>(slot.of(1)) + static_cast<std::uint32_t>(k));
}

inline BondStrain<Pack> select(Mask condition, const BondStrain<Pack>& a,
                               const BondStrain<Pack>& b) {
  return {select(condition, a.equivalent, b.equivalent), select(condition, a.plastic, b.plastic),
          select(condition, a.normal, b.normal), select(condition, a.bending, b.bending),
          select(condition, a.twist, b.twist)};
}

inline BondStrain<Pack> strain_of(const LimitedBonds& at) {
  const auto& [bond, beam, rotation, turned, other_turned] = at;
  return bond_strain(beam, bond.pose, bond.deformation,
                     equivalent_strain(beam.yield_section, beam, bond.pose, bond.deformation),
                     bond.history.strain);
}

/// Loads of bonds of which some may have reached a limit: they flow, which is kept, and those that
/// break are reported. Apart from the hot loop, whose registers it would take; all that it calls is
/// part of it, for compilers take what is seldom called for cold and copy packs through memory.
template <class Law, class Kind>
[[gnu::noinline, gnu::flatten]] SlotLoad limited_load(const BeamMotion& m, std::size_t element,
                                                      const SlotPlace& slot) {
  const Kind kind{m.bond_rigidity != nullptr};
  LimitedBonds at = limited_bonds(kind, m, m.pose, element, slot);
  BondPack& bond = at.bond;
  if (kind.remembers) bond.history.strain = Pack::load(m.plastic_strain + slot.of(1));
  const Mask present = is_bond(bond);
  if constexpr (std::is_same_v<Law, NoFlow>) {
    const BeamLoad<Pack> load = load_of(kind, bond);
    if (m.rupture != nullptr) report(m, slot, present, strain_of(at));
    return {load.force, load.moment_i, {}};
  } else {
    const Law& law = *std::get_if<Law>(m.yield);
    const YieldCurve<Law, Pack> yield{law};
    const LimitedBonds last = limited_bonds(kind, m, m.last_pose, element, slot);
    const bool offset = m.flow_rule == FlowRule::scaled_offset;
    remember_last(kind, m, slot, last, bond.history);
    const BeamResponse<Pack> response = response_of(kind, yield, m, slot, at);
    const BeamHistory<Pack>& before = bond.history;
    const BeamHistory<Pack>& after = response.history;
    const Mask flowing = both(present, greater(after.strain, before.strain));
    SlotLoad result{response.load.force, response.load.moment_i, {}};
    if (offset) {
      // Lanes that do not flow keep the shape they had, which is not that of the response; an empty
      // slot may flow and be the only one.
      const BeamLoad<Pack> kept = load_of(kind, bond);
      result.force = select(flowing, result.force, kept.force);
      result.moment = select(flowing, result.moment, kept.moment_i);
    }
    if (any(flowing)) {
      result.work = select(flowing, Pack(0.5) * response.plastic_work, Pack(0.0));
      keep(kind, m, slot, flowing, before, after);
      refresh_limit(law, m, slot, flowing, after.strain);
    }
    if (m.rupture != nullptr)
      report(m, slot, present,
             offset ? select(flowing, response.strains, strain_of(at)) : response.strains);
    return result;
  }
}

using LimitedLoad = SlotLoad (*)(const BeamMotion&, std::size_t element, const SlotPlace&);

/// Chosen once, outside the loops: they do not grow with the table of laws.
template <bool has_rotation>
LimitedLoad limited_load_by_law(const BeamMotion& m) {
  if (m.yield == nullptr)
    return m.watch == Watch::remembering ? limited_load<NoFlow, LimitedKind<has_rotation, true>>
                                         : limited_load<NoFlow, LimitedKind<has_rotation, false>>;
  return std::visit(
      [](const auto& law) -> LimitedLoad {
        return limited_load<std::decay_t<decltype(law)>, LimitedKind<has_rotation, true>>;
      },
      *m.yield);
}

inline LimitedLoad limited_load_of(const BeamMotion& m) {
  return m.has_rotation ? limited_load_by_law<true>(m) : limited_load_by_law<false>(m);
}

template <bool has_rotation, bool per_bond_rigidity, Watch watch>
void move_beams(const BeamMotion& m, LimitedLoad limited_load, std::size_t first,
                std::size_t last) {
  constexpr CompiledFor<has_rotation, per_bond_rigidity, watch> kind{};
  // Far enough ahead for a neighbour's line to arrive, near enough to be still there.
  constexpr std::size_t rows_ahead = 2;
  const std::size_t end_row = m.first_row[last];
  for (std::size_t block = first; block < last; ++block) {
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Row own = Row::load(m.pose + 8 * element);
      const PackVector position = centre(own);
      const Quaternion<Pack> turned = orientation(own);
      const Quaternion<Pack> turned_back = conjugate(turned);
      const Rotation<Pack> rotation(turned);
      PackVector force{}, moment{};
      Pack work{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        if (row + rows_ahead < end_row)
          for (int k = 0; k < width; ++k)
            __builtin_prefetch(
                m.pose +
                std::ptrdiff_t{8} *
                    m.neighbour[slot.of(1) + rows_ahead * lanes + static_cast<std::size_t>(k)]);
        const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
        PackVector chord = centre(other) - position;
        if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
        const Quaternion<Pack> other_turned = orientation(other);
        const BondPack bond = load_bond(kind, m, slot, chord, rotation, turned_back, other_turned);
        if constexpr (watch != Watch::elastic) {
          if (__builtin_expect(any(limited(kind, m, slot, bond)), 0)) {
            const SlotLoad load = limited_load(m, element, slot);
            force += load.force;
            moment += load.moment;
            work += load.work;
            continue;
          }
        }
        const BeamLoad<Pack> load = load_of(kind, bond);
        force += load.force;
        if constexpr (has_rotation) moment += load.moment_i;
      }
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      const PackVector velocity = load_vector(m.velocity + at) +
                                  (Pack(m.kick) * Pack::load(m.inverse_mass + element)) * force;
      store_vector(velocity, m.velocity + at);
      const PackVector moved = position + Pack(m.drift) * velocity;
      Quaternion<Pack> now = turned;
      if constexpr (has_rotation) {
        const PackVector spin = load_vector(m.angular_velocity + at) +
                                (Pack(m.kick) * Pack::load(m.inverse_inertia + element)) * moment;
        store_vector(spin, m.angular_velocity + at);
        now = turn(turned, spin, Pack(m.drift));
      }
      const Row next{
          {moved.x, moved.y, moved.z, own.component[3], now.w, now.v.x, now.v.y, now.v.z}};
      next.store(m.next_pose + 8 * element);
      if constexpr (watch == Watch::remembering)
        // The scaled offset may give work back.
        if (any(either(greater(work, Pack(0.0)), greater(Pack(0.0), work))))
          (Pack::load(m.plastic_work + element) + work).store(m.plastic_work + element);
    }
  }
}

inline Vector3<FloatPack> half(const PackVector& v) {
  return {FloatPack(v.x), FloatPack(v.y), FloatPack(v.z)};
}

inline Quaternion<FloatPack> half(const Quaternion<Pack>& q) {
  return {FloatPack(q.w), half(q.v)};
}

inline PackVector whole(const Vector3<FloatPack>& v) {
  return {v.x.whole(), v.y.whole(), v.z.whole()};
}

/// Elastic beams, all alike, whose law is evaluated in single precision: chords are taken, and
/// loads summed and integrated, in double. Lengths are measured in elements' radii and loads in
/// those of unit strain, so that no figure leaves the range of a float.
inline void move_beams_in_single_precision(const BeamMotion& m, std::size_t first,
                                           std::size_t last) {
  const double unit = m.length_unit, per_unit = 1 / unit;
  const double unit_force = m.rigidity.axial;
  const BeamRigidity<FloatPack> rigidity{
      FloatPack(1.0), FloatPack(m.rigidity.bending / (unit_force * unit * unit)),
      FloatPack(m.rigidity.shear / (unit_force * unit * unit)),
      FloatPack(m.rigidity.torsion / (unit_force * unit * unit))};
  for (std::size_t block = first; block < last; ++block) {
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Row own = Row::load(m.pose + 8 * element);
      const PackVector position = centre(own);
      const Quaternion<Pack> turned = orientation(own);
      const Quaternion<FloatPack> half_turned = half(turned);
      const Quaternion<FloatPack> turned_back = conjugate(half_turned);
      const Rotation<FloatPack> rotation(half_turned);
      PackVector force{}, moment{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
        PackVector chord = centre(other) - position;
        if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
        const Quaternion<FloatPack> other_turned = half(orientation(other));
        const Vector3<FloatPack> direction = half(load_vector(m.rest_direction + slot.of(3)));
        const BeamPose<FloatPack> pose{half(Pack(per_unit) * chord), rotate(rotation, direction),
                                       rotate(other_turned, direction), other_turned * turned_back};
        const FloatPack rest_length(Pack(per_unit) * Pack::load(m.rest_length + slot.of(1)));
        BeamDeformation<FloatPack> deformation = beam_deformation(rest_length, pose);
        // The one difference of nearly equal figures is taken in double.
        const Pack length = sqrt(dot(chord, chord));
        deformation.extension =
            FloatPack(Pack(per_unit) * (length - Pack::load(m.rest_length + slot.of(1))));
        const BeamLoad<FloatPack> load = beam_load(rigidity, pose, deformation);
        force += whole(load.force);
        moment += whole(load.moment_i);
      }
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      const PackVector velocity =
          load_vector(m.velocity + at) +
          (Pack(m.kick * unit_force) * Pack::load(m.inverse_mass + element)) * force;
      const PackVector spin =
          load_vector(m.angular_velocity + at) +
          (Pack(m.kick * unit_force * unit) * Pack::load(m.inverse_inertia + element)) * moment;
      store_vector(velocity, m.velocity + at);
      store_vector(spin, m.angular_velocity + at);
      const PackVector moved = position + Pack(m.drift) * velocity;
      const Quaternion<Pack> now = turn(turned, spin, Pack(m.drift));
      const Row next{
          {moved.x, moved.y, moved.z, own.component[3], now.w, now.v.x, now.v.y, now.v.z}};
      next.store(m.next_pose + 8 * element);
    }
  }
}

using MoveBeams = void (*)(const BeamMotion&, LimitedLoad, std::size_t first, std::size_t last);

/// Every loop there is, by rotation, rigidity per bond and what is watched.
inline constexpr MoveBeams beam_loops[2][2][3] = {
    {{move_beams<false, false, Watch::elastic>, move_beams<false, false, Watch::watched>,
      move_beams<false, false, Watch::remembering>},
     {move_beams<false, true, Watch::elastic>, move_beams<false, true, Watch::watched>,
      move_beams<false, true, Watch::remembering>}},
    {{move_beams<true, false, Watch::elastic>, move_beams<true, false, Watch::watched>,
      move_beams<true, false, Watch::remembering>},
     {move_beams<true, true, Watch::elastic>, move_beams<true, true, Watch::watched>,
      move_beams<true, true, Watch::remembering>}}};
static_assert(sizeof beam_loops / sizeof(MoveBeams) <= 12,
              "loops of beams grow with what bonds are, not with the laws they yield and break by");

inline void move_beams_by_kind(const BeamMotion& m, std::size_t first, std::size_t last) {
  if (m.single_precision) return move_beams_in_single_precision(m, first, last);
  const MoveBeams move = beam_loops[m.has_rotation ? 1 : 0][m.bond_rigidity != nullptr ? 1 : 0]
                                   [static_cast<int>(m.watch)];
  move(m, limited_load_of(m), first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
