// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_IMPOSED_TEMPERATURE_HPP
#define SOLIDEM_EFFECTS_IMPOSED_TEMPERATURE_HPP

#include <vector>

#include "effects/conduction.hpp"
#include "effects/heat_load_parameters.hpp"

namespace solidem {

/// Elements whose temperature is imposed. Conduction treats them as free; the difference to what is
/// imposed is the heat that came in from outside.
class ImposedTemperature : public Effect {
 public:
  ImposedTemperature(const ImposedTemperatureParameters& parameters,
                     std::vector<std::int32_t> elements, const Conduction& conduction,
                     Model& model);

  const std::vector<std::int32_t>& elements() const { return elements_; }
  double temperature(double time) const { return parameters_.temperature(time); }

  /// Sets the elements' temperature and counts the heat that this takes.
  void impose(const Model& model, double* temperature, double value);

  /// Counts heat, J, that an integrator brought in.
  void count(double heat) { heat_ += heat; }

  void advance(Model& model, const Step& step) override;
  /// Takes what other heat than that of neighbours and loads did to the elements since a time, s.
  void hold(Model& model, double time) {
    impose(model, model.data(columns::temperature), temperature(time));
  }
  void observe(const Model& model, Observation& observation) const override;
  void state(Archive& archive) override { archive(heat_); }

 private:
  ImposedTemperatureParameters parameters_;
  std::vector<std::int32_t> elements_;
  const Conduction& conduction_;
  double heat_ = 0;  ///< J, since the start
};

}  // namespace solidem

#endif
