// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEAT_FLUX_HPP
#define SOLIDEM_EFFECTS_HEAT_FLUX_HPP

#include <memory>
#include <vector>

#include "effects/conduction_geometry.hpp"
#include "effects/heat_load.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heat_spread.hpp"
#include "effects/heated_faces.hpp"

namespace solidem {

/// Heat that flows into the body through a wall, evenly; or through the part of it that lies in a
/// shape or under a Gaussian spot, which may move.
class HeatFlux : public HeatLoad {
 public:
  HeatFlux(const HeatFluxParameters& parameters, HeatedFaces faces)
      : HeatLoad("heat_flux." + parameters.name),
        parameters_(parameters),
        faces_(std::move(faces)) {}
  /// `spread`: of the area that is heated, m²; under a Gaussian spot weighted with flux over peak.
  HeatFlux(const HeatFluxParameters& parameters, std::unique_ptr<HeatSpread> spread)
      : HeatLoad("heat_flux." + parameters.name),
        parameters_(parameters),
        spread_(std::move(spread)) {}

  void powers(double time, const double* temperature,
              std::vector<ElementValue>& powers) const override;
  bool is_steady() const override {
    return parameters_.flux.is_constant() && (spread_ == nullptr ? faces_.stay : spread_->rests());
  }
  /// Refuses a part that meets the wall at no time.
  void start(const Model& model, double duration) override;

 private:
  HeatFluxParameters parameters_;
  HeatedFaces faces_{};                 ///< of the whole wall
  std::unique_ptr<HeatSpread> spread_;  ///< of a part
};

}  // namespace solidem

#endif
