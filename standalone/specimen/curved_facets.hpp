// SPDX-License-Identifier: GPL-2.0-or-later
//
// Curved walls as flat facets, the same for all cells. Lengths are in mean radii.
#ifndef SOLIDEM_SPECIMEN_CURVED_FACETS_HPP
#define SOLIDEM_SPECIMEN_CURVED_FACETS_HPP

#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// Facets, all as far from the axis or the centre, so that what they bound has the volume of the
/// round body: its surface is radius / distance times smaller than theirs.
struct Facets {
  double distance = 0;
  std::vector<Vector> normal;  ///< away from the axis or the centre
};

/// Facets of a cylinder over an arc, rad, from one unit vector across its axis towards another.
Facets cylinder_facets(double radius, double arc, const Vector& first, const Vector& second);

Facets sphere_facets(double radius);

}  // namespace solidem

#endif
