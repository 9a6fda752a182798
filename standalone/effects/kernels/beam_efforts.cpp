// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set.
//
// What bonds do to elements and what they store, for who looks: laws/beam.hpp.
#include "effects/kernels/beam_slots.hpp"
#include "effects/kernels/loose_kernels.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

/// Leaves the bonds of a pack of slots to who looks at each of them.
inline void leave(const BeamMotion& m, const BeamEfforts& efforts, const SlotPlace& slot,
                  std::size_t element) {
  const std::int32_t* neighbour = m.neighbour + slot.of(1);
  for (std::size_t k = 0; k < width; ++k)
    if (neighbour[k] != static_cast<std::int32_t>(element + k))
      efforts.left->push_back(static_cast<std::uint32_t>(slot.of(1) + k));
}

}  // namespace

void find_beam_efforts(const BeamMotion& m, const BeamEfforts& efforts, std::size_t first,
                       std::size_t last) {
  const BondKind kind{m.has_rotation, m.bond_rigidity != nullptr, m.watch == Watch::remembering};
  const bool may_flow = m.yield != nullptr && m.last_pose != nullptr;
  const std::size_t first_row = m.first_row[first], end_row = m.first_row[last];
  for (std::size_t block = first; block < last; ++block)
    for (int lane = 0; lane < lanes; lane += width) {
      const std::size_t element = block * lanes + static_cast<std::size_t>(lane);
      const OwnEnds own(element, Row::load(m.pose + 8 * element));
      PackVector force{}, moment{};
      Pack energy{};
      for (std::size_t row = m.first_row[block]; row < m.first_row[block + 1]; ++row) {
        const SlotPlace slot{row, static_cast<std::size_t>(lane)};
        if (row + rows_ahead < end_row)
          prefetch_rows<8>(m.pose, m.neighbour + slot.of(1) + rows_ahead * lanes);
        if (has_shape(kind, m, slot)) {
          leave(m, efforts, slot, element);
          continue;
        }
        const Row other = Row::gather(m.pose, m.neighbour + slot.of(1));
        const BondPack bond =
            load_bond(kind, m, slot, false, chord_to(m, slot, own.position, other), own.rotation,
                      own.turned_back, orientation(other));
        if (may_flow && any(limited(kind, m, slot, bond))) {
          leave(m, efforts, slot, element);
          continue;
        }
        const BeamLoad<Pack> load = load_of(kind, bond);
        force += load.force;
        moment += load.moment_i;
        energy += select(is_bond(bond), beam_energy(bond.rigidity, bond.pose, bond.deformation),
                         Pack(0.0));
        if (efforts.slot_load != nullptr) {
          double* at = efforts.slot_load + SlotPlace{row - first_row, slot.lane}.of(6);
          store_vector(load.force, at);
          store_vector(load.moment_i, at + std::ptrdiff_t{3} * lanes);
        }
      }
      const std::size_t at = 3 * block * lanes + static_cast<std::size_t>(lane);
      if (efforts.force != nullptr) {
        store_vector(force, efforts.force + at);
        store_vector(moment, efforts.moment + at);
        (Pack(0.5) * energy).store(efforts.energy + element);
      }
    }
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
