// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_SUPER_TIME_STEPPING_HPP
#define SOLIDEM_SOLVE_HEAT_SUPER_TIME_STEPPING_HPP

#include "solve/heat/heat_method.hpp"

namespace solidem {

/// RKL2 (Meyer, Balsara & Aslam, J. Comput. Phys. 257, 2014, eqs 16-22): s explicit stages make one
/// stable second-order step of up to (s² + s − 2)/4 explicit ones, after shifted Legendre
/// polynomials. s is odd: even ones leave the roughest mode undamped.
class SuperTimeStepping : public HeatMethod {
 public:
  std::string name() const override { return "rkl2"; }
  std::int64_t& counter(HeatIntegratorStatistics& statistics) const override {
    return statistics.rkl2_steps;
  }
  int error_power() const override { return 3; }
  double graded_step(HeatBody& body, const HeatState& from, double elapsed,
                     double duration) const override;
  bool step(HeatBody& body, const HeatState& from, double h, double tolerance,
            std::vector<double>& received) override;
  double error(HeatBody& body, const HeatState& from, const HeatState& to, double h,
               const std::vector<double>& received) override;
  double longest_step(HeatBody& body, const HeatState& from) const override;
  double work(HeatBody& body, const HeatState& from, double h) override;

  /// Stages of a step h times the explicit limit.
  static int stages(double ratio);

 private:
  void step_in_stages(HeatBody& body, const HeatState& from, double h, int s,
                      std::vector<double>& received);

  HeatState stage_;
  std::vector<double> before_, next_;
};

}  // namespace solidem

#endif
