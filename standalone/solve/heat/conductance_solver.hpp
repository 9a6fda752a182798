// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_HEAT_CONDUCTANCE_SOLVER_HPP
#define SOLIDEM_SOLVE_HEAT_CONDUCTANCE_SOLVER_HPP

#include <cstdint>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "solve/heat/heat_integrator.hpp"

namespace solidem {

/// Solves (C + θ K) x = b on the elements whose temperature is free: C diagonal heat capacities,
/// J/K, K a conductance matrix, W/K, θ a time, s.
///
/// Two ways, the cheaper one by counted work: a complete factorisation (LDLᵀ), which pays for small
/// or slender bodies and many solves with one matrix, or conjugate gradients behind an incomplete
/// one.
class ConductanceSolver {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Takes K (N, N) without the rows and columns of imposed elements.
  void set_conductance(const Matrix& conductance, const std::vector<char>& imposed);

  /// Makes ready for C (N) and θ; `lasting`: for very many solves.
  void prepare(const std::vector<double>& capacity, double theta, bool lasting,
               HeatIntegratorStatistics& statistics);

  /// x (N), zero for imposed elements, from b (N). Conjugate gradients end when the residual has
  /// shrunk by `reduction`. False: no solution was found.
  bool solve(const std::vector<double>& b, std::vector<double>& x, double reduction,
             HeatIntegratorStatistics& statistics);

  /// Foreseen work, in products with K, of a solve and of making ready for it, for a largest
  /// θ K_ii / C_i; from counts alone.
  struct Work {
    double prepare, solve;
    bool factorised;
  };
  Work work(double stiffness, bool lasting);

  bool is_factorised() const { return factorised_; }

 private:
  /// LDLᵀ that tells how large it will be before it is made.
  struct Factor : Eigen::SimplicialLDLT<Matrix, Eigen::Lower> {
    double entries() const { return m_nonZerosPerCol.cast<double>().sum(); }
    double operations() const { return m_nonZerosPerCol.cast<double>().squaredNorm(); }
  };

  Matrix conductance_, matrix_;  // of free elements, every diagonal entry present
  std::vector<int> map_;         // free element -> element
  Factor factor_;
  double factor_entries_ = -1, factor_operations_ = 0;
  Eigen::ConjugateGradient<
      Matrix, Eigen::Lower | Eigen::Upper,
      Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>
      iteration_;
  bool factorised_ = false;
  Eigen::VectorXd right_, left_;
};

}  // namespace solidem

#endif
