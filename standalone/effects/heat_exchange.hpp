// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_HEAT_EXCHANGE_HPP
#define SOLIDEM_EFFECTS_HEAT_EXCHANGE_HPP

#include <vector>

#include "effects/conduction.hpp"
#include "effects/heat_load.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heated_faces.hpp"

namespace solidem {

/// Heat exchanged through a wall with what is outside: a surface held at a temperature, or a fluid
/// (convection). Laws: laws/heat_exchange.hpp.
class HeatExchange : public HeatLoad {
 public:
  /// A wall held at a temperature.
  HeatExchange(const ImposedTemperatureParameters& parameters, HeatedFaces faces,
               const Conduction& conduction);
  /// Convection along a wall.
  HeatExchange(const ConvectionParameters& parameters, HeatedFaces faces,
               const Conduction& conduction);

  void powers(double time, const double* temperature,
              std::vector<ElementValue>& powers) const override;
  bool is_steady() const override { return faces_.stay && outside_.is_constant() && is_linear(); }
  void conductances(double time, const double* temperature,
                    std::vector<ElementValue>& conductances) const override;
  void largest_conductances(std::vector<ElementValue>& conductances) const override;
  bool is_linear() const override { return !coefficient_ || coefficient_->is_constant(); }
  /// Temperature outside, K.
  double outside(double time) const { return outside_(time); }
  void observe(const Model& model, Observation& observation) const override;

 private:
  /// At a conductivity, W/(m K), and a coefficient of convection, W/(m² K).
  double conductance(const WallFace& face, double conductivity, double coefficient) const;
  double coefficient(double time) const { return coefficient_ ? (*coefficient_)(time) : 0; }

  HeatedFaces faces_;
  TimeFunction outside_;                     ///< temperature, K
  std::optional<TimeFunction> coefficient_;  ///< of convection; none: the surface is at `outside`
  const Conduction& conduction_;
};

}  // namespace solidem

#endif
