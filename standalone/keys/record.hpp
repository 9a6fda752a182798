// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_RECORD_HPP
#define SOLIDEM_KEYS_RECORD_HPP

#include <string>
#include <utility>
#include <vector>

namespace solidem {

/// All values that were read from a scene file, in the order of the rules, in SI units: the value's
/// name ("[beams] young_modulus") and the value.
using Record = std::vector<std::pair<std::string, std::string>>;

}  // namespace solidem

#endif
