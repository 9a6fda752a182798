// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_HEAT_EQUATION_HPP
#define SOLIDEM_SOLVE_HEAT_HEAT_EQUATION_HPP

#include <cstddef>
#include <cstdint>
#include <Eigen/SparseCore>
#include <vector>

namespace solidem {

/// dH_i/dt = P_i(T, t): what an integrator of heat sees of a body. H_i(T) is an element's enthalpy;
/// with constant capacities H_i = C_i T_i.
class HeatEquation {
 public:
  virtual ~HeatEquation() = default;

  virtual std::size_t elements() const = 0;
  /// Heats from outside that are followed, each with its own power.
  virtual std::size_t accounts() const = 0;
  /// Whether capacities and conductances are the same at every temperature and time, so that a
  /// factorisation lasts.
  virtual bool is_linear() const = 0;

  /// Power into each element (N), W, and of each account (K), W, at temperatures (N), K, and a
  /// time, s. What flows between two elements is equal and opposite to the last bit: balances close
  /// no better than that.
  virtual void powers(double time, const double* temperature, double* power, double* account) = 0;

  /// Elements whose temperature is imposed, and the setting of it; the others are left alone. Power
  /// into such an element is not what changes its temperature.
  virtual const std::vector<std::int32_t>& imposed() const = 0;
  virtual void impose(double time, double* temperature) const = 0;

  /// Enthalpy of element i above that at its initial temperature, J; its inverse; its derivative,
  /// J/K.
  virtual double enthalpy(std::size_t i, double temperature) const = 0;
  virtual double temperature(std::size_t i, double enthalpy) const = 0;
  virtual double capacity(std::size_t i, double temperature) const = 0;

  /// −∂P/∂T at fixed conductivities, symmetric positive semi-definite (N, N), W/K: neighbours and
  /// exchanges. The rows of imposed elements are not special.
  virtual Eigen::SparseMatrix<double> conductance_matrix(double time,
                                                         const double* temperature) const = 0;

  /// Counts the changes of what conducts: of an older version nothing holds that was derived from
  /// the powers, the conductances or the stable step.
  virtual std::uint64_t version() const { return 0; }

  /// The longest stable explicit step at a time and temperatures, s.
  virtual double stable_step(double time, const double* temperature) const = 0;
};

}  // namespace solidem

#endif
