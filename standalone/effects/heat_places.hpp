// SPDX-License-Identifier: GPL-2.0-or-later
//
// Where heat comes in: walls and elements that can take it, and complaints about those that cannot.
#ifndef SOLIDEM_EFFECTS_HEAT_PLACES_HPP
#define SOLIDEM_EFFECTS_HEAT_PLACES_HPP

#include <string>
#include <vector>

#include "effects/assembly.hpp"
#include "effects/heat_spread.hpp"
#include "effects/heated_faces.hpp"
#include "keys/section.hpp"

namespace solidem {

/// The faces of a wall, for an entry of a section; of the exposed surface, those of the elements of
/// a region. Throws InputError when the body has no such wall or no element is there.
HeatedFaces faces_of(const Assembly& assembly, const std::string& section, const std::string& name,
                     const std::string& wall, const Region& region = {});

/// The elements of a region. Throws InputError that begins with its owner when there are none, or
/// when none of them conducts.
std::vector<std::int32_t> select_conducting(const Assembly& assembly, const std::string& owner,
                                            const Region& region);

/// 1 for each element that can pass heat on, 0 for the others.
std::vector<double> which_conduct(const Assembly& assembly);

/// What elements are made of where a shape heats them, as far as it meets the box between two
/// corners: their cells; where the body has no outline, balls of the volumes that they stand for.
std::vector<CellSolid> heat_solids(const Assembly& assembly, const Vector& lower,
                                   const Vector& upper);

/// Refuses a part that overlaps its own images in a periodic body.
void check_images(const Assembly& assembly, const std::string& what, const HeatedPart& part);

/// The name of a wall.
Rule wall(std::string& target);
/// What a `region` beside it means.
extern const char* const region_of_exposed;
/// Refuses a region beside a wall that is all of it heated.
void check_exposed_region(const Section& section, const std::string& wall);

}  // namespace solidem

#endif
