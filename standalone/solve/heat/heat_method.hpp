// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_HEAT_METHOD_HPP
#define SOLIDEM_SOLVE_HEAT_HEAT_METHOD_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "solve/heat/heat_body.hpp"

namespace solidem {

/// One way of taking one step.
class HeatMethod {
 public:
  virtual ~HeatMethod() = default;

  virtual std::string name() const = 0;
  /// Its count among the statistics.
  virtual std::int64_t& counter(HeatIntegratorStatistics& statistics) const = 0;
  /// Power of the step length in the error of one step.
  virtual int error_power() const = 0;
  /// Longest step a time `elapsed` after a jump of the loads, s, when advances take `duration`:
  /// longer ones would not follow what the jump sets going.
  virtual double graded_step(HeatBody&, const HeatState& /*from*/, double /*elapsed*/,
                             double duration) const {
    return duration;
  }
  /// Whether a change of the step length is dear.
  virtual bool prefers_equal_steps() const { return false; }

  /// A step of length h, s, from a state with powers: what was received (N + K), J. Solves are
  /// carried to a residual of `tolerance`, K, or to round-off if it is 0. False: no such step.
  virtual bool step(HeatBody& body, const HeatState& from, double h, double tolerance,
                    std::vector<double>& received) = 0;

  /// Estimated largest error of that step, K; both states with powers.
  virtual double error(HeatBody& body, const HeatState& from, const HeatState& to, double h,
                       const std::vector<double>& received) = 0;

  /// Longest step that is stable, s.
  virtual double longest_step(HeatBody& body, const HeatState& from) const = 0;

  /// Foreseen work of a step of length h, in evaluations of the powers: counted, never timed, so
  /// that a choice made from it is the same in every run.
  virtual double work(HeatBody& body, const HeatState& from, double h) = 0;

  /// What the foreseen work depends on besides: saved and restored.
  virtual double memory() const { return 0; }
  virtual void set_memory(double) {}
};

/// Third-order defect of a step from powers at both ends: what of the change of temperature in
/// element i does not follow from them, K (Sommeijer, Shampine & Verwer 1998, eq. 2.7).
inline double hermite_defect(const HeatBody& body, const HeatState& from, const HeatState& to,
                             double h, const std::vector<double>& received, std::size_t i) {
  return (0.4 * h * (from.power[i] + to.power[i]) - 0.8 * received[i]) / body.capacity(to, i);
}

}  // namespace solidem

#endif
