// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/modes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "laws/constants.hpp"
#include "model/error.hpp"
#include "solve/statics/bonded_body.hpp"
#include "solve/statics/stiffness_solver.hpp"

namespace solidem {

namespace {

using Index = Eigen::Index;

/// Vectors of a Krylov space added together: as many equal frequencies as this can be told apart.
constexpr int block_width = 4;

/// A basis that is orthonormal in the masses, with what stiffness makes of it.
class Basis {
 public:
  Basis(const StiffnessSolver& solver, const Eigen::VectorXd& mass)
      : solver_(solver), mass_(mass) {}

  /// Adds what a vector has outside of the basis; false if that is nothing.
  bool add(Eigen::VectorXd x) {
    const double size = std::sqrt(x.dot(mass_.cwiseProduct(x)));
    if (!(size > 0)) return false;
    x /= size;
    for (int pass = 0; pass < 2; ++pass)
      for (const Eigen::VectorXd& v : vectors_) x -= v.dot(mass_.cwiseProduct(x)) * v;
    const double left = std::sqrt(x.dot(mass_.cwiseProduct(x)));
    if (left < 1e-10) return false;
    x /= left;
    const Eigen::VectorXd image = solver_.product(x);
    const auto n = static_cast<Index>(vectors_.size());
    stiffness_.conservativeResize(n + 1, n + 1);
    for (Index k = 0; k < n; ++k)
      stiffness_(n, k) = stiffness_(k, n) = vectors_[static_cast<std::size_t>(k)].dot(image);
    stiffness_(n, n) = x.dot(image);
    vectors_.push_back(std::move(x));
    return true;
  }

  const std::vector<Eigen::VectorXd>& vectors() const { return vectors_; }
  /// Stiffness between the vectors of the basis, 1/s².
  const Eigen::MatrixXd& stiffness() const { return stiffness_; }

 private:
  const StiffnessSolver& solver_;
  const Eigen::VectorXd& mass_;
  std::vector<Eigen::VectorXd> vectors_;
  Eigen::MatrixXd stiffness_;
};

/// The same vectors every time, different in every entry.
Eigen::VectorXd start_vector(Index size, std::uint64_t seed) {
  Eigen::VectorXd x(size);
  std::uint64_t state = 2 * seed + 1;
  for (Index k = 0; k < size; ++k) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    x[k] = static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  }
  return x;
}

Mode mode_of(const Eigen::VectorXd& shape, double square, double residual, double length) {
  Equilibrium motion;
  set_motion(shape, length, motion);
  double largest = 0;
  for (const Vector& u : motion.displacement) largest = std::max(largest, norm(u));
  const double scale = largest > 0 ? 1 / largest : 1;
  for (Vector& u : motion.displacement) u = scale * u;
  for (Vector& turn : motion.rotation) turn = scale * turn;
  return {std::sqrt(std::max(square, 0.0)) / two_pi, std::move(motion.displacement),
          std::move(motion.rotation), residual};
}

}  // namespace

std::vector<Mode> lowest_modes(const BeamNetwork& network,
                               const std::vector<Constraint>& constraints,
                               const std::vector<double>& mass, const std::vector<double>& inertia,
                               int count, const Equilibrium* about, const ModesOptions& options) {
  const BondedBody body(network);
  const BoundaryConditions conditions = boundary_conditions(body, constraints, {});
  StiffnessSolver solver(*network.specimen, network.bonds, conditions.held, body.length(),
                         options.method);
  const auto bonds = about == nullptr ? body.rest() : body.bonds_at(body.pose_of(*about));
  solver.assemble([&](std::size_t b) { return tangent(bonds[b]); });

  const auto size = static_cast<Index>(6 * body.elements());
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(size);
  for (std::size_t e = 0; e < body.elements(); ++e)
    for (std::size_t degree = 6 * e; degree < 6 * e + 6; ++degree)
      if (solver.is_free(degree))
        masses[static_cast<Index>(degree)] =
            degree < 6 * e + 3 ? mass[e] : inertia[e] / (body.length() * body.length());

  const auto solve = [&](const Eigen::VectorXd& b) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
    if (!solver.solve(b, x, 1e-7).positive)
      throw RunError("no vibrations: the body is not in stable equilibrium");
    return x;
  };
  Basis basis(solver, masses);
  for (int k = 0; k < block_width; ++k)
    basis.add(solve(masses.cwiseProduct(start_vector(size, static_cast<std::uint64_t>(k)))));
  Eigen::VectorXd last;
  std::size_t first = 0;
  for (int round = 0;; ++round) {
    const auto n = static_cast<Index>(basis.vectors().size());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(basis.stiffness());
    const bool exhausted = first == basis.vectors().size();
    if (exhausted && n < count)
      throw InputError("--modes " + std::to_string(count) + ": the body has only " +
                       std::to_string(n) + " vibrations");
    if (n >= count) {
      const Eigen::VectorXd squares = ritz.eigenvalues().head(count);
      const bool settled =
          last.size() == count &&
          ((last - squares).array().abs() <= options.tolerance * squares.array()).all();
      if (settled || exhausted) {
        std::vector<Mode> modes;
        for (int m = 0; m < count; ++m) {
          Eigen::VectorXd shape = Eigen::VectorXd::Zero(size);
          for (Index k = 0; k < n; ++k)
            shape += ritz.eigenvectors()(k, m) * basis.vectors()[static_cast<std::size_t>(k)];
          const Eigen::VectorXd force = solver.product(shape);
          const double residual =
              (force - squares[m] * masses.cwiseProduct(shape)).norm() / force.norm();
          modes.push_back(mode_of(shape, squares[m], residual, body.length()));
        }
        return modes;
      }
      last = squares;
    }
    if (round == 50 + 2 * count)
      throw RunError("no vibrations: the search for " + std::to_string(count) +
                     " modes does not settle");
    const std::size_t end = basis.vectors().size();
    for (std::size_t k = first; k < end; ++k)
      basis.add(solve(masses.cwiseProduct(basis.vectors()[k])));
    first = end;
  }
}

}  // namespace solidem
