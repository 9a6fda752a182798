// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/adaptive_heat_steps.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/error.hpp"

namespace solidem {

namespace {

/// Share of the tolerance that a step aims at is the cube of this.
constexpr double safety = 0.8;
/// Hermite defect of a step over its length cubed and the third derivative.
constexpr double defect_constant = 0.8 / 12;

/// Number of equal steps, none longer than `longest`, that fill a duration.
double count_of_steps(double duration, double longest) {
  return std::max(1.0, std::ceil(duration / longest - 1e-9));
}

}  // namespace

AdaptiveHeatSteps::AdaptiveHeatSteps(std::vector<std::unique_ptr<HeatMethod>> methods,
                                     double tolerance)
    : methods_(std::move(methods)), tolerance_(tolerance) {}

void AdaptiveHeatSteps::restart() {
  wanted_ = 0;
  last_error_ = 1;
  euler_error_ = 0;
  method_ = -1;
}

std::vector<double> AdaptiveHeatSteps::save() const {
  std::vector<double> saved{wanted_, last_error_, euler_error_, static_cast<double>(method_)};
  for (const auto& method : methods_) saved.push_back(method->memory());
  return saved;
}

void AdaptiveHeatSteps::restore(const std::vector<double>& saved) {
  wanted_ = saved.at(0);
  last_error_ = saved.at(1);
  euler_error_ = saved.at(2);
  if (!(saved.at(3) >= -1 && saved.at(3) < static_cast<double>(methods_.size())))
    throw std::out_of_range("a method of integration that there is not");
  method_ = static_cast<int>(saved.at(3));
  for (std::size_t m = 0; m < methods_.size(); ++m) methods_[m]->set_memory(saved.at(4 + m));
}

/// A first step length from the powers now and after a tiny Euler step: the third derivative is
/// taken from the time scale of the first two.
void AdaptiveHeatSteps::foresee(double duration) {
  const double probe = 0.1 * std::min(duration, body_.stable_step(from_));
  const double rate = largest_of_free(
      body_, [&](std::size_t i) { return from_.power[i] / body_.capacity(from_, i); });
  received_.resize(body_.size());
  for (std::size_t i = 0; i < received_.size(); ++i) received_[i] = probe * from_.power[i];
  body_.warm(from_, received_, from_.time + probe, to_);
  body_.evaluate(to_);
  euler_error_ = largest_of_free(body_, [&](std::size_t i) {
    return 0.5 * (to_.power[i] - from_.power[i]) / (probe * body_.capacity(to_, i));
  });
  const double third = rate > 0 ? 4 * euler_error_ * euler_error_ / rate : 0;
  wanted_ = third > 0 ? safety * std::cbrt(tolerance_ / (defect_constant * third)) : duration;
  if (rate == 0 && euler_error_ > 0) wanted_ = safety * std::sqrt(tolerance_ / euler_error_);
  wanted_ = std::max(wanted_, probe);
}

/// Longest step of a method. An Euler step is held to its share of the tolerance of the longer
/// second-order step, for it takes several of them to go as far.
double AdaptiveHeatSteps::allowed(const HeatMethod& method, double remaining) {
  const double stable = method.longest_step(body_, from_);
  if (method.error_power() > 2) return std::min(wanted_, stable);
  const double longest = std::min(wanted_, stable);
  const double fraction = euler_error_ * std::min(wanted_, remaining);
  return fraction > 0 ? std::min(longest, safety * tolerance_ / fraction) : longest;
}

/// The method with the least foreseen work for what remains. Each leaves other traces in the
/// temperatures, so that a change must promise a gain.
int AdaptiveHeatSteps::choose(double remaining) {
  if (methods_.size() == 1) return 0;
  foreseen_duration_ = remaining;
  foreseen_work_.assign(methods_.size(), 0.0);
  int best = 0;
  double least = 0;
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    const double steps = count_of_steps(remaining, allowed(*methods_[m], remaining));
    foreseen_work_[m] = steps * methods_[m]->work(body_, from_, remaining / steps);
    const int index = static_cast<int>(m);
    const double work = foreseen_work_[m] * (index == method_ ? 0.7 : 1);
    if (m == 0 || work < least) {
      best = index;
      least = work;
    }
  }
  return best;
}

double AdaptiveHeatSteps::error_in_tolerances(HeatMethod& method, double h, double remaining) {
  double error = method.error(body_, from_, to_, h, received_) / tolerance_;
  if (methods_.size() > 1)
    euler_error_ = largest_of_free(body_, [&](std::size_t i) {
      return 0.5 * (to_.power[i] - from_.power[i]) / (h * body_.capacity(to_, i));
    });
  if (method.error_power() == 2) error *= std::max(1.0, std::min(wanted_, remaining) / h);
  return error;
}

