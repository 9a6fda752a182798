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

/// A law by which no bond flows.
struct NoFlow {};

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

/// Their ends in the last pose, and how they have turned since.
struct OwnLastEnds {
  PackVector position;
  Quaternion<Pack> turn;
  Rotation<Pack> rotation;
  OwnLastEnds(const Row& row, const Quaternion<Pack>& turned)
      : position(centre(row)), turn(turned * conjugate(orientation(row))), rotation(turn) {}
};

inline PackVector chord_to(const BeamMotion& m, const SlotPlace& slot, const PackVector& position,
                           const Row& other) {
  PackVector chord = centre(other) - position;
  if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
  return chord;
}

/// A pack of bonds and what their laws need.
struct LimitedBonds {
  BondPack bond;
  YieldingBeam<Pack> beam;
  Quaternion<Pack> other_turned;
};

template <class Kind>
inline LimitedBonds limited_bonds(Kind kind, const BeamMotion& m, const OwnEnds& own,
                                  const SlotPlace& slot) {
  const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
  const Quaternion<Pack> other_turned = orientation(other);
  BondPack bond = load_bond(kind, m, slot, true, chord_to(m, slot, own.position, other),
                            own.rotation, own.turned_back, other_turned);
  if (kind.remembers) bond.history.strain = Pack::load(m.plastic_strain + slot.of(1));
  const auto [radius, shear_ratio] = radius_and_shear_ratio(kind, m, slot, bond);
  return {
      bond,
      {bond.rigidity, bond.rest_length, radius, shear_ratio, m.yield_section, m.rupture_section},
      other_turned};
}

/// Elastic deformation of bonds in the last pose.
template <class Kind>
inline BeamModes<Pack> last_of(Kind kind, const BeamMotion& m, const SlotPlace& slot,
                               const BondPack& bond, const OwnEnds& own,
                               const OwnLastEnds& own_last) {
  const Row other = Row::gather(m.last_pose, m.neighbour + slot.of(1));
  return last_modes(kind, bond, own.turned,
                    rotate(own_last.rotation, chord_to(m, slot, own_last.position, other)),
                    own_last.turn * orientation(other));
}

/// Temperature of bonds, where it counts: the mean of their ends'.
inline Pack temperature_of(const BeamMotion& m, const SlotPlace& slot, const OwnEnds& own) {
  if (m.temperature == nullptr) return Pack(0.0);
  return Pack(0.5) * (Pack::load(m.temperature + own.element) +
                      gather(m.temperature, m.neighbour + slot.of(1)));
}

