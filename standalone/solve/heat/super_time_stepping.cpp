// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/super_time_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/blocks.hpp"

namespace solidem {

namespace {

/// Share of the stability interval that is used: the limit is an estimate.
constexpr double margin = 0.95;

double b(int j) {
  return j < 2 ? 1.0 / 3 : (j * j + j - 2.0) / (2.0 * j * (j + 1.0));
}

}  // namespace

int SuperTimeStepping::stages(double ratio) {
  const double needed = 0.5 * (std::sqrt(9 + 16 * ratio / margin) - 1);
  const int count = std::max(3, static_cast<int>(std::ceil(needed - 1e-9)));
  return count + (count % 2 == 0 ? 1 : 0);
}

bool SuperTimeStepping::step(HeatBody& body, const HeatState& from, double h, double,
                             std::vector<double>& received) {
  // Properties that change on the way may ask for more stages at the end than at the start.
  int s = stages(h / body.stable_step(from));
  for (int trial = 0; trial < 4; ++trial) {
    step_in_stages(body, from, h, s, received);
    if (body.equation().is_linear()) return true;
    body.warm(from, received, from.time + h, stage_);
    const double stable_step = body.stable_step(stage_);
    if (!(stable_step > 0)) return false;
    const int needed = stages(h / stable_step);
    if (needed <= s) return true;
    s = needed;
  }
  return false;
}

void SuperTimeStepping::step_in_stages(HeatBody& body, const HeatState& from, double h, int s,
                                       std::vector<double>& received) {
  // Y_j, the heat received up to stage j, obeys the recursion of the temperatures without its
  // terms in the state at the start; accounts are elements of it like any other.
  const double w = 4.0 / (double(s) * s + s - 2);
  const std::size_t size = body.size();
  before_.assign(size, 0.0);
  next_.resize(size);
  received.resize(size);
  for (std::size_t i = 0; i < size; ++i) received[i] = b(1) * w * h * from.power[i];
  double time_before = 0, time = b(1) * w;  // of the last two stages, in steps
  for (int j = 2; j <= s; ++j) {
    body.warm(from, received, from.time + time * h, stage_);
    body.evaluate(stage_);
    const double mu = (2.0 * j - 1) / j * b(j) / b(j - 1);
    const double nu = -(j - 1.0) / j * b(j) / b(j - 2);
    const double mu_rate = mu * w;
    const double gamma_rate = -(1 - b(j - 1)) * mu_rate;
    for_blocks(size, 20000, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        next_[i] = mu * received[i] + nu * before_[i] +
                   h * (mu_rate * stage_.power[i] + gamma_rate * from.power[i]);
    });
    before_.swap(received);
    received.swap(next_);
    const double time_next = mu * time + nu * time_before + mu_rate + gamma_rate;
    time_before = time;
    time = time_next;
  }
}

double SuperTimeStepping::error(HeatBody& body, const HeatState& from, const HeatState& to,
                                double h, const std::vector<double>& received) {
  return largest_of_free(
      body, [&](std::size_t i) { return hermite_defect(body, from, to, h, received, i); });
}

double SuperTimeStepping::graded_step(HeatBody& body, const HeatState& from, double elapsed,
                                      double) const {
  return std::min(std::max(0.5 * elapsed, body.stable_step(from)), longest_step(body, from));
}

double SuperTimeStepping::longest_step(HeatBody& body, const HeatState& from) const {
  constexpr double most_stages = 1001;  // round-off grows with their square
  return 0.25 * margin * most_stages * most_stages * body.stable_step(from);
}

double SuperTimeStepping::work(HeatBody& body, const HeatState& from, double h) {
  constexpr double stage = 1.7;  // an evaluation and the recursion
  return stage * stages(h / body.stable_step(from));
}

}  // namespace solidem
