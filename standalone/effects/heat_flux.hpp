// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEAT_FLUX_HPP
#define SOLIDEM_EFFECTS_HEAT_FLUX_HPP

#include <vector>

#include "effects/conduction_geometry.hpp"
#include "effects/heat_load.hpp"

namespace solidem {

/// Heat that flows into the body through a wall, evenly.
class HeatFlux : public HeatLoad {
 public:
  HeatFlux(const HeatFluxParameters& parameters, std::vector<WallFace> faces)
      : HeatLoad("heat_flux." + parameters.name),
        faces_(std::move(faces)),
        flux_(parameters.flux) {}

  void powers(double time, const double* temperature,
              std::vector<ElementValue>& powers) const override;
  bool is_steady() const override { return flux_.is_constant(); }

 private:
  std::vector<WallFace> faces_;
  TimeFunction flux_;  ///< W/m²
};

}  // namespace solidem

#endif
