// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/element_tensors.hpp"

#include <Eigen/Eigenvalues>

#include "model/columns.hpp"

namespace solidem {

namespace {

Eigen::Vector3d eigen_of(const Vector& v) {
  return {v.x, v.y, v.z};
}

Eigen::Matrix3d eigen_of(const SymmetricTensor<double>& t) {
  return Eigen::Matrix3d{{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}};
}

/// How far an element is from where it was at rest, m.
Vector displacement(const Model& model, std::int32_t element) {
  const auto e = static_cast<std::size_t>(element);
  const double* now = model.positions()[e];
  const Vector& rest = model.specimen().position[e];
  return {now[0] - rest.x, now[1] - rest.y, now[2] - rest.z};
}

/// The chord of a pair where its elements are now, m.
Vector chord_now(const Model& model, const PairLoad& pair) {
  return pair.chord + displacement(model, pair.j) - displacement(model, pair.i);
}

/// One that an element acts on, and the chord to it at rest.
struct Neighbour {
  std::int32_t element;
  Vector chord;
};
using Neighbours = std::vector<std::vector<Neighbour>>;

/// Those of each element.
Neighbours neighbours_of(const Model& model,
                         const std::vector<const ActsBetweenElements*>& actors) {
  Neighbours neighbours(model.elements());
  for (const ActsBetweenElements* actor : actors)
    actor->for_each_pair(model, [&](const PairLoad& pair) {
      neighbours[static_cast<std::size_t>(pair.i)].push_back({pair.j, pair.chord});
      neighbours[static_cast<std::size_t>(pair.j)].push_back({pair.i, -pair.chord});
    });
  return neighbours;
}

ElementTensors zeros(const Model& model) {
  return ElementTensors(model.elements(), Eigen::Matrix3d::Zero());
}

/// The inverse of a sum of squares of chords in the directions that they span, 1/m².
Eigen::Matrix3d inverse_where_spanned(const Eigen::Matrix3d& squares) {
  constexpr double least = 1e-6;  // of the largest: less is round-off
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(squares);
  const double largest = principal.eigenvalues()(2);
  Eigen::Vector3d inverse = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (principal.eigenvalues()(axis) > least * largest)
      inverse(axis) = 1 / principal.eigenvalues()(axis);
  return principal.eigenvectors() * inverse.asDiagonal() * principal.eigenvectors().transpose();
}

}  // namespace

ElementTensors element_stress(const Model& model,
                              const std::vector<const ActsBetweenElements*>& actors,
                              const std::vector<const TouchesElements*>& tools) {
  std::vector<SymmetricTensor<double>> virial(model.elements());
  for (const ActsBetweenElements* actor : actors)
    actor->for_each_pair(model, [&](const PairLoad& pair) {
      const auto of_pair = virial_of_pair(pair.force, chord_now(model, pair));
      virial[static_cast<std::size_t>(pair.i)] += of_pair;
      virial[static_cast<std::size_t>(pair.j)] += of_pair;
    });
  for (const TouchesElements* tool : tools)
    tool->for_each_touched([&](std::int32_t element, const SymmetricTensor<double>& of_tool) {
      virial[static_cast<std::size_t>(element)] += of_tool;
    });
  const std::vector<double> volume = represented_mass(model.specimen(), {1.0});
  ElementTensors stress;
  for (std::size_t i = 0; i < virial.size(); ++i) stress.push_back(eigen_of(virial[i] / volume[i]));
  return stress;
}

ElementTensors deformation_gradient(const Model& model,
                                    const std::vector<const ActsBetweenElements*>& actors) {
  const Neighbours neighbours = neighbours_of(model, actors);
  ElementTensors gradient;
  for (std::int32_t i = 0; static_cast<std::size_t>(i) < model.elements(); ++i) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero(), stretches = squares;
    const auto look_at = [&](std::int32_t j, const Vector& chord) {
      const Eigen::Vector3d rest = eigen_of(chord);
      squares += rest * rest.transpose();
      stretches += eigen_of(displacement(model, j) - displacement(model, i)) * rest.transpose();
    };
    for (const Neighbour& near : neighbours[static_cast<std::size_t>(i)]) {
      look_at(near.element, near.chord);
      for (const Neighbour& next : neighbours[static_cast<std::size_t>(near.element)])
        look_at(next.element, near.chord + next.chord);
    }
    gradient.push_back(Eigen::Matrix3d::Identity() + stretches * inverse_where_spanned(squares));
  }
  return gradient;
}

std::vector<Vector> temperature_gradient(const Model& model) {
  ElementTensors squares = zeros(model);
  std::vector<Eigen::Vector3d> rises(model.elements(), Eigen::Vector3d::Zero());
  const double* temperature = model.data(columns::temperature);
  model.conductors().for_each([&](std::int32_t i, std::int32_t j, std::size_t, int) {
    const Eigen::Vector3d chord = eigen_of(rest_chord(model.specimen(), {i, j}));
    const auto element = static_cast<std::size_t>(i);
    squares[element] += chord * chord.transpose();
    rises[element] += (temperature[j] - temperature[i]) * chord;
  });
  std::vector<Vector> gradient;
  for (std::size_t i = 0; i < rises.size(); ++i) {
    const Eigen::Vector3d found = inverse_where_spanned(squares[i]) * rises[i];
    gradient.push_back({found(0), found(1), found(2)});
  }
  return gradient;
}

}  // namespace solidem
