// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bar that vibrates freely: energy, momentum, order of the integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "laws/constants.hpp"
#include "laws/rigid_sphere.hpp"
#include "support/specimens.hpp"

namespace solidem::energy_test {

/// Starts the longitudinal, a bending and the torsional motion of a bar at once.
std::unique_ptr<Simulation> vibrating_bar(double ratio, double speed,
                                          std::array<int, 3> cells = {8, 2, 2}) {
  auto setup = elastic_setup();
  setup.run.time_step_ratio = ratio;
  auto simulation = std::make_unique<Simulation>(setup, jittered("bcc", cells));
  Model& model = simulation->model();
  double* velocity = model.data(columns::velocity);
  double* spin = model.data(columns::angular_velocity);
  const Vector size = model.specimen().domain.upper;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector p = model.specimen().position[i] - 0.5 * size;
    const double wave = std::sin(pi * p.x / size.x);
    velocity[Model::at(columns::velocity, i, 0)] = speed * wave;
    velocity[Model::at(columns::velocity, i, 1)] =
        speed * (wave * wave - 0.5 * wave * p.z / size.z);
    velocity[Model::at(columns::velocity, i, 2)] = 0.5 * speed * wave * p.y / size.y;
    spin[Model::at(columns::angular_velocity, i, 0)] = 0.5 * speed * wave / size.y;
  }
  return simulation;
}

double energy_of(const Simulation& simulation) {
  const HistoryRow row = simulation.observe();
  return value_of(row, "kinetic_energy") + value_of(row, "elastic_energy");
}

TEST(Energy, error_falls_with_the_square_of_the_time_step) {
  std::vector<double> log_step, log_error;
  for (const int halvings : {0, 1, 2, 3}) {
    const auto owner = vibrating_bar(0.4 / (1 << halvings), 1.0);
    Simulation& simulation = *owner;
    const double start = energy_of(simulation);
    double error = 0;
    for (int n = 0; n < 400; ++n) {
      simulation.advance(1 << halvings);
      error = std::max(error, std::fabs(energy_of(simulation) / start - 1));
    }
    log_step.push_back(std::log(simulation.time_step().value));
    log_error.push_back(std::log(error));
  }
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < log_step.size(); ++k) {
    sx += log_step[k];
    sy += log_error[k];
    sxx += log_step[k] * log_step[k];
    sxy += log_step[k] * log_error[k];
  }
  const auto n = static_cast<double>(log_step.size());
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  RecordProperty("fitted_order", std::to_string(slope));
  std::printf("fitted order %.4f, error at ratio 0.4: %.3g\n", slope, std::exp(log_error[0]));
  EXPECT_NEAR(slope, 2, 0.1);
}

TEST(Energy, does_not_drift_in_a_million_steps) {
  const auto owner = vibrating_bar(0.3, 1.0, {4, 1, 1});
  Simulation& simulation = *owner;
  const double start = energy_of(simulation);
  // Means over tenths of the run, so that the oscillation of second order averages out.
  std::vector<double> mean(10, 0.0);
  double amplitude = 0;
  for (double& tenth : mean) {
    constexpr int looks = 2000;
    for (int n = 0; n < looks; ++n) {
      simulation.advance(50);
      const double error = energy_of(simulation) / start - 1;
      amplitude = std::max(amplitude, std::fabs(error));
      tenth += error / looks;
    }
  }
  ASSERT_EQ(simulation.step(), 1000000);
  double slope = 0;  // of the line through the ten means, for each run of a million steps
  for (int k = 0; k < 10; ++k) slope += (k - 4.5) * mean[static_cast<std::size_t>(k)] / 82.5 * 10;
  std::printf("drift in 1e6 steps %.2e of the energy, oscillation %.2e\n", slope, amplitude);
  EXPECT_LT(std::fabs(slope), 0.01 * amplitude);
}

TEST(Momentum, of_a_free_bar_is_kept) {
  const auto owner = vibrating_bar(0.3, 20.0);
  Simulation& simulation = *owner;
  const auto momenta = [&] {
    Observation seen;
    simulation.observe(seen);
    const Model& model = simulation.model();
    Vector linear{}, angular{};
    double size = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) {
      const double m = 1 / model.data(columns::inverse_mass)[i];
      const double J = 1 / model.data(columns::inverse_inertia)[i];
      const double* pose = model.data(columns::pose) + 8 * i;
      const Vector p{pose[0], pose[1], pose[2]};
      linear += m * seen.motion.velocity[i];
      angular += m * cross(p, seen.motion.velocity[i]) + J * seen.motion.angular_velocity[i];
      size += m * norm(seen.motion.velocity[i]);
    }
    return std::tuple{linear, angular, size};
  };
  const auto [linear, angular, size] = momenta();
  simulation.advance(2000);
  const auto [linear_after, angular_after, size_after] = momenta();
  EXPECT_LT(norm(linear_after - linear), 1e-11 * size);
  EXPECT_LT(norm(angular_after - angular),
            1e-11 * size * simulation.model().specimen().domain.upper.x);
}

TEST(Motion, runs_backwards_to_where_it_started) {
  const auto owner = vibrating_bar(0.3, 5.0);
  Simulation& simulation = *owner;
  Model& model = simulation.model();
  simulation.advance(500);
  // Reversed half a step behind the pose, velocities lead back along the same path.
  double* velocity = model.data(columns::velocity);
  double* spin = model.data(columns::angular_velocity);
  for (std::size_t k = 0; k < model.size(columns::velocity); ++k) {
    velocity[k] = -velocity[k];
    spin[k] = -spin[k];
  }
  // The first step back must undo the last drift without a kick.
  std::vector<double> pose(model.data(columns::pose),
                           model.data(columns::pose) + model.size(columns::pose));
  const double dt = simulation.time_step().value;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    double* row = model.data(columns::pose) + 8 * i;
    const auto at = [&](int axis) { return Model::at(columns::velocity, i, axis); };
    for (int axis = 0; axis < 3; ++axis) row[axis] += dt * velocity[at(axis)];
    const Quaternion<double> q = turn(Quaternion<double>{row[4], {row[5], row[6], row[7]}},
                                      {spin[at(0)], spin[at(1)], spin[at(2)]}, dt);
    row[4] = q.w;
    row[5] = q.v.x;
    row[6] = q.v.y;
    row[7] = q.v.z;
  }
  simulation.advance(499);
  double largest = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const double* row = model.data(columns::pose) + 8 * i;
    largest =
        std::max(largest, norm(Vector{row[0], row[1], row[2]} - model.specimen().position[i]));
  }
  EXPECT_LT(largest, 1e-11 * model.specimen().domain.upper.x);
}

}  // namespace solidem::energy_test
