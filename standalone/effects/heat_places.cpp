// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_places.hpp"

#include <algorithm>
#include <cmath>

#include "effects/contact_conduction.hpp"
#include "effects/exposed_surface.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// How many ways heat has into each element and out of it; all have some where contacts conduct.
std::vector<int> ways_of_heat(const Assembly& assembly) {
  if (assembly.setup.get<ContactConductionParameters>())
    return std::vector<int>(assembly.model.elements(), 1);
  return assembly.model.conductors().coordination();
}

/// Those of the shape in its order, then those of cuts.
std::string known_walls(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const std::string& name : wall_names(assembly.specimen().domain))
    if (assembly.geometry.walls.count(name) > 0) names.push_back(name);
  for (const auto& [name, faces] : assembly.geometry.walls)
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return join(names);
}

HeatedFaces exposed_faces(const Assembly& assembly, const std::string& target,
                          const Region& region) {
  const std::vector<std::int32_t> elements = select_for(target, region, assembly.specimen());
  HeatedFaces faces = assembly.need<ExposedSurface>().part(elements);
  if (faces.now->empty())
    throw InputError(target +
                     ": no element of its region is at the surface; the body lies between " +
                     bounds(assembly.specimen()));
  return faces;
}

}  // namespace

HeatedFaces faces_of(const Assembly& assembly, const std::string& section, const std::string& name,
                     const std::string& wall, const Region& region) {
  const auto found = assembly.geometry.walls.find(wall);
  const std::string target = "[[" + section + "]] \"" + name + "\" wall = \"" + wall + "\"";
  if (wall == ExposedSurface::word) return exposed_faces(assembly, target, region);
  if (found == assembly.geometry.walls.end()) {
    const std::string known = known_walls(assembly);
    if (known.empty() && assembly.specimen().outline != nullptr)
      throw InputError(target +
                       ": under a platonic law a body with cuts, or of a mesh, has no walls, nor "
                       "have several bodies; expected [conduction] law = \"voronoi\", a region, or "
                       "wall = \"exposed\"");
    throw InputError(
        target + ": the body has no such wall; expected one of " +
        (known.empty()
             ? "those of a shape, and this body has none; [specimen] shape and its measures "
               "give one to the spheres of a file; or wall = \"exposed\", the whole surface"
             : known + "; or \"exposed\", the whole surface"));
  }
  if (found->second.empty())
    throw InputError(target +
                     ": no element reaches it; expected a body that fills its bounds, or a region "
                     "in target of the wall");
  return {std::make_shared<std::vector<WallFace>>(found->second), found->second, true};
}

std::vector<std::int32_t> select_conducting(const Assembly& assembly, const std::string& owner,
                                            const Region& region) {
  const Specimen& specimen = assembly.specimen();
  std::vector<std::int32_t> elements = select_some(owner, region, specimen);
  const std::vector<int> neighbours = ways_of_heat(assembly);
  const bool all_alone = std::all_of(elements.begin(), elements.end(), [&](std::int32_t e) {
    return neighbours[static_cast<std::size_t>(e)] == 0;
  });
  if (all_alone)
    throw InputError(owner + " region: none of its " + std::to_string(elements.size()) +
                     " elements has a neighbour to pass heat to, " +
                     place(specimen, static_cast<std::size_t>(elements[0])) +
                     " for one; expected a larger region, [bonds] tolerance = 0.05, or law = "
                     "\"voronoi\"");
  return elements;
}

std::vector<double> which_conduct(const Assembly& assembly) {
  std::vector<double> conduct;
  for (const int neighbours : ways_of_heat(assembly)) conduct.push_back(neighbours > 0 ? 1 : 0);
  return conduct;
}

std::vector<CellSolid> heat_solids(const Assembly& assembly, const Vector& lower,
                                   const Vector& upper) {
  const Specimen& specimen = assembly.specimen();
  if (has_cells(specimen)) return cell_solids(specimen, lower, upper);
  std::vector<CellSolid> balls;
  for (std::size_t i = 0; i < specimen.size(); ++i)
    balls.push_back({static_cast<std::int32_t>(i),
                     ball_of_facets(specimen.position[i], assembly.geometry.volume[i])});
  return balls;
}

void check_images(const Assembly& assembly, const std::string& what, const HeatedPart& part) {
  const Domain& domain = assembly.specimen().domain;
  for (int k = 0; k < 3; ++k) {
    const double length = component(part.bounds.second - part.bounds.first, k);
    const double period = component(domain.upper - domain.lower, k);
    if (domain.periodic[k] && length > period && !std::isinf(length))
      throw InputError(what + " is " + text(length) + " m long along " + "xyz"[k] +
                       ", where the body repeats every " + text(period) +
                       " m, so that it would overlap its own image; expected " + text(period) +
                       " m at most, or a cylinder without length along that axis");
  }
}

Rule wall(std::string& target) {
  const std::string expected =
      "the name of a wall of the body such as \"x_low\" or \"side\", or \"exposed\" for its whole "
      "surface";
  return {expected, [&target](const Value& value) {
            target = read_text(value, "the name of a wall such as \"x_low\"");
          }};
}

const char* const region_of_exposed = "with `wall = \"exposed\"`: only what its elements show";

void check_exposed_region(const Section& section, const std::string& wall) {
  if (section.has("region") && wall != ExposedSurface::word)
    section.refuse("region", "a wall is heated as a whole", "wall = \"exposed\" beside it");
}

}  // namespace solidem
