// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_IMPLICIT_HEAT_HPP
#define SOLIDEM_SOLVE_HEAT_IMPLICIT_HEAT_HPP

#include "solve/heat/conductance_solver.hpp"
#include "solve/heat/heat_method.hpp"

namespace solidem {

/// SDIRK2 (Alexander, SIAM J. Numer. Anal. 14, 1977): two implicit stages at t + γh and t + h,
/// γ = 1 − 1/√2, second order, L-stable:
///   H₁ = H + hγ P₁,  H₂ = H + h(1 − γ) P₁ + hγ P₂.
/// Each stage is solved by sweeps with C + hγK until what is left of its equation is below the
/// tolerance; the step then takes the powers evaluated at the stages, so that what a solver leaves
/// is an error of temperature, never of the balance.
class ImplicitHeat : public HeatMethod {
 public:
  std::string name() const override { return "implicit"; }
  std::int64_t& counter(HeatIntegratorStatistics& statistics) const override {
    return statistics.implicit_steps;
  }
  int error_power() const override { return 3; }
  double graded_step(HeatBody& body, const HeatState& from, double elapsed,
                     double duration) const override;
  bool prefers_equal_steps() const override { return true; }
  bool step(HeatBody& body, const HeatState& from, double h, double tolerance,
            std::vector<double>& received) override;
  double error(HeatBody& body, const HeatState& from, const HeatState& to, double h,
               const std::vector<double>& received) override;
  double longest_step(HeatBody& body, const HeatState& from) const override;
  double work(HeatBody& body, const HeatState& from, double h) override;
  double memory() const override { return last_theta_; }
  void set_memory(double theta) override { last_theta_ = theta; }

 private:
  bool solve_stage(HeatBody& body, const HeatState& from, const std::vector<double>& before,
                   double theta, double tolerance, HeatState& stage);
  /// Whether the solver has conductances of this very equation.
  bool knows(const HeatEquation& equation) const;
  void take_conductances(HeatBody& body, const HeatState& at);
  void prepare(HeatBody& body, const HeatState& at, double theta);

  ConductanceSolver solver_;
  HeatEquation* equation_ = nullptr;  // whose conductances the solver has
  std::uint64_t version_ = 0;         // of the equation
  double theta_ = 0;                  // it is ready for
  bool lasting_ = false;              // for many solves
  double last_theta_ = 0;             // it was ready for, in this run or one that it goes on with
  double stiffness_rate_ = 0;         // largest K_ii/C_i, 1/s
  HeatState first_, second_;
  std::vector<double> capacity_, before_, residual_, correction_;
};

}  // namespace solidem

#endif
