// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_HEAT_BODY_HPP
#define SOLIDEM_SOLVE_HEAT_HEAT_BODY_HPP

#include <cmath>
#include <limits>
#include <vector>

#include "solve/heat/heat_equation.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

/// A body of N elements and K accounts at one time.
struct HeatState {
  double time = 0;                  ///< s
  std::vector<double> temperature;  ///< (N), K
  std::vector<double> enthalpy;     ///< (N), J; empty while capacities are constant
  std::vector<double> power;        ///< (N + K), W: into elements, then of accounts
};

/// A heat equation as the steps use it. A step is known by the heat that each element and each
/// account *received* (N + K, J), a sum of powers with the weights of the method; temperatures
/// follow from it. So the ledger of every method closes, whatever its error.
class HeatBody {
 public:
  /// Attaches to an equation; what was kept of another one, or version, is forgotten.
  void bind(HeatEquation& equation);

  HeatEquation& equation() { return *equation_; }
  std::size_t elements() const { return elements_; }
  /// Elements and accounts.
  std::size_t size() const { return elements_ + accounts_; }
  bool is_imposed(std::size_t i) const { return imposed_mask_[i] != 0; }

  /// State `to` at a time with these temperatures (N), those imposed set. Returns the largest
  /// change of an imposed temperature, K; adds the heat it took to `imposed_heat`, J.
  double start(double time, const double* temperature, HeatState& to, double& imposed_heat);

  /// Sets the temperatures of a state that are imposed at its time.
  void impose(HeatState& state) const;

  /// Powers of a state from its time and temperatures.
  void evaluate(HeatState& state);

  /// State `to` at a time when the elements have received this heat since `from`: temperatures and
  /// enthalpies, not powers.
  void warm(const HeatState& from, const std::vector<double>& received, double time, HeatState& to);

  /// Heat that it took to impose temperatures, J, on the way between two states.
  double imposed_heat(const HeatState& from, const HeatState& to,
                      const std::vector<double>& received) const;

  /// J/K
  double capacity(const HeatState& state, std::size_t i) const {
    return linear_ ? capacity_[i] : equation_->capacity(i, state.temperature[i]);
  }
  double enthalpy_change(const HeatState& from, const HeatState& to, std::size_t i) const {
    return linear_ ? capacity_[i] * (to.temperature[i] - from.temperature[i])
                   : equation_->enthalpy(i, to.temperature[i]) - from.enthalpy[i];
  }

  /// Longest stable explicit step, s.
  double stable_step(const HeatState& state);

  HeatIntegratorStatistics statistics;

 private:
  HeatEquation* equation_ = nullptr;
  std::uint64_t version_ = 0;  // of the equation
  std::size_t elements_ = 0, accounts_ = 0;
  bool linear_ = false;
  std::vector<double> capacity_;  // (N), constant capacities only
  std::vector<char> imposed_mask_;
  double stable_step_ = 0;
};

/// The largest of |value(i)| over free elements, K; infinite when one is not a number.
template <typename Value>
double largest_of_free(const HeatBody& body, const Value& value) {
  double largest = 0;
  bool finite = true;
  for (std::size_t i = 0; i < body.elements(); ++i) {
    if (body.is_imposed(i)) continue;
    const double size = std::fabs(value(i));
    finite = finite && std::isfinite(size);
    if (size > largest) largest = size;
  }
  return finite ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace solidem

#endif
