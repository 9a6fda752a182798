// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/pseudo_random.hpp"

namespace solidem {

namespace {

constexpr int iterations = 60;

}  // namespace

double stable_time_step(const Mechanics& mechanics, Model& model) {
  const std::size_t elements = model.elements();
  double* velocity = model.data(columns::velocity);
  const bool has_rotation = model.has(columns::angular_velocity);
  double* spin = has_rotation ? model.data(columns::angular_velocity) : nullptr;
  const auto positions = model.positions();
  const double* inverse_mass = model.data(columns::inverse_mass);
  const double* inverse_inertia = has_rotation ? model.data(columns::inverse_inertia) : nullptr;
  // Springs leave all that turns at zero.
  const std::size_t spins = has_rotation ? model.size(columns::angular_velocity) : 0;
  const std::vector<double> saved_positions(positions[0],
                                            positions[0] + model.size(model.position_column()));
  const std::vector<double> saved_velocity(velocity, velocity + model.size(columns::velocity));
  const std::vector<double> saved_spin(spin, spin + spins);

  const double amplitude = mechanics.trial_displacement() * mean_radius(model.specimen());
  std::vector<double> shape(6 * elements);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const bool turns = k % 6 >= 3;
    if (turns && !has_rotation) continue;
    shape[k] = amplitude * pseudo_random(k) / (turns ? model.specimen().radius[k / 6] : 1.0);
  }

  // Elements may press each other at rest: what counts is how displacements change that.
  std::fill(velocity, velocity + model.size(columns::velocity), 0.0);
  std::fill(spin, spin + spins, 0.0);
  for (std::size_t i = 0; i < elements; ++i) {
    const Vector& rest = model.specimen().position[i];
    std::copy_n(&rest.x, 3, positions[i]);
    if (!has_rotation) continue;
    positions[i][4] = 1;
    std::fill_n(positions[i] + 5, 3, 0.0);
  }
  mechanics.accelerate(model);
  const std::vector<double> at_rest(velocity, velocity + model.size(columns::velocity));

  double squared_frequency = 0;
  for (int n = 0; n < iterations; ++n) {
    for (std::size_t i = 0; i < elements; ++i) {
      const double* u = &shape[6 * i];
      const Vector& rest = model.specimen().position[i];
      double* row = positions[i];
      row[0] = rest.x + u[0];
      row[1] = rest.y + u[1];
      row[2] = rest.z + u[2];
      if (!has_rotation) continue;
      row[4] = std::sqrt(1 - 0.25 * (u[3] * u[3] + u[4] * u[4] + u[5] * u[5]));
      row[5] = 0.5 * u[3];
      row[6] = 0.5 * u[4];
      row[7] = 0.5 * u[5];
    }
    std::fill(velocity, velocity + model.size(columns::velocity), 0.0);
    std::fill(spin, spin + spins, 0.0);
    mechanics.accelerate(model);

    double product = 0, square = 0, largest = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const std::size_t i = k / 6;
      const auto axis = static_cast<int>(k % 3);
      const bool turns = k % 6 >= 3;
      if (turns && !has_rotation) continue;
      const double weight = 1 / (turns ? inverse_inertia[i] : inverse_mass[i]);
      const double length = turns ? model.specimen().radius[i] : 1.0;
      const std::size_t at = Model::at(columns::velocity, i, axis);
      const double acceleration = turns ? spin[at] : velocity[at] - at_rest[at];
      product -= weight * shape[k] * acceleration;
      square += weight * shape[k] * shape[k];
      shape[k] = acceleration;
      largest = std::max(largest, std::fabs(acceleration) * length);
    }
    squared_frequency = product / square;
    if (!(largest > 0)) break;
    for (double& u : shape) u *= amplitude / largest;
  }
  std::copy(saved_positions.begin(), saved_positions.end(), positions[0]);
  std::copy(saved_velocity.begin(), saved_velocity.end(), velocity);
  std::copy(saved_spin.begin(), saved_spin.end(), spin);
  return squared_frequency > 0 ? mechanics.longest_time_step(squared_frequency)
                               : std::numeric_limits<double>::infinity();
}

}  // namespace solidem
