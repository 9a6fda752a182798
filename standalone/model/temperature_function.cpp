// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/temperature_function.hpp"

#include <algorithm>
#include <cmath>

#include "laws/interpolation.hpp"

namespace solidem {

namespace {

TablePoints points_of(const std::vector<double>& temperature, const std::vector<double>& value,
                      const std::vector<double>& integral) {
  return {static_cast<int>(value.size()), temperature.data(), value.data(), integral.data()};
}

}  // namespace

TemperatureFunction::TemperatureFunction(std::vector<double> temperature, std::vector<double> value)
    : temperature_(std::move(temperature)), value_(std::move(value)), integral_(value_.size()) {
  integrate_table(static_cast<int>(value_.size()), temperature_.data(), value_.data(),
                  integral_.data());
}

double TemperatureFunction::operator()(double temperature) const {
  return interpolate(points_of(temperature_, value_, integral_), temperature);
}

double TemperatureFunction::integral(double temperature) const {
  return integrate(points_of(temperature_, value_, integral_), temperature);
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
