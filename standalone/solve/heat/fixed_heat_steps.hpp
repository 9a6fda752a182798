// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_FIXED_HEAT_STEPS_HPP
#define SOLIDEM_SOLVE_HEAT_FIXED_HEAT_STEPS_HPP

#include <memory>

#include "solve/heat/heat_method.hpp"

namespace solidem {

/// One step per advance, with two exceptions. After a jump of the loads steps start short and grow
/// with the time since, as the method needs it. And an implicit step that finds no solution is
/// tried again in halves.
class FixedHeatSteps : public HeatIntegrator {
 public:
  explicit FixedHeatSteps(std::unique_ptr<HeatMethod> method);
  double advance(HeatEquation& equation, double time, double duration, double* temperature,
                 double* heat) override;
  void restart() override { elapsed_ = 0; }
  std::vector<double> save() const override { return {elapsed_, method_->memory()}; }
  void restore(const std::vector<double>& saved) override {
    elapsed_ = saved.at(0);
    method_->set_memory(saved.at(1));
  }
  const HeatIntegratorStatistics& statistics() const override { return body_.statistics; }
  std::string explanation() const override;

 private:
  std::unique_ptr<HeatMethod> method_;
  HeatBody body_;
  HeatState from_, to_;
  std::vector<double> received_;
  double elapsed_ = 0;  // s since the start or the last jump
};

}  // namespace solidem

#endif
