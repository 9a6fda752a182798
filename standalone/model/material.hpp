// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_MATERIAL_HPP
#define SOLIDEM_MODEL_MATERIAL_HPP

#include <string>

#include "model/region.hpp"
#include "model/temperature_function.hpp"

namespace solidem {

/// What the elements of a region consist of. Properties that no effect needs stay zero.
struct Material {
  Region region;
  double density = 0;                           ///< ρ_0, kg/m³
  TemperatureFunction specific_heat;            ///< c_p, J/(kg K)
  TemperatureFunction conductivity;             ///< λ, W/(m K)
  std::string name{};                           ///< by which contacts know it; may be empty
  TemperatureFunction expansion_coefficient{};  ///< α, 1/K
};

}  // namespace solidem

#endif
