// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/crystal.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "model/error.hpp"

namespace solidem {

namespace {

struct Lattice {
  Vector side;                // of the cell, in element radii
  std::vector<Vector> sites;  // in cell sides, centred in the cell
};

Lattice lattice_called(const std::string& name) {
  if (name == "simple_cubic") return {{2, 2, 2}, {{.5, .5, .5}}};
  if (name == "bcc") {
    const double a = 4 / std::sqrt(3.0);
    return {{a, a, a}, {{.25, .25, .25}, {.75, .75, .75}}};
  }
  if (name == "fcc") {
    const double a = 2 * std::sqrt(2.0);
    return {{a, a, a}, {{.25, .25, .25}, {.75, .75, .25}, {.75, .25, .75}, {.25, .75, .75}}};
  }
  if (name == "hcp")
    return {{2, 2 * std::sqrt(3.0), 4 * std::sqrt(2.0 / 3.0)},
            {{.25, 1. / 6, .25}, {.75, 4. / 6, .25}, {.75, 2. / 6, .75}, {.25, 5. / 6, .75}}};
  throw InputError(
      fmt::format("[specimen] lattice = \"{}\": expected simple_cubic, bcc, fcc or hcp", name));
}

}  // namespace

Specimen make_crystal(const SpecimenRecipe& recipe) {
  const Lattice lattice = lattice_called(recipe.lattice);
  const double radius = recipe.element_radius;
  if (!(radius > 0) || !std::isfinite(radius))
    throw InputError(
        fmt::format("[specimen] element_radius = {} m: expected a length above zero", radius));
  double elements = static_cast<double>(lattice.sites.size());
  for (const int count : recipe.cells) {
    if (count < 1)
      throw InputError(fmt::format("[specimen] cells = [{}, {}, {}]: expected three numbers ≥ 1",
                                   recipe.cells[0], recipe.cells[1], recipe.cells[2]));
    elements *= count;
  }
  if (elements > 2147483647.0)
    throw InputError(fmt::format(
        "[specimen] cells = [{}, {}, {}] makes {:.3g} elements: at most 2147483647 can be numbered",
        recipe.cells[0], recipe.cells[1], recipe.cells[2], elements));

  const Vector side = radius * lattice.side;
  const Vector extent{recipe.cells[0] * side.x, recipe.cells[1] * side.y, recipe.cells[2] * side.z};
  Specimen specimen;
  specimen.domain.shape = "crystal";
  specimen.domain.lower = recipe.origin;
  specimen.domain.upper = recipe.origin + extent;
  specimen.domain.periodic = recipe.periodic;
  specimen.domain.volume = extent.x * extent.y * extent.z;
  specimen.position.reserve(static_cast<std::size_t>(elements));
  for (int k = 0; k < recipe.cells[2]; ++k)
    for (int j = 0; j < recipe.cells[1]; ++j)
      for (int i = 0; i < recipe.cells[0]; ++i)
        for (const Vector& site : lattice.sites)
          specimen.position.push_back(recipe.origin + Vector{(i + site.x) * side.x,
                                                             (j + site.y) * side.y,
                                                             (k + site.z) * side.z});
  specimen.radius.assign(specimen.position.size(), radius);
  return specimen;
}

}  // namespace solidem
