// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_KEYS_REGIONS_HPP
#define SOLIDEM_KEYS_REGIONS_HPP

#include <map>
#include <string>
#include <vector>

#include "keys/section.hpp"
#include "model/region.hpp"

namespace solidem {

/// What `{ set = "name" }` may mean: an entry of the scene's [sets], else a set of its specimen
/// file.
struct NamedRegions {
  std::map<std::string, Region> of_scene;
  bool specimen_is_file = false;      ///< a packing made from a recipe has no sets of its own
  std::vector<std::string> bodies{};  ///< names of [[body]]
};

/// {axis, side, depth | layers}, {lower, upper}, {set} or {all = true}; but for a set, each of them
/// may name the body that it is meant of, and {body} alone is all of it. `named` must be filled by
/// the time the rule reads. Sets of the specimen file stay to be found when the file is read.
Rule region(Region& target, const NamedRegions& named);

/// [sets]: a region for each name; `set` inside means a set of the specimen file.
Rule sets_section(NamedRegions& named);

}  // namespace solidem

#endif
