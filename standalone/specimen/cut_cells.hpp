// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_CUT_CELLS_HPP
#define SOLIDEM_SPECIMEN_CUT_CELLS_HPP

#include "model/specimen.hpp"

namespace solidem {

/// The volume of a body that is known by its spheres alone, m³: that of their radical Voronoi
/// cells, cut where they reach beyond the spheres. A cell with corners farther than two radii from
/// the centre (those of a simple cubic lattice are at 1.73) is cut by the plane that touches the
/// sphere below the farthest one, until none is. Exact inside a dense body. Cylinders and boxes of
/// 300 to 8000 elements lose 2 to 1 %, balls cut from a packing gain 7 to 3 %. The domain must hold
/// all spheres; periods count.
double cut_cell_volume(const Specimen& specimen);

}  // namespace solidem

#endif
