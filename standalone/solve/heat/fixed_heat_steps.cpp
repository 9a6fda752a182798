// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/fixed_heat_steps.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "model/error.hpp"

namespace solidem {

FixedHeatSteps::FixedHeatSteps(std::unique_ptr<HeatMethod> method) : method_(std::move(method)) {}

double FixedHeatSteps::advance(HeatEquation& equation, double time, double duration,
                               double* temperature, double* heat) {
  body_.bind(equation);
  double imposed_heat = 0;
  const double jump = body_.start(time, temperature, from_, imposed_heat);
  const double warmest = largest_of_free(body_, [&](std::size_t i) { return temperature[i]; });
  if (jump > 1e-6 * warmest) restart();
  double done = 0, halved = duration;
  while (done < duration) {
    body_.evaluate(from_);
    const double remaining = duration - done;
    const double longest = std::min(halved, method_->graded_step(body_, from_, elapsed_, duration));
    const double steps = std::max(1.0, std::ceil(remaining / longest - 1e-9));
    const double h = steps > 1 ? remaining / steps : remaining;
    if (!method_->step(body_, from_, h, 0, received_)) {
      ++body_.statistics.rejected;
      halved = 0.5 * h;
      if (!(halved > 1e-6 * duration))
        throw RunError(
            fmt::format("heat: no {} step from time {:.6g} s has a solution, however "
                        "short; look for a property that is not a number or not "
                        "positive",
                        method_->name(), from_.time));
      continue;
    }
    done = steps > 1 ? done + h : duration;
    body_.warm(from_, received_, time + done, to_);
    imposed_heat += body_.imposed_heat(from_, to_, received_);
    for (std::size_t k = body_.elements(); k < body_.size(); ++k)
      heat[k - body_.elements()] += received_[k];
    ++body_.statistics.inner_steps;
    ++method_->counter(body_.statistics);
    elapsed_ += h;
    std::swap(from_, to_);
  }
  std::copy(from_.temperature.begin(), from_.temperature.end(), temperature);
  return imposed_heat;
}

std::string FixedHeatSteps::explanation() const {
  return fmt::format("{}: one step of it per time step, as the scene asks", method_->name());
}

}  // namespace solidem