/// Adapts the wanted step to the error of one of length h, in tolerances; whether it changed.
bool AdaptiveHeatSteps::adapt(const HeatMethod& method, double h, double error) {
  const double before = wanted_;
  const int power = method.error_power();
  if (!(error <= 1)) {
    const double factor = std::max(0.1, safety * std::pow(error, -1.0 / power));
    // An Euler step that fails says so in its own constant; longer ones of second order may do.
    wanted_ = power == 2 ? 0.7 * wanted_ : factor * h;
    if (!std::isfinite(euler_error_)) euler_error_ = 0;
    return true;
  }
  if (power == 2) {
    const double rate = largest_of_free(
        body_, [&](std::size_t i) { return to_.power[i] / body_.capacity(to_, i); });
    const double third = rate > 0 ? 4 * euler_error_ * euler_error_ / rate : 0;
    const double guess =
        third > 0 ? safety * std::cbrt(tolerance_ / (defect_constant * third)) : 2 * wanted_;
    wanted_ = std::clamp(guess, 0.5 * wanted_, 2 * wanted_);
    return true;
  }
  // Proportional and integral control (Gustafsson 1991) of a third-order error.
  const double now = std::max(error, 1e-4);
  const double factor = std::clamp(
      safety * std::pow(now, -0.7 / power) * std::pow(last_error_, 0.4 / power), 0.2, 5.0);
  last_error_ = now;
  if (method.prefers_equal_steps()) {
    if (factor * h > 1.6 * wanted_) wanted_ = factor * h;
  } else if (factor < 1 || factor * h > wanted_) {
    wanted_ = factor * h;
  }
  return wanted_ != before;
}

double AdaptiveHeatSteps::advance(HeatEquation& equation, double time, double duration,
                                  double* temperature, double* heat) {
  body_.bind(equation);
  double imposed_heat = 0;
  const double jump = body_.start(time, temperature, from_, imposed_heat);
  if (jump > tolerance_) restart();
  body_.evaluate(from_);
  if (!(wanted_ > 0)) foresee(duration);

  double done = 0, h = 0;
  int planned = 0;  // equal steps still to go
  while (done < duration) {
    const double remaining = duration - done;
    if (planned == 0) {
      method_ = choose(remaining);
      const HeatMethod& method = *methods_[static_cast<std::size_t>(method_)];
      const double steps = count_of_steps(remaining, allowed(method, remaining));
      h = remaining / steps;
      planned = static_cast<int>(std::min(steps, 1e9));
    }
    if (!(from_.time + h > from_.time))
      throw RunError(
          fmt::format("heat: no step from time {:.6g} s, however short, meets the "
                      "tolerance of {:.3g} K; look for a property or a load that is not "
                      "a number",
                      from_.time, tolerance_));
    HeatMethod& method = *methods_[static_cast<std::size_t>(method_)];
    if (!method.step(body_, from_, h, 1e-3 * tolerance_, received_)) {
      ++body_.statistics.rejected;
      wanted_ = 0.25 * h;
      planned = 0;
      continue;
    }
    const bool last = planned == 1;
    body_.warm(from_, received_, time + (last ? duration : done + h), to_);
    body_.evaluate(to_);
    const double error = error_in_tolerances(method, h, remaining);
    const bool changed = adapt(method, h, error);
    if (!(error <= 1)) {
      ++body_.statistics.rejected;
      planned = 0;
      continue;
    }
    imposed_heat += body_.imposed_heat(from_, to_, received_);
    for (std::size_t k = body_.elements(); k < body_.size(); ++k)
      heat[k - body_.elements()] += received_[k];
    ++body_.statistics.inner_steps;
    ++method.counter(body_.statistics);
    std::swap(from_, to_);
    --planned;
    done = last ? duration : done + h;
    if (changed || !method.prefers_equal_steps()) planned = 0;
  }
  std::copy(from_.temperature.begin(), from_.temperature.end(), temperature);
  return imposed_heat;
}

std::string AdaptiveHeatSteps::explanation() const {
  if (methods_.size() == 1)
    return fmt::format("{}: inner steps with an estimated error of at most {:.3g} K",
                       methods_[0]->name(), tolerance_);
  std::string text = fmt::format(
      "auto: inner steps with an estimated error of at most {:.3g} K, each by the way that "
      "promises "
      "the least work: {} explicit, {} rkl2, {} implicit",
      tolerance_, body_.statistics.explicit_steps, body_.statistics.rkl2_steps,
      body_.statistics.implicit_steps);
  if (!foreseen_work_.empty()) {
    text +=
        fmt::format("; foreseen at the last choice, for {:.3g} s, in evaluations of the heat flow:",
                    foreseen_duration_);
    for (std::size_t m = 0; m < methods_.size(); ++m)
      text += fmt::format("{} {} {:.3g}", m > 0 ? "," : "", methods_[m]->name(), foreseen_work_[m]);
  }
  return text;
}

}  // namespace solidem
