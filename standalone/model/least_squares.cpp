// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/least_squares.hpp"

#include <Eigen/QR>

namespace solidem {

// A source of its own: what Eigen makes of this takes as long to compile as ten others.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace solidem
