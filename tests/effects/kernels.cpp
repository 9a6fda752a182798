// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every instruction set's kernels against the laws in plain doubles.
#include "effects/kernels/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/beams.hpp"
#include "laws/rigid_sphere.hpp"
#include "support/specimens.hpp"

namespace solidem {

namespace {

/// Moves and turns every element by a little, the same in every run.
void disturb(Model& model, double size) {
  double* pose = model.data(columns::pose);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const auto k = static_cast<double>(i);
    for (int axis = 0; axis < 3; ++axis)
      pose[8 * i + static_cast<std::size_t>(axis)] += size * 1e-4 * std::sin(3.7 * k + axis);
    const Quaternion<double> q =
        turn(Quaternion<double>{}, {size * std::sin(k), size * std::cos(2 * k), size}, 1.0);
    pose[8 * i + 4] = q.w;
    pose[8 * i + 5] = q.v.x;
    pose[8 * i + 6] = q.v.y;
    pose[8 * i + 7] = q.v.z;
  }
}

struct Variant {
  BeamParameters::RadiusFrom radius_from;
  bool periodic;
};

class BeamKernel : public testing::TestWithParam<Variant> {};

TEST_P(BeamKernel, gives_the_accelerations_of_the_law) {
  const Variant variant = GetParam();
  auto setup = elastic_setup();
  setup.beams->radius_from = variant.radius_from;
  Specimen specimen =
      variant.periodic ? crystal("fcc", {3, 3, 3}, {true, true, true}) : jittered("bcc", {4, 3, 3});
  Simulation simulation(setup, std::move(specimen));
  Model& model = simulation.model();
  disturb(model, 0.05);
  Observation seen;
  simulation.observe(seen);
  double largest = 0, largest_spin = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    largest = std::max(largest, norm(seen.motion.force[i]) * model.data(columns::inverse_mass)[i]);
    largest_spin = std::max(largest_spin,
                            norm(seen.motion.moment[i]) * model.data(columns::inverse_inertia)[i]);
  }
  ASSERT_GT(largest, 0);
  for (const Kernels* kernels : usable_kernels()) {
    double* velocity = model.data(columns::velocity);
    double* spin = model.data(columns::angular_velocity);
    std::fill(velocity, velocity + model.size(columns::velocity), 0.0);
    std::fill(spin, spin + model.size(columns::angular_velocity), 0.0);
    const bool pair = model.has(columns::bond_radius), periodic = model.has(columns::image_shift);
    ASSERT_EQ(pair, variant.radius_from == BeamParameters::RadiusFrom::pair);
    ASSERT_EQ(periodic, variant.periodic);
    const double radius = pair ? 1 : setup.beams->radius_ratio * mean_radius(model.specimen());
    const BeamMotion motion{
        model.slots().first_row(),
        model.slots().neighbours(),
        model.data(columns::pose),
        model.next(columns::pose),
        velocity,
        spin,
        model.data(columns::inverse_mass),
        model.data(columns::inverse_inertia),
        model.data(columns::rest_direction),
        model.data(columns::rest_length),
        pair ? model.data(columns::bond_radius) : nullptr,
        periodic ? model.data(columns::image_shift) : nullptr,
        euler_bernoulli_rigidity<double>({setup.beams->young_modulus, setup.beams->shear_modulus, radius}),
        1.0,
        0.0};
    kernels->move_beams(motion, 0, model.slots().blocks());
    for (std::size_t i = 0; i < model.elements(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const Vector a = model.data(columns::inverse_mass)[i] * seen.motion.force[i];
        const Vector b = model.data(columns::inverse_inertia)[i] * seen.motion.moment[i];
        const std::size_t at = Model::at(columns::velocity, i, axis);
        EXPECT_NEAR(velocity[at],
                    axis == 0   ? a.x
                    : axis == 1 ? a.y
                                : a.z,
                    1e-12 * largest)
            << kernels->instruction_set;
        EXPECT_NEAR(spin[at],
                    axis == 0   ? b.x
                    : axis == 1 ? b.y
                                : b.z,
                    1e-12 * largest_spin)
            << kernels->instruction_set;
        // No drift: every pose is handed on as it is.
        EXPECT_EQ(model.next(columns::pose)[8 * i + static_cast<std::size_t>(axis)],
                  model.data(columns::pose)[8 * i + static_cast<std::size_t>(axis)]);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, BeamKernel,
                         testing::Values(Variant{BeamParameters::RadiusFrom::mean, false},
                                         Variant{BeamParameters::RadiusFrom::pair, false},
                                         Variant{BeamParameters::RadiusFrom::mean, true},
                                         Variant{BeamParameters::RadiusFrom::pair, true}));

TEST(HeatKernel, gives_the_rates_of_the_law) {
  Simulation simulation(thermal_setup(), jittered("bcc", {4, 3, 3}));
  Model& model = simulation.model();
  double* temperature = model.data(columns::temperature);
  for (std::size_t i = 0; i < model.elements(); ++i)
    temperature[i] = 300 + 100 * std::sin(static_cast<double>(i));
  std::vector<double> rate(model.elements(), 0.0);
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    rate[static_cast<std::size_t>(i)] +=
        model.data(columns::conductance)[Model::at_slot(columns::conductance, row, lane)] *
        (temperature[j] - temperature[i]) * model.data(columns::inverse_heat_capacity)[i];
  });
  const double dt = 1e-6;
  for (const Kernels* kernels : usable_kernels()) {
    kernels->conduct({model.slots().first_row(), model.slots().neighbours(), temperature,
                      model.next(columns::temperature), model.data(columns::inverse_heat_capacity),
                      model.data(columns::conductance), dt},
                     0, model.slots().blocks());
    for (std::size_t i = 0; i < model.elements(); ++i)
      EXPECT_NEAR(model.next(columns::temperature)[i], temperature[i] + dt * rate[i], 3e-13)
          << kernels->instruction_set;
  }
}

}  // namespace
}  // namespace solidem