/// Keeps how fast lanes flow.
template <class Law>
inline void keep_rate(const YieldCurve<Law, Pack>& yield, const BeamMotion& m,
                      const SlotPlace& slot, Mask flowing, const Pack& plastic_strain) {
  if constexpr (depends_on_state<Law>) {
    if (m.flow_rate == nullptr) return;
    double *rate = m.flow_rate + slot.of(1), *time = m.flow_time + slot.of(1);
    select(flowing, yield.rate(plastic_strain), Pack::load(rate)).store(rate);
    select(flowing, Pack(m.time), Pack::load(time)).store(time);
  }
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
inline void refresh_limit(const YieldCurve<Law, Pack>& yield, const BeamMotion& m,
                          const SlotPlace& slot, Mask flowing, const Pack& plastic_strain,
                          const LimitScale<Pack>& scale) {
  if (m.look_at_all) return;
  const Pack limit = smaller_of(strain_before_flow(yield, m.flow_rule, plastic_strain),
                                strain_before_rupture(m.rupture, plastic_strain, scale));
  double* column = m.limit_strain + slot.of(1);
  select(flowing, -limit, Pack::load(column)).store(column);
}

/// The limits of a pack of bonds over those of the laws.
template <class Kind>
inline LimitScale<Pack> scale_of(Kind kind, const BeamMotion& m, const SlotPlace& slot) {
  if constexpr (kind.has_own_limits) return limit_scale<Pack>(m, slot);
  return {};
}

/// Reports the lanes that break.
inline void report(const BeamMotion& m, const SlotPlace& slot, Mask present,
                   const BondStrain<Pack>& strain, const LimitScale<Pack>& scale) {
  const Mask breaking = both(present, breaks(*m.rupture, strain, scale));
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
  const auto& [bond, beam, other_turned] = at;
  return bond_strain(beam, bond.pose, bond.deformation,
                     equivalent_strain(beam.yield_section, beam, bond.pose, bond.deformation),
                     bond.history.strain);
}

/// Loads of bonds that do not flow; those that break are reported.
template <class Kind>
inline SlotLoad unflowing_load(Kind kind, const BeamMotion& m, const SlotPlace& slot,
                               const LimitedBonds& at) {
  const BeamLoad<Pack> load = load_of(kind, at.bond);
  if (m.rupture != nullptr)
    report(m, slot, is_bond(at.bond), strain_of(at), scale_of(kind, m, slot));
  return {load.force, load.moment_i, {}};
}

/// Loads of bonds of which some may flow, which is kept; those that break are reported.
template <FlowRule rule, class Law, class Kind>
inline SlotLoad flowing_load(Kind kind, const Law& law, const BeamMotion& m, const SlotPlace& slot,
                             const LimitedBonds& at, const OwnEnds& own,
                             const OwnLastEnds& own_last) {
  const BondPack& bond = at.bond;
  const BeamHistory<Pack>& before = bond.history;
  const PosedBeam<Pack> posed =
      posed_beam(kind, m, slot, rule, bond, own.rotation, own.turned, at.other_turned);
  Pack temperature(0.0);
  if constexpr (depends_on_state<Law>) temperature = temperature_of(m, slot, own);
  const YieldCurve<Law, Pack> yield = yield_curve(law, m, slot, temperature, before.strain);
  const BeamFlow<Pack> flow = beam_flow<rule>(yield, at.beam, before.strain, posed);
  const Mask present = is_bond(bond), flowing = both(present, greater(flow.strain, before.strain));
  if (!any(flowing)) return unflowing_load(kind, m, slot, at);
  const BeamResponse<Pack> response =
      flowed_response(at.beam, before, posed, flow, last_of(kind, m, slot, bond, own, own_last));
  SlotLoad result{response.load.force, response.load.moment_i,
                  select(flowing, Pack(0.5) * response.plastic_work, Pack(0.0))};
  BondStrain<Pack> strains = response.strains;
  if (rule == FlowRule::scaled_offset) {
    // Lanes that do not flow keep the shape they had, which is not that of the response.
    const BeamLoad<Pack> kept = load_of(kind, bond);
    result.force = select(flowing, result.force, kept.force);
    result.moment = select(flowing, result.moment, kept.moment_i);
    strains = select(flowing, strains, strain_of(at));
  }
  keep(kind, m, slot, flowing, before, response.history);
  keep_rate(yield, m, slot, flowing, flow.strain);
  refresh_limit(yield, m, slot, flowing, flow.strain, scale_of(kind, m, slot));
  if (m.rupture != nullptr) report(m, slot, present, strains, scale_of(kind, m, slot));
  return result;
}

/// Far enough ahead for a neighbour's line to arrive, near enough to be still there.
inline constexpr std::size_t rows_ahead = 2;

/// Asks for the lines of the neighbours of a row.
inline void prefetch(const BeamMotion& m, const double* poses, std::size_t slot) {
  for (int k = 0; k < width; ++k)
    __builtin_prefetch(poses + std::ptrdiff_t{8} * m.neighbour[slot + static_cast<std::size_t>(k)]);
}

/// Rows of slots that were added up.
struct RowSum {
  SlotLoad load;
  std::size_t end;  ///< of the rows
};

/// Adds the loads of a row of bonds of which some may have reached a limit, and of the rows after
/// it for which the same holds. Apart from the hot loop, whose registers it would take; all that it
/// calls is part of it, for compilers take what is seldom called for cold and copy packs through
/// memory.
template <class Law, class Kind>
[[gnu::noinline, gnu::flatten]] RowSum limited_rows(const BeamMotion& m, std::size_t element,
                                                    SlotPlace slot, std::size_t end_row,
                                                    const SlotLoad& so_far) {
  constexpr bool flows = !std::is_same_v<Law, NoFlow>;
  const Kind kind{m.bond_rigidity != nullptr};
  const OwnEnds own(element, Row::load(m.pose + 8 * element));
  const OwnLastEnds own_last(Row::load((flows ? m.last_pose : m.pose) + 8 * element), own.turned);
  SlotLoad sum = so_far;
  for (const std::size_t first = slot.row; slot.row < end_row; ++slot.row) {
    if (slot.row + rows_ahead < end_row) {
      prefetch(m, m.pose, slot.of(1) + rows_ahead * lanes);
      if (flows) prefetch(m, m.last_pose, slot.of(1) + rows_ahead * lanes);
    }
    const LimitedBonds at = limited_bonds(kind, m, own, slot);
    if (slot.row > first && !any(limited(kind, m, slot, at.bond))) break;
    if constexpr (flows) {
      const Law& law = *std::get_if<Law>(m.yield);
      sum = sum + by_rule(m.flow_rule, [&](auto rule) {
              constexpr FlowRule known = decltype(rule)::value;
              if constexpr (Kind::has_own_limits) {
                const ScaledLaw<Law, Pack> scaled{law, scale_of(kind, m, slot)};
                return flowing_load<known>(kind, scaled, m, slot, at, own, own_last);
              } else {
                return flowing_load<known>(kind, law, m, slot, at, own, own_last);
              }
            });
    } else {
      sum = sum + unflowing_load(kind, m, slot, at);
    }
  }
  return {sum, slot.row};
}

using LimitedRows = RowSum (*)(const BeamMotion&, std::size_t element, SlotPlace,
                               std::size_t end_row, const SlotLoad& so_far);

/// Chosen once, outside the loops: they do not grow with the table of laws.
template <bool has_rotation, bool own_limits>
LimitedRows limited_rows_by_law(const BeamMotion& m) {
  using Remembering = LimitedKind<has_rotation, true, own_limits>;
  if (m.yield == nullptr)
    return m.watch == Watch::remembering
               ? limited_rows<NoFlow, Remembering>
               : limited_rows<NoFlow, LimitedKind<has_rotation, false, own_limits>>;
  return std::visit(
      [](const auto& law) -> LimitedRows {
        return limited_rows<std::decay_t<decltype(law)>, Remembering>;
      },
      *m.yield);
}

inline LimitedRows limited_rows_of(const BeamMotion& m) {
  const bool own_limits = m.bond_limits != nullptr;
  if (m.has_rotation)
    return own_limits ? limited_rows_by_law<true, true>(m) : limited_rows_by_law<true, false>(m);
  return own_limits ? limited_rows_by_law<false, true>(m) : limited_rows_by_law<false, false>(m);
}

template <bool has_rotation, bool per_bond_rigidity, Watch watch>
void move_beams(const BeamMotion& m, LimitedRows limited_rows, std::size_t first,
                std::size_t last) {
  constexpr CompiledFor<has_rotation, per_bond_rigidity, watch> kind{};
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
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1];) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        if (row + rows_ahead < end_row) prefetch(m, m.pose, slot.of(1) + rows_ahead * lanes);
        const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
        PackVector chord = centre(other) - position;
        if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
        const Quaternion<Pack> other_turned = orientation(other);
        const BondPack bond = load_bond(kind, m, slot, has_shape(kind, m, slot), chord, rotation,
                                        turned_back, other_turned);
        if constexpr (watch != Watch::elastic) {
          if (__builtin_expect(any(limited(kind, m, slot, bond)), 0)) {
            const RowSum sum =
                limited_rows(m, element, slot, m.first_row[block + 1], {force, moment, work});
            force = sum.load.force;
            moment = sum.load.moment;
            work = sum.load.work;
            row = sum.end;
            continue;
          }
        }
        const BeamLoad<Pack> load = load_of(kind, bond);
        force += load.force;
        if constexpr (has_rotation) moment += load.moment_i;
        ++row;
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

using MoveBeams = void (*)(const BeamMotion&, LimitedRows, std::size_t first, std::size_t last);

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
  move(m, limited_rows_of(m), first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
