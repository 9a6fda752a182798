// SPDX-License-Identifier: GPL-2.0-or-later
//
// Where heat comes in: walls and elements that can take it, and complaints about those that cannot.
#ifndef SOLIDEM_EFFECTS_HEAT_PLACES_HPP
#define SOLIDEM_EFFECTS_HEAT_PLACES_HPP

#include <string>
#include <vector>

#include "effects/assembly.hpp"
#include "keys/section.hpp"

namespace solidem {

/// The faces of a wall, for an entry of a section. Throws InputError when the body has no such wall
/// or no element is there.
std::vector<WallFace> faces_of(const Assembly& assembly, const std::string& section,
                               const std::string& name, const std::string& wall);

/// The elements of a region, entered under a name. Throws InputError when there are none, or when
/// none of them conducts.
std::vector<std::int32_t> select_conducting(Assembly& assembly, const std::string& selection,
                                            const Region& region);

/// The name of a wall.
Rule wall(std::string& target);

}  // namespace solidem

#endif
