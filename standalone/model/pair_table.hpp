// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_PAIR_TABLE_HPP
#define SOLIDEM_MODEL_PAIR_TABLE_HPP

#include <cstdint>

#include "model/columns.hpp"
#include "model/slots.hpp"

namespace solidem {

/// A named table of pairs of elements, seen from both sides; the columns of its site have one entry
/// for each of its slots.
struct PairTable {
  const char* name;
  Site site;
  Slots slots;
  /// Counts the changes of its pairs and of their columns: what was derived from an older version
  /// no longer holds.
  std::uint64_t version = 0;
};

/// A bond that broke or was made.
struct BondChange {
  enum class Kind { broken, made };
  Kind kind;
  Pair pair;
  double length;  ///< of the bond at rest, the distance at which it was made, m
};

}  // namespace solidem

#endif
