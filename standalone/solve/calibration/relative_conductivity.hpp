// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_CALIBRATION_RELATIVE_CONDUCTIVITY_HPP
#define SOLIDEM_SOLVE_CALIBRATION_RELATIVE_CONDUCTIVITY_HPP

#include "effects/conduction_geometry.hpp"

namespace solidem {

/// The conductivity of a body as the geometry of its conduction gives it, as a multiple of the
/// material's: the steady flux along the body's axis (or its longest side) with both ends at
/// imposed temperatures, over the gradient in its middle half. Throws InputError where heat cannot
/// pass from end to end.
double relative_conductivity(const ConductionGeometry& geometry, const Specimen& specimen);

}  // namespace solidem

#endif
