// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/implicit_heat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace solidem {

namespace {

const double gamma = 1 - std::sqrt(0.5);
constexpr int most_sweeps = 30;
/// Work of a product with the conductance matrix in evaluations of the powers.
constexpr double product = 3;

}  // namespace

bool ImplicitHeat::knows(const HeatEquation& equation) const {
  return equation_ == &equation && version_ == equation.version();
}

void ImplicitHeat::take_conductances(HeatBody& body, const HeatState& at) {
  HeatEquation& equation = body.equation();
  if (knows(equation) && equation.is_linear()) return;
  const auto conductance = equation.conductance_matrix(at.time, at.temperature.data());
  capacity_.resize(body.elements());
  std::vector<char> imposed(body.elements());
  stiffness_rate_ = 0;
  for (std::size_t i = 0; i < body.elements(); ++i) {
    capacity_[i] = body.capacity(at, i);
    imposed[i] = body.is_imposed(i) ? 1 : 0;
    const auto k = static_cast<Eigen::Index>(i);
    if (imposed[i] == 0)
      stiffness_rate_ = std::max(stiffness_rate_, conductance.coeff(k, k) / capacity_[i]);
  }
  solver_.set_conductance(conductance, imposed);
  equation_ = &equation;
  version_ = equation.version();
  theta_ = 0;
  lasting_ = false;
}

void ImplicitHeat::prepare(HeatBody& body, const HeatState& at, double theta) {
  take_conductances(body, at);
  // A step length that comes back is one that stays.
  const bool lasting = body.equation().is_linear() && theta == last_theta_;
  if (theta == theta_ && (lasting_ >= lasting || solver_.is_factorised())) return;
  theta_ = last_theta_ = theta;
  lasting_ = lasting;
  solver_.prepare(capacity_, theta, lasting, body.statistics);
}

/// Stage: H(T) = H(from) + before + θ P(T), from a first guess in `stage`, whose time is set.
bool ImplicitHeat::solve_stage(HeatBody& body, const HeatState& from,
                               const std::vector<double>& before, double theta, double tolerance,
                               HeatState& stage) {
  residual_.resize(body.elements());
  double last = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    body.impose(stage);
    body.evaluate(stage);
    double size = 0, warmest = 0;
    for (std::size_t i = 0; i < body.elements(); ++i) {
      warmest = std::max(warmest, std::fabs(stage.temperature[i]));
      residual_[i] = 0;
      if (body.is_imposed(i)) continue;
      residual_[i] = before[i] + theta * stage.power[i] - body.enthalpy_change(from, stage, i);
      const double kelvin = std::fabs(residual_[i]) / capacity_[i];
      if (!(kelvin <= size)) size = kelvin;
    }
    if (!std::isfinite(size)) return false;
    // Round-off of θP, in kelvin; no sweep gets below it.
    const double floor =
        16 * std::numeric_limits<double>::epsilon() * (1 + theta * stiffness_rate_) * warmest;
    const double goal = std::max(tolerance > 0 ? tolerance : 1e-10 * warmest, floor);
    // A stage that no solve has touched is an explicit one: it would amplify what it is given.
    if (size <= floor || (size <= goal && sweep > 0)) return true;
    if (!(size < 1e3 * last)) return false;
    // Sweeps that hardly gain need the matrix of where they have got to.
    if (!body.equation().is_linear() && size > 0.3 * last) prepare(body, stage, theta);
    last = size;
    const double reduction = std::clamp(0.3 * goal / size, 1e-12, 0.1);
    if (!solver_.solve(residual_, correction_, reduction, body.statistics)) return false;
    for (std::size_t i = 0; i < body.elements(); ++i) stage.temperature[i] += correction_[i];
  }
  return false;
}

bool ImplicitHeat::step(HeatBody& body, const HeatState& from, double h, double tolerance,
                        std::vector<double>& received) {
  const double theta = gamma * h;
  prepare(body, from, theta);
  first_.temperature = from.temperature;
  first_.time = from.time + theta;
  before_.assign(body.size(), 0.0);
  if (!solve_stage(body, from, before_, theta, tolerance, first_)) return false;
  for (std::size_t i = 0; i < body.size(); ++i) before_[i] = (1 - gamma) * h * first_.power[i];
  second_.temperature = first_.temperature;
  second_.time = from.time + h;
  if (!solve_stage(body, from, before_, theta, tolerance, second_)) return false;
  received.resize(body.size());
  for (std::size_t i = 0; i < body.size(); ++i) received[i] = before_[i] + theta * second_.power[i];
  return true;
}

double ImplicitHeat::error(HeatBody& body, const HeatState& from, const HeatState& to, double h,
                           const std::vector<double>& received) {
  // Modes much faster than the step are all but gone at its end, yet large in the powers at its
  // start: the matrix of the step takes them back to the size they have.
  std::vector<double>& defect = residual_;
  defect.resize(body.elements());
  for (std::size_t i = 0; i < body.elements(); ++i)
    defect[i] = body.is_imposed(i)
                    ? 0
                    : hermite_defect(body, from, to, h, received, i) * body.capacity(to, i);
  if (!solver_.solve(defect, correction_, 1e-2, body.statistics))
    return std::numeric_limits<double>::infinity();
  return largest_of_free(body, [&](std::size_t i) { return correction_[i]; });
}

double ImplicitHeat::graded_step(HeatBody& body, const HeatState& from, double elapsed,
                                 double duration) const {
  return std::max({elapsed, duration / 64, body.stable_step(from)});
}

double ImplicitHeat::longest_step(HeatBody&, const HeatState&) const {
  return std::numeric_limits<double>::infinity();
}

double ImplicitHeat::work(HeatBody& body, const HeatState& from, double h) {
  const bool linear = body.equation().is_linear();
  if (linear || !knows(body.equation())) take_conductances(body, from);
  const double theta = gamma * h;
  const bool lasting = linear && theta == last_theta_;
  const ConductanceSolver::Work solver = solver_.work(theta * stiffness_rate_, lasting);
  const double sweeps = linear ? 1 : 3;  // of each stage
  const double prepare = lasting ? 0 : solver.prepare;
  return 2 * (sweeps + 1) + 1 + product * ((2 * sweeps + 1) * solver.solve + prepare);
}

}  // namespace solidem
