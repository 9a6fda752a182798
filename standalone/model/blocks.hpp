// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_BLOCKS_HPP
#define SOLIDEM_MODEL_BLOCKS_HPP

#include <omp.h>

#include <cstddef>

namespace solidem {

/// Calls work(first, last) on all threads for ranges that together hold each block once. Below
/// `least_blocks` a thread would cost more than it saves, and one thread does it all.
template <class Work>
void for_blocks(std::size_t blocks, std::size_t least_blocks, const Work& work) {
#pragma omp parallel if (blocks >= least_blocks)
  {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    work(blocks * thread / threads, blocks * (thread + 1) / threads);
  }
}

}  // namespace solidem

#endif
