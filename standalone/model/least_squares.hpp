// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_LEAST_SQUARES_HPP
#define SOLIDEM_MODEL_LEAST_SQUARES_HPP

#include <Eigen/Core>

namespace solidem {

/// The X with the least |A X − B|, and the smallest of them where A leaves some free (minimum-norm
/// least squares). A (M, N), B (M, K), X (N, K).
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace solidem

#endif
