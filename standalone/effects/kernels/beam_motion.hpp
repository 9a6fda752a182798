// SPDX-License-Identifier: GPL-2.0-or-later
//
// Loads of bonds gathered element by element, fused with the time step: flow, force, kick and drift
// in one pass. Specialised at compile time on what a scene asks for.
#ifndef SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP
#define SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP

#include <algorithm>
#include <utility>

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
};

/// The bonds of a pack of slots, as they stand before any flow of this step.
struct BondPack {
  BeamRigidity<Pack> rigidity;
  Pack rest_length;
  BeamPose<Pack> pose;
  BeamDeformation<Pack> deformation;  ///< elastic
  BeamHistory<Pack> history;
};

template <bool turning, bool own_rigidity, BeamFlow flow>
inline BondPack bonds_in(const BeamMotion& m, const SlotPlace& slot, const PackVector& chord,
                         const Rotation<Pack>& rotation, const Quaternion<Pack>& turned_back,
                         const Quaternion<Pack>& other_turned) {
  BondPack bond{};
  bond.rigidity = {Pack(m.rigidity.axial), Pack(m.rigidity.bending), Pack(m.rigidity.shear),
                   Pack(m.rigidity.torsion)};
  if constexpr (own_rigidity)
    bond.rigidity = {
        Pack::load(m.bond_rigidity + slot.of(4, 0)), Pack::load(m.bond_rigidity + slot.of(4, 1)),
        Pack::load(m.bond_rigidity + slot.of(4, 2)), Pack::load(m.bond_rigidity + slot.of(4, 3))};
  bond.rest_length = Pack::load(m.rest_length + slot.of(1));
  BeamHistory<Pack>& history = bond.history;
  if constexpr (remembers(flow)) {
    history.extension = Pack::load(m.plastic_extension + slot.of(1));
    history.strain = Pack::load(m.plastic_strain + slot.of(1));
  }
  if constexpr (turning) {
    if constexpr (remembers(flow)) {
      history.normal_i = load_vector(m.section_normal + slot.of(3));
      history.normal_j = load_vector(m.far_section_normal + slot.of(3));
      history.twist = Pack::load(m.plastic_twist + slot.of(1));
    } else {
      history.normal_i = history.normal_j = load_vector(m.rest_direction + slot.of(3));
    }
    bond.pose = {chord, rotate(rotation, history.normal_i), rotate(other_turned, history.normal_j),
                 other_turned * turned_back};
    bond.deformation = beam_deformation(bond.rest_length, bond.pose);
  } else {
    bond.pose.chord = chord;
    bond.deformation = spring_deformation(bond.rest_length, chord);
  }
  if constexpr (remembers(flow)) {
    bond.deformation.extension = bond.deformation.extension - history.extension;
    if constexpr (turning) bond.deformation.twist = bond.deformation.twist - history.twist;
  }
  return bond;
}

template <bool turning>
inline BeamLoad<Pack> load_of(const BondPack& bond) {
  if constexpr (turning) return beam_load(bond.rigidity, bond.pose, bond.deformation);
  return {spring_force(bond.rigidity, bond.deformation), {}, {}};
}

/// What the limits of a bond are measured on: the deformation since it last flowed, or, for the
/// scaled offset, since it was made.
struct Measured {
  BeamPose<Pack> pose;
  BeamDeformation<Pack> deformation;
};

template <bool turning, BeamFlow flow>
inline Measured measured(const BeamMotion& m, const SlotPlace& slot, const BondPack& bond,
                         const Rotation<Pack>& rotation, const Quaternion<Pack>& other_turned) {
  if constexpr (flow != BeamFlow::scaled_offset) return {bond.pose, bond.deformation};
  Measured whole{bond.pose, {}};
  if constexpr (turning) {
    const PackVector rest_direction = load_vector(m.rest_direction + slot.of(3));
    whole.pose.normal_i = rotate(rotation, rest_direction);
    whole.pose.normal_j = rotate(other_turned, rest_direction);
    whole.deformation = beam_deformation(bond.rest_length, whole.pose);
  } else {
    whole.deformation = spring_deformation(bond.rest_length, bond.pose.chord);
  }
  return whole;
}

