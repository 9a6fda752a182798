// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_PSEUDO_RANDOM_HPP
#define SOLIDEM_EFFECTS_PSEUDO_RANDOM_HPP

#include <cstddef>
#include <cstdint>

namespace solidem {

/// A number in [−1, 1) for each k, the same in every run: a start of an iteration that has a share
/// in every mode.
inline double pseudo_random(std::size_t k) {
  const std::uint64_t mixed = (k + 1) * 0x9E3779B97F4A7C15ull;
  return static_cast<double>((mixed ^ (mixed >> 29)) >> 40) / double(1 << 23) - 1;
}

}  // namespace solidem

#endif
