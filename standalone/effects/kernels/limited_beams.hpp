// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bonds that have reached a limit, or flowed before: what flows, what breaks, what is kept of it.
// Apart from the hot loop, for each law and rule of flow.
#ifndef SOLIDEM_EFFECTS_KERNELS_LIMITED_BEAMS_HPP
#define SOLIDEM_EFFECTS_KERNELS_LIMITED_BEAMS_HPP

#include <cstdint>
#include <type_traits>
#include <variant>

#include "effects/kernels/beam_slots.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

/// A law by which no bond flows.
struct NoFlow {};

/// Their ends in the last pose, and how they have turned since.
struct OwnLastEnds {
  PackVector position;
  Quaternion<Pack> turn;
  Rotation<Pack> rotation;
  OwnLastEnds(const Row& row, const Quaternion<Pack>& turned)
      : position(centre(row)), turn(turned * conjugate(orientation(row))), rotation(turn) {}
};

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

/// Bonds in the last pose.
template <class Kind>
inline LastBeam<Pack> last_of(Kind kind, const BeamMotion& m, const SlotPlace& slot,
                              const BondPack& bond, const OwnEnds& own,
                              const OwnLastEnds& own_last) {
  const Row other = Row::gather(m.last_pose, m.neighbour + slot.of(1));
  return last_beam(kind, bond, own.turned,
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
  const auto posed = posed_beam(kind, m, slot, rule, bond, own.rotation, at.other_turned);
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
  if (rule == FlowRule::scaled_offset) {
    // Lanes that do not flow keep the shape they had, which is not that of the response.
    const BeamLoad<Pack> kept = load_of(kind, bond);
    result.force = select(flowing, result.force, kept.force);
    result.moment = select(flowing, result.moment, kept.moment_i);
  }
  keep(kind, m, slot, flowing, before, response.history);
  keep_rate(yield, m, slot, flowing, flow.strain);
  refresh_limit(yield, m, slot, flowing, flow.strain, scale_of(kind, m, slot));
  if (m.rupture == nullptr) return result;
  BondStrain<Pack> strains = strains_after(at.beam, flow);
  if (rule == FlowRule::scaled_offset) strains = select(flowing, strains, strain_of(at));
  report(m, slot, present, strains, scale_of(kind, m, slot));
  return result;
}

/// Where rows end: those of a block, and all that a loop goes through.
struct RowEnds {
  std::size_t block, all;
};

/// Rows of slots that were added up.
struct RowSum {
  SlotLoad load;
  std::size_t end;  ///< of the rows
};

/// Loads of a row of bonds, which flow by the law if they have to.
template <class Law, FlowRule rule, class Kind>
inline SlotLoad limited_load(Kind kind, const BeamMotion& m, const SlotPlace& slot,
                             const LimitedBonds& at, const OwnEnds& own,
                             const OwnLastEnds& own_last) {
  if constexpr (std::is_same_v<Law, NoFlow>) {
    return unflowing_load(kind, m, slot, at);
  } else {
    const Law& law = *std::get_if<Law>(m.yield);
    if constexpr (Kind::has_own_limits) {
      const ScaledLaw<Law, Pack> scaled{law, scale_of(kind, m, slot)};
      return flowing_load<rule>(kind, scaled, m, slot, at, own, own_last);
    } else {
      return flowing_load<rule>(kind, law, m, slot, at, own, own_last);
    }
  }
}

/// Adds the loads of a row of bonds that have a shape of their own or may have reached a limit, and
/// of those after it, up to one that is neither and this one too. Apart from the hot loop, whose
/// registers it would take; all that it calls is part of it, for compilers take what is seldom
/// called for cold and copy packs through memory.
template <class Law, FlowRule rule, class Kind>
[[gnu::noinline, gnu::flatten]] RowSum limited_rows(const BeamMotion& m, std::size_t element,
                                                    SlotPlace slot, const RowEnds& ends,
                                                    const SlotLoad& so_far) {
  constexpr bool flows = !std::is_same_v<Law, NoFlow>;
  const Kind kind{m.bond_rigidity != nullptr};
  const OwnEnds own(element, Row::load(m.pose + 8 * element));
  const OwnLastEnds own_last(Row::load((flows ? m.last_pose : m.pose) + 8 * element), own.turned);
  SlotLoad sum = so_far;
  for (bool goes_on = true; goes_on && slot.row < ends.block; ++slot.row) {
    if (slot.row + rows_ahead < ends.all) {
      prefetch_rows<8>(m.pose, m.neighbour + slot.of(1) + rows_ahead * lanes);
      if (flows) prefetch_rows<8>(m.last_pose, m.neighbour + slot.of(1) + rows_ahead * lanes);
    }
    const LimitedBonds at = limited_bonds(kind, m, own, slot);
    const bool is_limited = any(limited(kind, m, slot, at.bond));
    goes_on = is_limited || has_shape(kind, m, slot);
    if (is_limited) {
      sum = sum + limited_load<Law, rule>(kind, m, slot, at, own, own_last);
    } else {
      const BeamLoad<Pack> load = load_of(kind, at.bond);
      sum = sum + SlotLoad{load.force, load.moment_i, {}};
    }
  }
  return {sum, slot.row};
}

using LimitedRows = RowSum (*)(const BeamMotion&, std::size_t element, SlotPlace, const RowEnds&,
                               const SlotLoad& so_far);

/// Chosen once, outside the loops: they do not grow with the table of laws.
template <bool has_rotation, bool own_limits>
LimitedRows limited_rows_by_law(const BeamMotion& m) {
  using Remembering = LimitedKind<has_rotation, true, own_limits>;
  if (m.yield == nullptr)
    return m.watch == Watch::remembering
               ? limited_rows<NoFlow, FlowRule::radial_return, Remembering>
               : limited_rows<NoFlow, FlowRule::radial_return,
                              LimitedKind<has_rotation, false, own_limits>>;
  return std::visit(
      [&](const auto& law) {
        return by_rule(m.flow_rule, [](auto rule) -> LimitedRows {
          return limited_rows<std::decay_t<decltype(law)>, decltype(rule)::value, Remembering>;
        });
      },
      *m.yield);
}

inline LimitedRows limited_rows_of(const BeamMotion& m) {
  const bool own_limits = m.bond_limits != nullptr;
  if (m.has_rotation)
    return own_limits ? limited_rows_by_law<true, true>(m) : limited_rows_by_law<true, false>(m);
  return own_limits ? limited_rows_by_law<false, true>(m) : limited_rows_by_law<false, false>(m);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