/// The strain up to which a bond surely neither flows nor breaks.
template <BeamFlow flow>
inline Pack safe_strain(const BeamMotion& m, const BondPack& bond) {
  const Pack rupture(std::min(m.rupture.elastic_strain, m.rupture.strain));
  if constexpr (flow == BeamFlow::brittle) return rupture;
  const double growth = m.yield.hardening_ratio + (flow == BeamFlow::scaled_offset ? 1.0 : 0.0);
  const Pack yield = Pack(m.yield.yield_strain) + Pack(growth) * bond.history.strain;
  return select(greater(yield, rupture), rupture, yield);
}

/// Radius and G / E of the bonds of a pack of slots.
template <bool own_rigidity>
inline std::pair<Pack, Pack> radius_and_shear_ratio(const BeamMotion& m, const SlotPlace& slot,
                                                    const BondPack& bond) {
  if constexpr (!own_rigidity) return {Pack(m.radius), Pack(m.shear_ratio)};
  const Pack radius = Pack::load(m.bond_radius + slot.of(1));
  // G I_0 / (E S) = G / E r² / 2, whatever the moduli of a bond are.
  return {radius, Pack(2.0) * bond.rigidity.torsion / (bond.rigidity.axial * radius * radius)};
}

/// Lanes that may have reached a limit of their bond.
template <bool turning, bool own_rigidity, BeamFlow flow>
inline Mask limited(const BeamMotion& m, const SlotPlace& slot, const BondPack& bond,
                    const Measured& from) {
  const auto [radius, shear_ratio] = radius_and_shear_ratio<own_rigidity>(m, slot, bond);
  const Pack safe = safe_strain<flow>(m, bond) * bond.rest_length;
  const Pack reached = bound_of_squared_extension(radius, shear_ratio, from.pose, from.deformation);
  const Mask reaching = greater(reached, safe * safe);
  // An empty slot is shorter than at rest, unless it remembers that it has shrunk to nothing.
  if constexpr (flow == BeamFlow::radial_return) return reaching;
  const PackVector& x = from.deformation.direction;
  return both(reaching, greater(dot(x, x), Pack(0.5)));
}

/// What a pack of slots does to its elements.
struct SlotLoad {
  PackVector force, moment;
  Pack work;  ///< half of the plastic work of this step
};

