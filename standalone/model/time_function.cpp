// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/time_function.hpp"

#include <algorithm>
#include <cmath>

#include "laws/constants.hpp"

namespace solidem {

namespace {

double table_value(const std::vector<double>& time, const std::vector<double>& value, double t) {
  if (time.empty()) return 0;
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  if (next == time.begin()) return value.front();
  if (next == time.end()) return value.back();
  const auto k = static_cast<std::size_t>(next - time.begin());
  const double fraction = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return value[k - 1] + fraction * (value[k] - value[k - 1]);
}

}  // namespace

double TimeFunction::operator()(double t) const {
  const double sine = amplitude == 0 ? 0 : amplitude * std::sin(two_pi * frequency * t + phase);
  return table_value(time, value, t) + sine;
}

double TimeFunction::rate(double t) const {
  const double omega = two_pi * frequency;
  double slope = amplitude == 0 ? 0 : amplitude * omega * std::cos(omega * t + phase);
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  if (next != time.begin() && next != time.end()) {
    const auto k = static_cast<std::size_t>(next - time.begin());
    slope += (value[k] - value[k - 1]) / (time[k] - time[k - 1]);
  }
  return slope;
}

double TimeFunction::integral(double t) const {
  // Trapezia between 0, the table's points inside (0, t) and t are exact for a piecewise linear
  // table.
  double sum = 0, from = 0;
  for (const double point : time) {
    if (point <= 0 || point >= t) continue;
    sum +=
        0.5 * (point - from) * (table_value(time, value, from) + table_value(time, value, point));
    from = point;
  }
  sum += 0.5 * (t - from) * (table_value(time, value, from) + table_value(time, value, t));
  if (amplitude == 0) return sum;
  if (frequency == 0) return sum + amplitude * std::sin(phase) * t;
  const double omega = two_pi * frequency;
  return sum + amplitude / omega * (std::cos(phase) - std::cos(omega * t + phase));
}

double TimeFunction::largest() const {
  return *std::max_element(value.begin(), value.end()) + std::fabs(amplitude);
}

double TimeFunction::largest_rate() const {
  double largest = 0;
  for (std::size_t k = 1; k < time.size(); ++k)
    largest = std::max(largest, std::fabs((value[k] - value[k - 1]) / (time[k] - time[k - 1])));
  return largest + two_pi * std::fabs(amplitude * frequency);
}

}  // namespace solidem
