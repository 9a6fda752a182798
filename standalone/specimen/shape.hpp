// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_SHAPE_HPP
#define SOLIDEM_SPECIMEN_SHAPE_HPP

#include "model/specimen.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

/// The body that a packing fills: box, plate or cylinder. Throws InputError for an unknown shape, a
/// length that is not above zero, an unknown axis, or a periodicity the shape cannot have.
Domain shape_of(const SpecimenRecipe& recipe);

/// Area of the body's walls, m²; periodic directions have none.
double wall_area(const Domain& domain);

/// The shortest way between two opposite walls, m (infinite when there are none), and the shortest
/// period.
double narrowest_width(const Domain& domain);
double shortest_period(const Domain& domain);

}  // namespace solidem

#endif
