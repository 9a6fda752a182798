// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_CRYSTAL_HPP
#define SOLIDEM_SPECIMEN_CRYSTAL_HPP

#include "model/specimen.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

/// Equal spheres on a lattice, nearest neighbours touching. The body is exactly `cells` lattice
/// cells, periodic or not; elements stand centred in it. Cell sides in units of the element radius
/// R: simple_cubic 2; bcc 4/√3; fcc 2√2; hcp, as a rectangular cell of four elements, 2 × 2√3 ×
/// 4√(2/3). Elements in no particular order, no bonds. Throws InputError for an unknown lattice,
/// cells < 1 or a radius that is not positive.
Specimen make_crystal(const SpecimenRecipe& recipe);

}  // namespace solidem

#endif
