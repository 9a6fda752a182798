// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_DISPLACEMENT_GRADIENT_HPP
#define SOLIDEM_MODEL_DISPLACEMENT_GRADIENT_HPP

#include <cstdint>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// Displacement gradient of some elements by least squares, all nine components at once: the
/// weights w (1/m), one for each element, with ∂u/∂x_a = Σ w_a u. Where the elements lie in a plane
/// or on a line, components across it are zero.
std::vector<Vector> gradient_weights(const Specimen& specimen,
                                     const std::vector<std::int32_t>& elements);

}  // namespace solidem

#endif
