// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_KEY_TABLE_HPP
#define SOLIDEM_KEYS_KEY_TABLE_HPP

#include <string>
#include <vector>

#include "keys/section.hpp"

namespace solidem {

/// A row of a table in Markdown, | key | value | default |, of a key bound to a place that holds
/// the default.
std::string key_row(const Key& key);

/// The table of the keys of a section.
std::string key_table(const std::vector<Key>& keys);

}  // namespace solidem

#endif
