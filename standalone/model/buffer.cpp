// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/buffer.hpp"

#include <algorithm>
#include <cstring>

#include "model/blocks.hpp"

namespace solidem {

void fill_with_zeros(char* memory, std::size_t bytes) {
  constexpr std::size_t page = 4096, least_pages = 512;  // a huge page
  for_blocks(bytes / page + 1, least_pages, [&](std::size_t first, std::size_t last) {
    const std::size_t from = first * page, to = std::min(last * page, bytes);
    if (from < to) std::memset(memory + from, 0, to - from);
  });
}

}  // namespace solidem
