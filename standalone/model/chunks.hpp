// SPDX-License-Identifier: GPL-2.0-or-later
//
// Work in chunks of a fixed size: what is summed chunk by chunk is the same on any number of
// threads.
#ifndef SOLIDEM_MODEL_CHUNKS_HPP
#define SOLIDEM_MODEL_CHUNKS_HPP

#include <algorithm>
#include <cstddef>

#include "model/blocks.hpp"

namespace solidem {

/// Calls work(chunk, first, last) for chunks of `size` of `count` things, on all threads; on one
/// where there are fewer than `least_chunks`.
template <class Work>
void for_chunks(std::size_t count, std::size_t size, std::size_t least_chunks, const Work& work) {
  for_blocks((count + size - 1) / size, least_chunks, [&](std::size_t from, std::size_t to) {
    for (std::size_t c = from; c < to; ++c) work(c, c * size, std::min((c + 1) * size, count));
  });
}

}  // namespace solidem

#endif
