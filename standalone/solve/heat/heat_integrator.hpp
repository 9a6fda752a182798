// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_HEAT_INTEGRATOR_HPP
#define SOLIDEM_SOLVE_HEAT_HEAT_INTEGRATOR_HPP

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace solidem {

class HeatEquation;

/// What an integrator did since it was made.
struct HeatIntegratorStatistics {
  std::int64_t inner_steps = 0;     ///< steps taken
  std::int64_t rejected = 0;        ///< steps tried and taken back
  std::int64_t evaluations = 0;     ///< of the powers of all elements
  std::int64_t solves = 0;          ///< of linear systems
  std::int64_t iterations = 0;      ///< of conjugate gradients, in all solves
  std::int64_t factorisations = 0;  ///< complete or incomplete
  std::int64_t explicit_steps = 0;  ///< of the inner steps
  std::int64_t rkl2_steps = 0;      ///< of the inner steps
  std::int64_t implicit_steps = 0;  ///< of the inner steps
};

enum class HeatIntegration { explicit_euler, rkl2, implicit, automatic };

struct HeatIntegratorParameters {
  double tolerance = 0;  ///< K, error of an inner step in any element; 0: one step per advance
};

/// Carries the temperatures of a body through time, whichever way. Every way has the same ledger:
/// what all elements gain in enthalpy is what the accounts and the imposed temperatures gave, to
/// round-off.
class HeatIntegrator {
 public:
  virtual ~HeatIntegrator() = default;

  /// Advances `temperature` (N), K, from `time` by `duration`, s, and adds what came from each
  /// account to `heat` (K), J. Returns the heat, J, that it took to impose temperatures: the
  /// enthalpy that imposed elements gained less what the others and the accounts gave them.
  /// Throws RunError when no step is short enough.
  virtual double advance(HeatEquation& equation, double time, double duration, double* temperature,
                         double* heat) = 0;

  /// The loads jump at the time reached: what was learnt about step lengths no longer holds.
  virtual void restart() = 0;

  /// What the next advance depends on besides the equation and the temperatures: an integrator
  /// that restores what another saved goes on with the same bits.
  virtual std::vector<double> save() const = 0;
  virtual void restore(const std::vector<double>& saved) = 0;

  virtual const HeatIntegratorStatistics& statistics() const = 0;

  /// What is done and why, one sentence for the user.
  virtual std::string explanation() const = 0;
};

/// Throws InputError for a tolerance that the choice has no use for, or lacks.
std::unique_ptr<HeatIntegrator> make_heat_integrator(HeatIntegration choice,
                                                     const HeatIntegratorParameters& parameters);

}  // namespace solidem

#endif
