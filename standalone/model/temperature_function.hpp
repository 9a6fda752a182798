// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_TEMPERATURE_FUNCTION_HPP
#define SOLIDEM_MODEL_TEMPERATURE_FUNCTION_HPP

#include <vector>

namespace solidem {

/// A material property that depends on temperature: linear between the points of a table, held
/// outside. One point is a constant.
class TemperatureFunction {
 public:
  TemperatureFunction(double constant = 0) : temperature_{0}, value_{constant}, integral_{0} {}
  /// Temperatures in K, strictly increasing, and as many values.
  TemperatureFunction(std::vector<double> temperature, std::vector<double> value);

  bool is_constant() const { return value_.size() == 1; }
  const std::vector<double>& temperatures() const { return temperature_; }
  const std::vector<double>& values() const { return value_; }
  double operator()(double temperature) const;

  /// ∫ value dT from the first temperature of the table (0 K for a constant).
  double integral(double temperature) const;
  /// The temperature at which the integral has a value; the inverse of `integral` for a property
  /// above zero.
  double inverse_integral(double integral) const;

  /// The smallest and the largest value.
  double least() const;
  double largest() const;

 private:
  std::vector<double> temperature_, value_, integral_;
};

}  // namespace solidem

#endif
