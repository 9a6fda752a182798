// SPDX-License-Identifier: GPL-2.0-or-later
//
// Loads of bonds gathered element by element, fused with the time step: flow, force, kick and drift
// in one pass. Specialised at compile time on what a scene asks for.
#ifndef SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP
#define SOLIDEM_EFFECTS_KERNELS_BEAM_MOTION_HPP

#include "effects/kernels/limited_beams.hpp"
#include "laws/rigid_sphere.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

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
      std::size_t row = m.first_row[block];
      const auto look_closely = [&] {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        const RowSum sum = limited_rows(m, element, slot, {m.first_row[block + 1], end_row},
                                        {force, moment, work});
        force = sum.load.force;
        moment = sum.load.moment;
        work = sum.load.work;
        row = sum.end;
      };
      while (row < m.first_row[block + 1]) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        if (__builtin_expect(has_shape(kind, m, slot), 0)) {
          look_closely();
          continue;
        }
        if (row + rows_ahead < end_row)
          prefetch_rows<8>(m.pose, m.neighbour + slot.of(1) + rows_ahead * lanes);
        const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
        const BondPack bond = load_bond(kind, m, slot, false, chord_to(m, slot, position, other),
                                        rotation, turned_back, orientation(other));
        if constexpr (watch != Watch::elastic) {
          if (__builtin_expect(any(limited(kind, m, slot, bond)), 0)) {
            look_closely();
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
  const MoveBeams move = beam_loops[m.has_rotation ? 1 : 0][m.bond_rigidity != nullptr ? 1 : 0]
                                   [static_cast<int>(m.watch)];
  move(m, limited_rows_of(m), first, last);
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
