// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_EXPLICIT_EULER_HPP
#define SOLIDEM_SOLVE_HEAT_EXPLICIT_EULER_HPP

#include "solve/heat/heat_method.hpp"

namespace solidem {

/// H(t + h) = H(t) + h P(t): first order, stable up to the explicit limit.
class ExplicitEuler : public HeatMethod {
 public:
  std::string name() const override { return "explicit"; }
  std::int64_t& counter(HeatIntegratorStatistics& statistics) const override {
    return statistics.explicit_steps;
  }
  int error_power() const override { return 2; }
  bool step(HeatBody& body, const HeatState& from, double h, double tolerance,
            std::vector<double>& received) override;
  double error(HeatBody& body, const HeatState& from, const HeatState& to, double h,
               const std::vector<double>& received) override;
  double longest_step(HeatBody& body, const HeatState& from) const override;
  double work(HeatBody& body, const HeatState& from, double h) override;
};

}  // namespace solidem

#endif
