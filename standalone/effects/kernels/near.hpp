// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which of some positions are near: the inner loop of the search for neighbours.
#ifndef SOLIDEM_EFFECTS_KERNELS_NEAR_HPP
#define SOLIDEM_EFFECTS_KERNELS_NEAR_HPP

#include "effects/kernels/pack.hpp"
#include "neighbours/neighbourhood.hpp"

namespace solidem::SOLIDEM_INSTRUCTION_SET {

inline std::size_t pick_near(const NearPositions& positions, double x, double y, double z,
                             double reach, std::uint32_t* near) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < positions.count; first += width) {
    const Pack dx = Pack::load_anywhere(positions.x + first) - Pack(x);
    const Pack dy = Pack::load_anywhere(positions.y + first) - Pack(y);
    const Pack dz = Pack::load_anywhere(positions.z + first) - Pack(z);
    const Pack limit = Pack::load_anywhere(positions.reach + first) + Pack(reach);
    const Mask beyond = greater(dx * dx + dy * dy + dz * dz, limit * limit);
    count += write_numbers(opposite(beyond), first, near + count);
  }
  return count;
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
