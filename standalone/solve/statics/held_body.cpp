// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/held_body.hpp"

#include <algorithm>
#include <cstdio>
#include <Eigen/Dense>

namespace solidem {

namespace {

using Motion = Eigen::Matrix<double, 6, 1>;  // shift, then turn × length

std::string direction_name(Eigen::Vector3d direction) {
  direction.normalize();
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) > 1 - 1e-6) return std::string(1, "xyz"[axis]);
  char text[64];
  std::snprintf(text, sizeof text, "(%.3g, %.3g, %.3g)", direction.x() + 0.0, direction.y() + 0.0,
                direction.z() + 0.0);
  return text;
}

/// Orthonormal vectors and how many of the first ones a positive semi-definite matrix
/// takes to nothing.
template <int size>
struct NullSpace {
  Eigen::Matrix<double, size, size> vectors;
  int count;
};

template <int size>
NullSpace<size> null_space(const Eigen::Matrix<double, size, size>& gram) {
  using Square = Eigen::Matrix<double, size, size>;
  if (gram.isZero(0)) return {Square::Identity(), size};
  const Eigen::SelfAdjointEigenSolver<Square> solver(gram);  // from the lowest upwards
  const double least = 1e-12 * solver.eigenvalues()[size - 1];
  int count = 0;
  while (solver.eigenvalues()[count] < least) ++count;
  return {solver.eigenvectors(), count};
}

/// A body that repeats itself along another axis cannot turn about this one.
bool can_turn(const Domain& domain, int axis) {
  return !domain.periodic[static_cast<std::size_t>((axis + 1) % 3)] &&
         !domain.periodic[static_cast<std::size_t>((axis + 2) % 3)];
}

}  // namespace

std::string free_rigid_motions(const BeamNetwork& network, const std::vector<char>& held) {
  const Specimen& specimen = *network.specimen;
  const Vector centre = 0.5 * (specimen.domain.lower + specimen.domain.upper);
  const double length = std::max(norm(specimen.domain.upper - specimen.domain.lower), 1e-300);
  // Springs do not feel how their ends are turned.
  const bool turns_count =
      std::any_of(network.rigidity.begin(), network.rigidity.end(),
                  [](const BeamRigidity<double>& r) { return r.bending > 0 || r.torsion > 0; });
  std::vector<char> bonded(specimen.size(), 0);
  for (const Pair& pair : network.bonds)
    bonded[static_cast<std::size_t>(pair.i)] = bonded[static_cast<std::size_t>(pair.j)] = 1;

  // What a rigid motion does to each degree of freedom that is held, and to each that there is:
  // springs in one line are not moved by a turn about it.
  using Square = Eigen::Matrix<double, 6, 6>;
  Square gram = Square::Zero(), moved = Square::Zero();
  for (std::size_t e = 0; e < specimen.size(); ++e) {
    if (bonded[e] == 0) continue;
    for (int degree = 0; degree < (turns_count ? 6 : 3); ++degree) {
      Motion row = Motion::Zero();
      row[degree] = 1;
      if (degree < 3) {
        Vector unit{};
        component(unit, degree) = 1;
        const Vector arm = (1 / length) * cross(specimen.position[e] - centre, unit);
        row.tail<3>() << arm.x, arm.y, arm.z;
      }
      moved += row * row.transpose();
      if (held[6 * e + static_cast<std::size_t>(degree)] != 0) gram += row * row.transpose();
    }
  }
  const double largest = std::max(gram.diagonal().maxCoeff(), 1.0);
  for (int axis = 0; axis < 3; ++axis)
    if (!can_turn(specimen.domain, axis)) gram(3 + axis, 3 + axis) += largest;
  const auto still = null_space<6>(moved);
  for (int k = 0; k < still.count; ++k)
    gram += largest * still.vectors.col(k) * still.vectors.col(k).transpose();

  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  const auto add_all = [&](const std::string& what, const Eigen::Matrix3d& directions, int first,
                           int count) {
    if (count == 3) add(what + "any direction");
    for (int k = first; k < first + count && count < 3; ++k)
      add(what + direction_name(directions.col(k)));
  };
  const auto shifts = null_space<3>(gram.topLeftCorner<3, 3>());
  add_all("it can shift along ", shifts.vectors, 0, shifts.count);
  // What else is free turns the body: the directions that its turns span.
  const auto motions = null_space<6>(gram);
  const Eigen::Matrix<double, 3, 6> turns = motions.vectors.bottomRows<3>();
  Eigen::Matrix3d spanned = Eigen::Matrix3d::Zero();
  for (int k = 0; k < motions.count; ++k) spanned += turns.col(k) * turns.col(k).transpose();
  const int count = motions.count - shifts.count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(spanned);
  add_all("it can turn about ", directions.eigenvectors(), 3 - count, count);
  return text;
}

}  // namespace solidem
