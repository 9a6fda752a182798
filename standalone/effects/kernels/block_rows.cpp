// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compiled once for each instruction set.
#include "effects/kernels/block_rows.hpp"

#include <cstring>

#ifndef SOLIDEM_INSTRUCTION_SET
#define SOLIDEM_INSTRUCTION_SET baseline
#endif

namespace solidem::SOLIDEM_INSTRUCTION_SET {

namespace {

typedef double Four __attribute__((vector_size(4 * sizeof(double))));
typedef double Two __attribute__((vector_size(2 * sizeof(double))));

/// Six numbers: a column of a block, or what belongs to a row.
struct Six {
  Four head{};
  Two tail{};

  static Six load(const double* from) {
    Six six;
    std::memcpy(&six.head, from, sizeof six.head);
    std::memcpy(&six.tail, from + 4, sizeof six.tail);
    return six;
  }
  void add_product(const Six& a, const Six& b) {
    head += a.head * b.head;
    tail += a.tail * b.tail;
  }
  void add_product(const Six& a, double s) {
    head += a.head * s;
    tail += a.tail * s;
  }
  double sum() const { return ((head[0] + head[1]) + (head[2] + head[3])) + (tail[0] + tail[1]); }
};

}  // namespace

void multiply_rows(const BlockRows& rows, std::size_t first, std::size_t last, const double* x,
                   double* y) {
  for (std::size_t r = first; r < last; ++r) {
    Six straight, across[6];  // across: sums for each component of y, by components of x
    for (std::int32_t k = rows.start[r]; k < rows.start[r + 1]; ++k) {
      const double* factor = x + std::ptrdiff_t{6} * rows.column[k];
      const std::int32_t place = rows.place[k];
      const double* block = rows.block + std::ptrdiff_t{36} * (place < 0 ? ~place : place);
      if (place >= 0) {
        for (int c = 0; c < 6; ++c) straight.add_product(Six::load(block + 6 * c), factor[c]);
      } else {
        const Six all = Six::load(factor);
        for (int c = 0; c < 6; ++c) across[c].add_product(Six::load(block + 6 * c), all);
      }
    }
    double* to = y + 6 * r;
    for (int c = 0; c < 6; ++c)
      to[c] = (c < 4 ? straight.head[c] : straight.tail[c - 4]) + across[c].sum();
  }
}

}  // namespace solidem::SOLIDEM_INSTRUCTION_SET
