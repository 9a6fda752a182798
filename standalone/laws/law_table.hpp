// SPDX-License-Identifier: GPL-2.0-or-later
//
// A table of laws of one family.
#ifndef SOLIDEM_LAWS_LAW_TABLE_HPP
#define SOLIDEM_LAWS_LAW_TABLE_HPP

#include <variant>

namespace solidem {

template <class... Laws>
struct LawTable {
  using Any = std::variant<Laws...>;
  /// Calls visit(Law{}) for each law of the table.
  template <class Visit>
  static void for_each(Visit&& visit) {
    (visit(Laws{}), ...);
  }
};

}  // namespace solidem

#endif
