// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/temperature_function.hpp"

#include <algorithm>
#include <cmath>

namespace solidem {

TemperatureFunction::TemperatureFunction(std::vector<double> temperature, std::vector<double> value)
    : temperature_(std::move(temperature)), value_(std::move(value)), integral_{0} {
  for (std::size_t k = 1; k < value_.size(); ++k)
    integral_.push_back(integral_.back() + 0.5 * (value_[k - 1] + value_[k]) *
                                               (temperature_[k] - temperature_[k - 1]));
}

double TemperatureFunction::operator()(double temperature) const {
  if (is_constant() || temperature <= temperature_.front()) return value_.front();
  if (temperature >= temperature_.back()) return value_.back();
  const auto next = std::upper_bound(temperature_.begin(), temperature_.end(), temperature);
  const auto k = static_cast<std::size_t>(next - temperature_.begin());
  const double fraction =
      (temperature - temperature_[k - 1]) / (temperature_[k] - temperature_[k - 1]);
  return value_[k - 1] + fraction * (value_[k] - value_[k - 1]);
}

double TemperatureFunction::integral(double temperature) const {
  if (is_constant() || temperature <= temperature_.front())
    return value_.front() * (temperature - temperature_.front());
  if (temperature >= temperature_.back())
    return integral_.back() + value_.back() * (temperature - temperature_.back());
  const auto next = std::upper_bound(temperature_.begin(), temperature_.end(), temperature);
  const auto k = static_cast<std::size_t>(next - temperature_.begin()) - 1;
  const double above = temperature - temperature_[k];
  const double slope = (value_[k + 1] - value_[k]) / (temperature_[k + 1] - temperature_[k]);
  return integral_[k] + above * (value_[k] + 0.5 * slope * above);
}

double TemperatureFunction::inverse_integral(double integral) const {
  if (is_constant() || integral <= 0) return temperature_.front() + integral / value_.front();
  if (integral >= integral_.back())
    return temperature_.back() + (integral - integral_.back()) / value_.back();
  const auto next = std::upper_bound(integral_.begin(), integral_.end(), integral);
  const auto k = static_cast<std::size_t>(next - integral_.begin()) - 1;
  const double slope = (value_[k + 1] - value_[k]) / (temperature_[k + 1] - temperature_[k]);
  // The root of value above + slope above² / 2 = rest, in the form that does not cancel.
  const double rest = integral - integral_[k];
  return temperature_[k] +
         2 * rest / (value_[k] + std::sqrt(value_[k] * value_[k] + 2 * slope * rest));
}

double TemperatureFunction::least() const {
  return *std::min_element(value_.begin(), value_.end());
}

double TemperatureFunction::largest() const {
  return *std::max_element(value_.begin(), value_.end());
}

}  // namespace solidem
