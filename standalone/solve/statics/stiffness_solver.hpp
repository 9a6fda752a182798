// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SOLVE_STATICS_STIFFNESS_SOLVER_HPP
#define SOLIDEM_SOLVE_STATICS_STIFFNESS_SOLVER_HPP

#include <cstdint>
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <functional>
#include <vector>

#include "model/buffer.hpp"
#include "model/specimen.hpp"
#include "solve/statics/bond_tangent.hpp"
#include "solve/statics/linear_method.hpp"

namespace solidem {

/// Solves K x = b for a bonded body, K the sum of its bonds' tangents. There are six unknowns for
/// each element: displacement, then turn times a length, so that all unknowns are lengths and all
/// of b are forces. What is held is not solved for, and directions in which nothing resists an
/// element (turns of springs) stay zero.
///
/// Two ways: a complete factorisation (LDLᵀ), which pays for slender bodies, or conjugate gradients
/// behind the inverses of the diagonal blocks and a coarse body, whose parts move as rigid ones.
class StiffnessSolver {
 public:
  /// `held`: six for each element, non-zero where the degree of freedom is held; elements without a
  /// bond are held in all. `length`: by which turns are multiplied, m.
  StiffnessSolver(const Specimen& specimen, const std::vector<Pair>& bonds, std::vector<char> held,
                  double length, LinearMethod method);

  /// Sets K from the tangent of each bond; `shift` is added on the diagonal, N/m.
  void assemble(const std::function<BondTangent(std::size_t bond)>& tangent_of, double shift = 0);

  struct Result {
    int iterations = 0;     ///< of conjugate gradients; 1 when factorised
    bool positive = true;   ///< K was seen to be positive definite
    bool converged = true;  ///< the residual is as small as asked for
  };
  /// x from b, both six for each element and zero where held. Conjugate gradients start from the x
  /// given and end when the residual is below `tolerance` |b|, or where K turns out not to be
  /// positive definite.
  Result solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance) const;

  /// K x, zero where held.
  Eigen::VectorXd product(const Eigen::VectorXd& x) const;
  /// The largest entry on the diagonal of K, N/m.
  double largest_stiffness() const;

  bool is_factorised() const { return factorised_; }
  /// Whether a degree of freedom (6 element + degree) is solved for.
  bool is_free(std::size_t degree) const { return held_[degree] == 0; }

  /// The largest part of b along directions in which nothing resists an element, and the element.
  struct Unresisted {
    double load = 0;
    std::int32_t element = -1;
  };
  Unresisted unresisted(const Eigen::VectorXd& b) const;

 private:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Segment = Eigen::Matrix<double, 6, 1>;
  using Factor =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>;

  void make_rows();
  void choose(LinearMethod method);
  double foreseen_iterations() const;
  Block& diagonal(std::size_t row) { return block_[diagonal_place(row)]; }
  const Block& diagonal(std::size_t row) const { return block_[diagonal_place(row)]; }
  std::size_t diagonal_place(std::size_t row) const {
    return static_cast<std::size_t>(place_[static_cast<std::size_t>(start_[row])]);
  }
  /// The block of an entry.
  Block entry(std::int32_t k) const {
    const std::int32_t place = place_[static_cast<std::size_t>(k)];
    if (place >= 0) return block_[static_cast<std::size_t>(place)];
    const std::int32_t across = ~place;
    return block_[static_cast<std::size_t>(across)].transpose();
  }
  void hold();
  void make_parts(const Specimen& specimen);
  /// How an element moves with the six rigid motions of its part.
  Block rigid_motion(std::size_t row) const;
  void assemble_parts();
  /// Adds what the parts' rigid motions make of a residual.
  void add_coarse(const std::vector<double>& residual, std::vector<double>& z) const;
  void resist_everything();
  void factorise();
  Result factor_solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  Result iterate(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance) const;
  void multiply(const std::vector<double>& x, std::vector<double>& y) const;
  /// Of the rows of a chunk.
  void multiply_chunk(std::size_t number, const std::vector<double>& x,
                      std::vector<double>& y) const;
  std::vector<double> gather(const Eigen::VectorXd& all) const;
  Eigen::VectorXd scatter(const std::vector<double>& some, Eigen::Index size) const;

  std::vector<Pair> bonds_;
  std::vector<char> held_;
  double length_;

  // K by rows of entries, 6 × 6 blocks, one row for each element that has a free degree of freedom;
  // the diagonal comes first. Of two entries across the diagonal that above it has a block, and the
  // other the complement of its place: its transpose. A bond knows its block, −1 where there is
  // none.
  std::vector<std::int32_t> row_of_, element_of_, start_, column_, place_, block_of_bond_;
  Buffer<Block> block_, inverse_;
  struct Direction {
    std::int32_t row;
    Segment along;
  };
  std::vector<Direction> unresisted_;

  // Neighbouring rows form parts; the arm of each element in its part, over length.
  std::size_t parts_ = 0, rows_of_part_ = 1;
  std::vector<Eigen::Vector3d> arm_;
  std::vector<Segment> free_;  // one where free, zero where held
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarse_;

  bool coarse_is_positive_ = true;

  bool factorised_ = false, positive_ = true;
  std::vector<std::int32_t> order_;  // place in the factor, of each row
  Factor factor_;
};

}  // namespace solidem

#endif
