// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_SHAPE_HPP
#define SOLIDEM_SPECIMEN_SHAPE_HPP

#include "model/specimen.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

/// The body that a packing fills: box, plate, cylinder, annulus, wedge or sphere. Throws InputError
/// for an unknown shape, a length that is not above zero, an inner radius that is not below the
/// outer one, an angle that is not between 0 and π, an unknown axis, or a periodicity the shape
/// cannot have.
Domain shape_of(const SpecimenRecipe& recipe);

/// The body in units of `unit`, with the lower corner of its bounding box at the origin.
Domain scaled(const Domain& domain, double unit);

/// Volume of a body from its shape's dimensions, m³; of an imported one, the bounding box's.
double volume_of(const Domain& domain);

/// Diameter of the largest sphere between the walls, m (infinite when there are none), and the
/// shortest period.
double narrowest_width(const Domain& domain);
double shortest_period(const Domain& domain);

}  // namespace solidem

#endif
