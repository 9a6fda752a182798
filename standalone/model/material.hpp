// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_MATERIAL_HPP
#define SOLIDEM_MODEL_MATERIAL_HPP

#include "model/region.hpp"

namespace solidem {

/// Macroscopic properties of the continuous body, for the elements of a region.
/// Every element lies in the region of exactly one material. A property that no effect of the scene
/// needs stays zero.
struct Material {
  Region region;
  double density = 0;        ///< ρ_0, kg/m³
  double specific_heat = 0;  ///< c_p, J/(kg K)
  double conductivity = 0;   ///< λ, W/(m K)
};

}  // namespace solidem

#endif