/// Loads of bonds of which some may have reached a limit: they flow, which is kept, and those that
/// break are reported. Apart from the hot loop, whose registers it would take.
template <bool turning, bool own_rigidity, BeamFlow flow>
[[gnu::noinline]] SlotLoad limited_load(const BeamMotion& m, std::size_t element,
                                        const SlotPlace& slot) {
  const Row own = Row::load(m.pose + 8 * element);
  const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
  PackVector chord = centre(other) - centre(own);
  if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
  const Quaternion<Pack> turned = orientation(own), other_turned = orientation(other);
  const Rotation<Pack> rotation(turned);
  const BondPack bond = bonds_in<turning, own_rigidity, flow>(m, slot, chord, rotation,
                                                              conjugate(turned), other_turned);
  const Measured from = measured<turning, flow>(m, slot, bond, rotation, other_turned);
  const auto [radius, shear_ratio] = radius_and_shear_ratio<own_rigidity>(m, slot, bond);
  const PackVector& x = from.deformation.direction;
  const Mask present = greater(dot(x, x), Pack(0.5));

  SlotLoad result{};
  Pack strain{}, plastic_strain = bond.history.strain;
  if constexpr (remembers(flow)) {
    const YieldingBeam<Pack> beam{bond.rigidity,
                                  bond.rest_length,
                                  radius,
                                  shear_ratio,
                                  {Pack(m.yield.yield_strain), Pack(m.yield.hardening_ratio)}};
    BeamResponse<Pack> response;
    if constexpr (flow == BeamFlow::radial_return)
      response = radial_return_response(beam, bond.history, bond.pose, bond.deformation, turned,
                                        other_turned);
    else
      response = scaled_offset_response(beam, bond.history, bond.pose, bond.deformation, from.pose,
                                        from.deformation, turned, other_turned);
    const BeamHistory<Pack>& before = bond.history;
    const BeamHistory<Pack>& after = response.history;
    const Mask flowing = both(present, greater(after.strain, before.strain));
    result = {response.load.force, response.load.moment_i, {}};
    strain = response.strain;
    if constexpr (flow == BeamFlow::scaled_offset) {
      // Lanes that do not flow keep the shape they had, which is not that of the response; an empty
      // slot may flow and be the only one.
      const BeamLoad<Pack> kept = load_of<turning>(bond);
      result.force = select(flowing, result.force, kept.force);
      result.moment = select(flowing, result.moment, kept.moment_i);
      strain = select(flowing, strain,
                      equivalent_strain(radius, shear_ratio, bond.pose, bond.deformation));
    }
    if (any(flowing)) {
      result.work = select(flowing, Pack(0.5) * response.plastic_work, Pack(0.0));
      plastic_strain = select(flowing, after.strain, before.strain);
      plastic_strain.store(m.plastic_strain + slot.of(1));
      select(flowing, after.extension, before.extension).store(m.plastic_extension + slot.of(1));
      if constexpr (turning) {
        store_vector(select(flowing, after.normal_i, before.normal_i),
                     m.section_normal + slot.of(3));
        store_vector(select(flowing, after.normal_j, before.normal_j),
                     m.far_section_normal + slot.of(3));
        select(flowing, after.twist, before.twist).store(m.plastic_twist + slot.of(1));
      }
    }
  } else {
    const BeamLoad<Pack> load = load_of<turning>(bond);
    result = {load.force, load.moment_i, {}};
    strain = equivalent_strain(radius, shear_ratio, bond.pose, bond.deformation);
  }
  const BeamRupture<Pack> rupture{Pack(m.rupture.elastic_strain), Pack(m.rupture.strain)};
  const Mask breaking = both(present, breaks(rupture, strain, plastic_strain));
  if (any(breaking))
    for (int k = 0; k < width; ++k)
      if (breaking[k])
        m.breaking->push_back(static_cast<std::uint32_t>(slot.of(1)) +
                              static_cast<std::uint32_t>(k));
  return result;
}

template <bool turning, bool own_rigidity, BeamFlow flow>
void move_beams(const BeamMotion& m, std::size_t first, std::size_t last) {
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
        const BondPack bond = bonds_in<turning, own_rigidity, flow>(m, slot, chord, rotation,
                                                                    turned_back, other_turned);
        if constexpr (flow != BeamFlow::none) {
          const Measured from = measured<turning, flow>(m, slot, bond, rotation, other_turned);
          if (__builtin_expect(any(limited<turning, own_rigidity, flow>(m, slot, bond, from)), 0)) {
            const SlotLoad load = limited_load<turning, own_rigidity, flow>(m, element, slot);
            force += load.force;
            moment += load.moment;
            work += load.work;
            continue;
          }
        }
        const BeamLoad<Pack> load = load_of<turning>(bond);
        force += load.force;
        if constexpr (turning) moment += load.moment_i;
      }
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      const PackVector velocity = load_vector(m.velocity + at) +
                                  (Pack(m.kick) * Pack::load(m.inverse_mass + element)) * force;
      store_vector(velocity, m.velocity + at);
      const PackVector moved = position + Pack(m.drift) * velocity;
      Quaternion<Pack> now = turned;
      if constexpr (turning) {
        const PackVector spin = load_vector(m.angular_velocity + at) +
                                (Pack(m.kick) * Pack::load(m.inverse_inertia + element)) * moment;
        store_vector(spin, m.angular_velocity + at);
        now = turn(turned, spin, Pack(m.drift));
      }
      const Row next{
          {moved.x, moved.y, moved.z, own.component[3], now.w, now.v.x, now.v.y, now.v.z}};
      next.store(m.next_pose + 8 * element);
      if constexpr (remembers(flow))
        // The scaled offset may give work back.
        if (any(either(greater(work, Pack(0.0)), greater(Pack(0.0), work))))
          (Pack::load(m.plastic_work + element) + work).store(m.plastic_work + element);
    }
  }
}

