// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/leap.hpp"

namespace solidem {

namespace {

Vector velocity_of(const Model& model, std::size_t element) {
  const double* velocity = model.data(columns::velocity) + Model::at(columns::velocity, element);
  return {velocity[0], velocity[lanes], velocity[std::size_t{2} * lanes]};
}

}  // namespace

std::optional<Leap> longest_leap(const Model& model, double time_step) {
  const double* inverse_mass = model.data(columns::inverse_mass);
  Vector momentum{};
  double mass = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    if (!(inverse_mass[i] > 0)) continue;
    momentum = momentum + 1 / inverse_mass[i] * velocity_of(model, i);
    mass += 1 / inverse_mass[i];
  }
  if (!(mass > 0)) return {};
  const Vector mean = 1 / mass * momentum;
  std::optional<Leap> longest;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    if (!(inverse_mass[i] > 0)) continue;
    const double radii =
        norm(velocity_of(model, i) - mean) * time_step / model.specimen().radius[i];
    if (radii > (longest ? longest->radii : 1)) longest = Leap{i, radii};
  }
  return longest;
}

}  // namespace solidem
