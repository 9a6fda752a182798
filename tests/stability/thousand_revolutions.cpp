// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bonded body that turns a thousand times keeps its shape, its energy and its angular momentum:
// an elastic one, and one that has flowed. Rigid motion must neither load a bond nor make it flow.
#include <gtest/gtest.h>

#include <memory>

#include "laws/constants.hpp"
#include "support/beams.hpp"

namespace solidem::thousand_revolutions_test {

constexpr int revolutions = 1000;

/// A small body, skew to all axes of its rotation.
Specimen body() {
  return jittered("bcc", {1, 1, 1});
}

/// Adds the rotation of a rigid body about the centre of mass. rad/s
void spin_up(Simulation& simulation, const Vector& omega) {
  Model& model = simulation.model();
  Vector centre{};
  double mass = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const double m = 1 / model.data(columns::inverse_mass)[i];
    centre += m * centre_of(simulation, i);
    mass += m;
  }
  centre = (1 / mass) * centre;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector v = cross(omega, centre_of(simulation, i) - centre);
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = Model::at(columns::velocity, i, axis);
      model.data(columns::velocity)[at] += component(v, axis);
      model.data(columns::angular_velocity)[at] += component(omega, axis);
    }
  }
}

/// Lengths of all bonds, m.
std::vector<double> lengths(const Simulation& simulation, const std::vector<Pair>& bonds) {
  std::vector<double> found;
  for (const Pair& bond : bonds)
    found.push_back(norm(centre_of(simulation, static_cast<std::size_t>(bond.j)) -
                         centre_of(simulation, static_cast<std::size_t>(bond.i))));
  return found;
}

/// Turns a body and compares means over its first and its last twentieth.
void turns_without_drift(Simulation& simulation, double omega, double of_momentum) {
  const std::vector<Pair> bonds = simulation.model().slots().pairs();
  const Momenta start = momenta_of(simulation);
  const double turn_time = 2 * pi / omega;
  const auto steps =
      static_cast<std::int64_t>(revolutions * turn_time / simulation.time_step().value);
  constexpr int looks = 2000, part = looks / 20;
  std::vector<double> first(bonds.size(), 0.0), last(bonds.size(), 0.0);
  double energy_first = 0, energy_last = 0, oscillation = 0;
  const auto energy = [&] {
    return seen(simulation, "kinetic_energy") + seen(simulation, "elastic_energy");
  };
  const double energy_start = energy();
  for (int n = 0; n < looks; ++n) {
    simulation.advance(steps / looks);
    const double now = energy();
    oscillation = std::max(oscillation, std::fabs(now / energy_start - 1));
    if (n >= part && n < looks - part) continue;
    const std::vector<double> l = lengths(simulation, bonds);
    for (std::size_t k = 0; k < l.size(); ++k) (n < part ? first : last)[k] += l[k] / part;
    (n < part ? energy_first : energy_last) += now / part;
  }
  double change = 0;
  for (std::size_t k = 0; k < first.size(); ++k)
    change = std::max(change, std::fabs(last[k] / first[k] - 1));
  const Momenta end = momenta_of(simulation);
  const double turning = norm(end.angular - start.angular) / norm(start.angular);
  std::printf("  %lld steps: shape %.1e, energy %.1e (oscillation %.1e), angular momentum %.1e\n",
              static_cast<long long>(simulation.step()), change, energy_last / energy_first - 1,
              oscillation, turning);
  EXPECT_LT(change, 1e-6);
  EXPECT_LT(std::fabs(energy_last / energy_first - 1), 1e-6);
  EXPECT_LT(turning, of_momentum);
}

constexpr double omega = 2e5;
const Vector axis_of_rotation = omega * Vector{0.6, 0.64, 0.48};

class ThousandRevolutions : public testing::TestWithParam<BeamLaw> {};

TEST_P(ThousandRevolutions, of_an_elastic_body) {
  auto setup = beam_setup(GetParam());
  setup.run.time_step_ratio = 0.7;
  Simulation simulation(setup, body());
  spin_up(simulation, axis_of_rotation);
  turns_without_drift(simulation, omega, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Laws, ThousandRevolutions,
                         testing::Values(BeamLaw::euler_bernoulli, BeamLaw::timoshenko));

class ThousandRevolutionsAfterFlow : public testing::TestWithParam<FlowLaw> {};

TEST_P(ThousandRevolutionsAfterFlow, of_a_body_out_of_its_first_shape) {
  auto setup = yielding_setup(2e-3, 0.5, GetParam());
  setup.run.time_step_ratio = 0.7;
  Simulation simulation(setup, body());
  // A blow that bends, twists and stretches it for good; hardening brings the flow to an end.
  for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
    const auto k = static_cast<double>(i);
    set_velocity(simulation, i, {60 * std::sin(k), 60 * std::cos(2 * k), 40 * std::sin(3 * k)});
    set_spin(simulation, i, {4e5 * std::cos(k), 3e5 * std::sin(2 * k), 2e5});
  }
  const double energy = seen(simulation, "kinetic_energy");
  simulation.advance(20000);
  const double flowed = seen(simulation, "plastic_work");
  ASSERT_GT(flowed, 0.1 * energy);
  // Brought to rest in its new shape: whatever moves is stopped, again and again.
  for (int n = 0; n < 2000; ++n) {
    for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
      set_velocity(simulation, i, {});
      set_spin(simulation, i, {});
    }
    simulation.advance(20);
  }
  const double still = seen(simulation, "elastic_energy");
  spin_up(simulation, axis_of_rotation);
  ASSERT_LT(still, 1e-3 * seen(simulation, "kinetic_energy"));
  const double settled = seen(simulation, "plastic_work");
  // The two ends of a bond remember its flow apart: equal to round-off, which leaves a tiny couple.
  turns_without_drift(simulation, omega, 1e-6);
  EXPECT_NEAR(seen(simulation, "plastic_work"), settled, 1e-12 * settled);
}

INSTANTIATE_TEST_SUITE_P(Laws, ThousandRevolutionsAfterFlow,
                         testing::Values(FlowLaw::radial_return, FlowLaw::scaled_offset));

}  // namespace solidem::thousand_revolutions_test
