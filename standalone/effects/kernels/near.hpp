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
#if defined(__AVX512F__)
    const auto inside = static_cast<__mmask8>(~beyond.v);
    const __m256i number = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                            _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    _mm256_mask_compressstoreu_epi32(near + count, inside, number);
    count += static_cast<std::size_t>(__builtin_popcount(inside));
#else
    for (int lane = 0; lane < width; ++lane) {
      near[count] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(lane);
      count += beyond[lane] ? 0 : 1;
    }
#endif
  }
  return count;
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET

#endif