inline Vector3<HalfPack> half(const PackVector& v) {
  return {HalfPack(v.x), HalfPack(v.y), HalfPack(v.z)};
}

inline Quaternion<HalfPack> half(const Quaternion<Pack>& q) {
  return {HalfPack(q.w), half(q.v)};
}

inline PackVector whole(const Vector3<HalfPack>& v) {
  return {v.x.whole(), v.y.whole(), v.z.whole()};
}

/// Elastic beams, all alike, whose law is evaluated in single precision: chords are taken, and
/// loads summed and integrated, in double. Lengths are measured in elements' radii and loads in
/// those of unit strain, so that no figure leaves the range of a float.
inline void move_beams_in_single_precision(const BeamMotion& m, std::size_t first,
                                           std::size_t last) {
  const double unit = m.length_unit, per_unit = 1 / unit;
  const double unit_force = m.rigidity.axial;
  const BeamRigidity<HalfPack> rigidity{HalfPack(1.0),
                                        HalfPack(m.rigidity.bending / (unit_force * unit * unit)),
                                        HalfPack(m.rigidity.shear / (unit_force * unit * unit)),
                                        HalfPack(m.rigidity.torsion / (unit_force * unit * unit))};
  for (std::size_t block = first; block < last; ++block) {
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const Row own = Row::load(m.pose + 8 * element);
      const PackVector position = centre(own);
      const Quaternion<Pack> turned = orientation(own);
      const Quaternion<HalfPack> half_turned = half(turned);
      const Quaternion<HalfPack> turned_back = conjugate(half_turned);
      const Rotation<HalfPack> rotation(half_turned);
      PackVector force{}, moment{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
        PackVector chord = centre(other) - position;
        if (m.image_shift != nullptr) chord += load_vector(m.image_shift + slot.of(3));
        const Quaternion<HalfPack> other_turned = half(orientation(other));
        const Vector3<HalfPack> direction = half(load_vector(m.rest_direction + slot.of(3)));
        const BeamPose<HalfPack> pose{half(Pack(per_unit) * chord), rotate(rotation, direction),
                                      rotate(other_turned, direction), other_turned * turned_back};
        const HalfPack rest_length(Pack(per_unit) * Pack::load(m.rest_length + slot.of(1)));
        BeamDeformation<HalfPack> deformation = beam_deformation(rest_length, pose);
        // The one difference of nearly equal figures is taken in double.
        const Pack length = sqrt(dot(chord, chord));
        deformation.extension =
            HalfPack(Pack(per_unit) * (length - Pack::load(m.rest_length + slot.of(1))));
        const BeamLoad<HalfPack> load = beam_load(rigidity, pose, deformation);
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

template <bool turning, bool own_rigidity>
void move_beams_by_flow(const BeamMotion& m, std::size_t first, std::size_t last) {
  switch (m.flow) {
    case BeamFlow::none:
      return move_beams<turning, own_rigidity, BeamFlow::none>(m, first, last);
    case BeamFlow::brittle:
      return move_beams<turning, own_rigidity, BeamFlow::brittle>(m, first, last);
    case BeamFlow::radial_return:
      return move_beams<turning, own_rigidity, BeamFlow::radial_return>(m, first, last);
    case BeamFlow::scaled_offset:
      return move_beams<turning, own_rigidity, BeamFlow::scaled_offset>(m, first, last);
  }
}

inline void move_beams_by_kind(const BeamMotion& m, std::size_t first, std::size_t last) {
  const bool own_rigidity = m.bond_rigidity != nullptr;
  if (m.single_precision) return move_beams_in_single_precision(m, first, last);
  if (m.turning)
    own_rigidity ? move_beams_by_flow<true, true>(m, first, last)
                 : move_beams_by_flow<true, false>(m, first, last);
  else
    own_rigidity ? move_beams_by_flow<false, true>(m, first, last)
                 : move_beams_by_flow<false, false>(m, first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
