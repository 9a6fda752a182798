// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/conductance_solver.hpp"

#include <algorithm>
#include <cmath>

namespace solidem {

namespace {

// Measured on random networks of 6 and 14 neighbours with 5000 to 100000 elements, in products with
// K (1.05 ns for each entry and six for each row): an entry of a factor in a solve (4 to 6 ns), an
// operation in making it (1 ns), an iteration behind an incomplete factor.
constexpr double entry_of_factor = 4.5;
constexpr double operation_of_factor = 1;
constexpr double iteration_cost = 3.5;
/// Solves among which a factorisation is shared.
constexpr double solves_of_lasting = 100, solves_of_passing = 3;

}  // namespace

void ConductanceSolver::set_conductance(const Matrix& conductance,
                                        const std::vector<char>& imposed) {
  const auto size = static_cast<std::size_t>(conductance.rows());
  std::vector<int> free(size, -1);
  map_.clear();
  for (std::size_t i = 0; i < size; ++i) {
    if (imposed[i] != 0) continue;
    free[i] = static_cast<int>(map_.size());
    map_.push_back(static_cast<int>(i));
  }
  const auto count = static_cast<Eigen::Index>(map_.size());
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(conductance.nonZeros()) + map_.size());
  for (int column = 0; column < conductance.outerSize(); ++column) {
    const int j = free[static_cast<std::size_t>(column)];
    if (j < 0) continue;
    entries.emplace_back(j, j, 0.0);
    for (Matrix::InnerIterator entry(conductance, column); entry; ++entry) {
      const int i = free[static_cast<std::size_t>(entry.row())];
      if (i >= 0) entries.emplace_back(i, j, entry.value());
    }
  }
  Matrix next(count, count);
  next.setFromTriplets(entries.begin(), entries.end());
  const bool same_pattern = next.rows() == conductance_.rows() &&
                            next.nonZeros() == conductance_.nonZeros() &&
                            std::equal(next.outerIndexPtr(), next.outerIndexPtr() + count + 1,
                                       conductance_.outerIndexPtr()) &&
                            std::equal(next.innerIndexPtr(), next.innerIndexPtr() + next.nonZeros(),
                                       conductance_.innerIndexPtr());
  conductance_.swap(next);
  if (!same_pattern) factor_entries_ = -1;
}

ConductanceSolver::Work ConductanceSolver::work(double stiffness, bool lasting) {
  const auto rows = static_cast<double>(conductance_.rows());
  const double product = static_cast<double>(conductance_.nonZeros()) + 6 * rows;
  // The condition of C + θK is 1 + 2θK/C, as far as the size of the body lets it grow.
  const double iterations = std::min(3 + 1.6 * std::sqrt(stiffness), 3 + 3 * std::cbrt(rows));
  Work work{2, iteration_cost * iterations, false};
  if (rows == 0) return work;
  if (factor_entries_ < 0) {
    factor_.analyzePattern(conductance_);
    factor_entries_ = factor_.entries();
    factor_operations_ = factor_.operations();
  }
  const double prepare = operation_of_factor * factor_operations_ / product;
  const double solve = entry_of_factor * factor_entries_ / product;
  const double shared = prepare / (lasting ? solves_of_lasting : solves_of_passing);
  if (shared + solve < work.solve) work = {prepare, solve, true};
  return work;
}

void ConductanceSolver::prepare(const std::vector<double>& capacity, double theta, bool lasting,
                                HeatIntegratorStatistics& statistics) {
  matrix_ = theta * conductance_;
  double stiffness = 0;
  for (Eigen::Index k = 0; k < matrix_.rows(); ++k) {
    const double c = capacity[static_cast<std::size_t>(map_[static_cast<std::size_t>(k)])];
    double& diagonal = matrix_.coeffRef(k, k);
    stiffness = std::max(stiffness, diagonal / c);
    diagonal += c;
  }
  factorised_ = work(stiffness, lasting).factorised;
  ++statistics.factorisations;
  if (factorised_)
    factor_.factorize(matrix_);
  else
    iteration_.compute(matrix_);
}

bool ConductanceSolver::solve(const std::vector<double>& b, std::vector<double>& x,
                              double reduction, HeatIntegratorStatistics& statistics) {
  ++statistics.solves;
  x.assign(b.size(), 0.0);
  right_.resize(conductance_.rows());
  for (std::size_t k = 0; k < map_.size(); ++k)
    right_[static_cast<Eigen::Index>(k)] = b[static_cast<std::size_t>(map_[k])];
  if (factorised_) {
    if (factor_.info() != Eigen::Success) return false;
    left_ = factor_.solve(right_);
  } else {
    if (iteration_.info() == Eigen::NumericalIssue) return false;
    iteration_.setTolerance(std::max(reduction, 1e-14));
    iteration_.setMaxIterations(1000 + 2 * static_cast<Eigen::Index>(map_.size()));
    left_ = iteration_.solve(right_);
    statistics.iterations += iteration_.iterations();
  }
  for (std::size_t k = 0; k < map_.size(); ++k)
    x[static_cast<std::size_t>(map_[k])] = left_[static_cast<Eigen::Index>(k)];
  return left_.allFinite();
}

}  // namespace solidem
