// SPDX-License-Identifier: GPL-2.0-or-later
//
// Compact random packings (Terreros 2013, 2.4): spheres of radii spread evenly over R_m (1 ±
// spread), thrown at random into the body and pushed apart to rest between its walls. All radii are
// then scaled together until a sphere touches 6.2 others on average, the compaction of the sources;
// overlaps stay small.
#ifndef SOLIDEM_SPECIMEN_PACKING_HPP
#define SOLIDEM_SPECIMEN_PACKING_HPP

#include "model/facet_tree.hpp"
#include "model/specimen.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

/// Mean number of contacts a packing is made for, unless the mean overlap would become larger than
/// `largest_mean_overlap` first: bodies a few spheres thick cannot have as many.
constexpr double target_coordination = 6.2;
constexpr double largest_mean_overlap = 0.015;

/// Fills the recipe's box, plate, cylinder, annulus, wedge, sphere or mesh. With `elements` given
/// the mean radius comes out of the packing; with `mean_radius` given the number of elements
/// follows from the expected solid fraction, and the mean radius comes out within about 1 % of the
/// request. Elements along a Hilbert curve, no bonds. The same for the same recipe on any number of
/// threads. Throws InputError when the recipe is incomplete or the body too thin for spheres of
/// that size. `surface`: that of a mesh, else null.
Specimen make_packing(const SpecimenRecipe& recipe, const ReportProgress& progress = {},
                      const FacetTree* surface = nullptr);

/// The surface that a recipe asks for, where its file puts it and its origin moves it. Throws
/// InputError when it cannot be read or does not bound a body.
FacetTree surface_of(const SpecimenRecipe& recipe);

}  // namespace solidem

#endif
