// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_ADAPTIVE_HEAT_STEPS_HPP
#define SOLIDEM_SOLVE_HEAT_ADAPTIVE_HEAT_STEPS_HPP

#include <memory>

#include "solve/heat/heat_method.hpp"

namespace solidem {

/// Steps as long as the estimated error of each, in any element, stays below a tolerance, never
/// beyond the end of an advance. With several methods each step is taken by the one whose foreseen
/// work per time is least.
class AdaptiveHeatSteps : public HeatIntegrator {
 public:
  AdaptiveHeatSteps(std::vector<std::unique_ptr<HeatMethod>> methods, double tolerance);
  double advance(HeatEquation& equation, double time, double duration, double* temperature,
                 double* heat) override;
  void restart() override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& saved) override;
  const HeatIntegratorStatistics& statistics() const override { return body_.statistics; }
  std::string explanation() const override;

 private:
  void foresee(double duration);
  double allowed(const HeatMethod& method, double remaining);
  int choose(double remaining);
  double error_in_tolerances(HeatMethod& method, double h, double remaining);
  bool adapt(const HeatMethod& method, double h, double error);

  std::vector<std::unique_ptr<HeatMethod>> methods_;
  double tolerance_;
  HeatBody body_;
  HeatState from_, to_;
  std::vector<double> received_;

  std::vector<double> foreseen_work_;  // of each method, over what remained at the last choice
  double foreseen_duration_ = 0;       // s, what remained then

  // What is known of the course of the temperatures; saved.
  double wanted_ = 0;       // second-order step that meets the tolerance, s; 0: not known
  double last_error_ = 1;   // of the last step taken, in tolerances
  double euler_error_ = 0;  // of an Euler step over its length squared, K/s²
  int method_ = -1;         // of the last step
};

}  // namespace solidem

#endif
