// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/displacement_gradient.hpp"

#include "model/least_squares.hpp"

namespace solidem {

std::vector<Vector> gradient_weights(const Specimen& specimen,
                                     const std::vector<std::int32_t>& elements) {
  const auto count = static_cast<Eigen::Index>(elements.size());
  Eigen::MatrixXd place(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector& p =
        specimen.position[static_cast<std::size_t>(elements[static_cast<std::size_t>(k)])];
    place.row(k) = Eigen::RowVector3d(p.x, p.y, p.z);
  }
  const Eigen::RowVector3d mean = place.colwise().mean();
  place.rowwise() -= mean;
  // The minimal solution also where the elements lie in a plane or on a line.
  const Eigen::MatrixXd weights = least_squares(place.transpose() * place, place.transpose());
  std::vector<Vector> found;
  for (Eigen::Index k = 0; k < count; ++k)
    found.push_back({weights(0, k), weights(1, k), weights(2, k)});
  return found;
}

}  // namespace solidem
