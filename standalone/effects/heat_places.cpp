// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_places.hpp"

#include <algorithm>

#include "keys/rules.hpp"
#include "model/error.hpp"

namespace solidem {

std::vector<WallFace> faces_of(const Assembly& assembly, const std::string& section,
                               const std::string& name, const std::string& wall) {
  const Specimen& specimen = assembly.specimen();
  const auto found = assembly.geometry.walls.find(wall);
  const std::string target = "[[" + section + "]] \"" + name + "\": wall = \"" + wall + "\"";
  if (found == assembly.geometry.walls.end()) {
    std::string known;
    for (const std::string& other : wall_names(specimen.domain))
      known += (known.empty() ? "" : ", ") + other;
    throw InputError(
        target + ": the body has no such wall; expected one of " +
        (known.empty()
             ? "those of a shape, and this body has none; [specimen] shape and its measures "
               "give one to the spheres of a file"
             : known));
  }
  if (found->second.empty())
    throw InputError(target +
                     ": no element reaches it; expected a body that fills its bounds, or a region "
                     "in target of the wall");
  return found->second;
}

std::vector<std::int32_t> select_conducting(Assembly& assembly, const std::string& name,
                                            const Region& region) {
  const Specimen& specimen = assembly.specimen();
  std::vector<std::int32_t> elements = select_some(assembly.selections, name, region, specimen);
  const std::vector<int> neighbours = assembly.model.conductors().coordination();
  const bool all_alone = std::all_of(elements.begin(), elements.end(), [&](std::int32_t e) {
    return neighbours[static_cast<std::size_t>(e)] == 0;
  });
  if (all_alone)
    throw InputError(name + ": none of the " + std::to_string(elements.size()) +
                     " elements of its region has a neighbour to pass heat to, " +
                     place(specimen, static_cast<std::size_t>(elements[0])) +
                     " for one; expected a larger region, [bonds] tolerance = 0.05, or law = "
                     "\"voronoi\"");
  return elements;
}

Rule wall(std::string& target) {
  const std::string expected = "the name of a wall of the body such as \"x_low\" or \"side\"";
  return {expected, [&target](const Value& value) {
            target = read_text(value, "the name of a wall such as \"x_low\"");
          }};
}

}  // namespace solidem
