// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_IMPOSED_TEMPERATURE_HPP
#define SOLIDEM_EFFECTS_IMPOSED_TEMPERATURE_HPP

#include <vector>

#include "effects/effect.hpp"
#include "effects/parameters.hpp"

namespace solidem {

/// Elements whose temperature is imposed. Conduction treats them as free; the difference to what is
/// imposed is the heat that came in from outside.
class ImposedTemperature : public Effect {
 public:
  ImposedTemperature(const ImposedTemperatureParameters& parameters,
                     std::vector<std::int32_t> elements, Model& model);

  void advance(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;
  std::vector<double> save() const override { return {heat_}; }
  void restore(const std::vector<double>& saved) override { heat_ = saved.at(0); }

 private:
  /// Sets the elements' temperature and counts the heat that this takes.
  void impose(const Model& model, double* temperature, double value);

  ImposedTemperatureParameters parameters_;
  std::vector<std::int32_t> elements_;
  double heat_ = 0;  ///< J, since the start
};

}  // namespace solidem

#endif
