// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/heat_body.hpp"

#include <algorithm>
#include <cmath>

#include "model/blocks.hpp"

namespace solidem {

void HeatBody::bind(HeatEquation& equation) {
  if (equation_ == &equation && version_ == equation.version()) return;
  equation_ = &equation;
  version_ = equation.version();
  elements_ = equation.elements();
  accounts_ = equation.accounts();
  linear_ = equation.is_linear();
  stable_step_ = 0;
  imposed_mask_.assign(elements_, 0);
  for (const std::int32_t i : equation.imposed()) imposed_mask_[static_cast<std::size_t>(i)] = 1;
  capacity_.clear();
  if (!linear_) return;
  for (std::size_t i = 0; i < elements_; ++i) capacity_.push_back(equation.capacity(i, 0));
}

void HeatBody::impose(HeatState& state) const {
  equation_->impose(state.time, state.temperature.data());
  if (state.enthalpy.empty()) return;
  for (const std::int32_t k : equation_->imposed()) {
    const auto i = static_cast<std::size_t>(k);
    state.enthalpy[i] = equation_->enthalpy(i, state.temperature[i]);
  }
}

double HeatBody::start(double time, const double* temperature, HeatState& to,
                       double& imposed_heat) {
  to.time = time;
  to.temperature.assign(temperature, temperature + elements_);
  to.power.assign(size(), 0.0);
  to.enthalpy.clear();
  if (!linear_)
    for (std::size_t i = 0; i < elements_; ++i)
      to.enthalpy.push_back(equation_->enthalpy(i, temperature[i]));
  const HeatState before = to;
  impose(to);
  double jump = 0;
  for (const std::int32_t k : equation_->imposed()) {
    const auto i = static_cast<std::size_t>(k);
    imposed_heat += enthalpy_change(before, to, i);
    jump = std::max(jump, std::fabs(to.temperature[i] - temperature[i]));
  }
  return jump;
}

void HeatBody::evaluate(HeatState& state) {
  ++statistics.evaluations;
  state.power.resize(size());
  equation_->powers(state.time, state.temperature.data(), state.power.data(),
                    state.power.data() + elements_);
}

void HeatBody::warm(const HeatState& from, const std::vector<double>& received, double time,
                    HeatState& to) {
  to.time = time;
  to.temperature.resize(elements_);
  if (!linear_) to.enthalpy.resize(elements_);
  for_blocks(elements_, 20000, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (linear_) {
        to.temperature[i] = from.temperature[i] + received[i] / capacity_[i];
      } else if (!is_imposed(i)) {
        to.enthalpy[i] = from.enthalpy[i] + received[i];
        to.temperature[i] = equation_->temperature(i, to.enthalpy[i]);
      }
    }
  });
  impose(to);
}

double HeatBody::imposed_heat(const HeatState& from, const HeatState& to,
                              const std::vector<double>& received) const {
  double heat = 0;
  for (const std::int32_t k : equation_->imposed()) {
    const auto i = static_cast<std::size_t>(k);
    heat += enthalpy_change(from, to, i) - received[i];
  }
  return heat;
}

double HeatBody::stable_step(const HeatState& state) {
  if (!linear_ || !(stable_step_ > 0))
    stable_step_ = equation_->stable_step(state.time, state.temperature.data());
  return stable_step_;
}

}  // namespace solidem
