// SPDX-License-Identifier: GPL-2.0-or-later
//
// Every instruction set's kernels of damping against the laws in plain doubles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/beams.hpp"
#include "effects/bond_slot.hpp"
#include "effects/kernels/kernels.hpp"
#include "laws/bond_damping.hpp"
#include "laws/damping.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/lane_vectors.hpp"
#include "support/beams.hpp"

namespace solidem::damping_kernels_test {

/// Numbers without any order between −1 and 1, the same in every run.
double noise(std::size_t k) {
  return std::sin(12.9898 * static_cast<double>(k) + 78.233 * std::cos(static_cast<double>(k)));
}

Vector noisy_vector(std::size_t k) {
  return {noise(3 * k), noise(3 * k + 1), noise(3 * k + 2)};
}

Buffer<double> copy_of(const double* from, std::size_t size) {
  Buffer<double> copy(size);
  std::copy_n(from, size, copy.begin());
  return copy;
}

struct BondVariant {
  BeamLaw law;
  BeamParameters::RadiusFrom radius_from;
  bool periodic;
};

class DampedBondsKernel : public testing::TestWithParam<BondVariant> {};

TEST_P(DampedBondsKernel, takes_momentum_from_none_and_energy_as_the_law_says) {
  auto setup = elastic_setup();
  setup.get<BeamParameters>()->law = GetParam().law;
  if (GetParam().law == BeamLaw::spring) setup.get<BeamParameters>()->shear_modulus = 0;
  setup.get<BeamParameters>()->radius_from = GetParam().radius_from;
  Simulation simulation(setup,
                        GetParam().periodic ? crystal("fcc", {3, 3, 3}, {true, true, true})
                                            : jittered("bcc", {4, 3, 3}),
                        true);
  Model& model = simulation.model();
  const Beams& beams = *simulation.find<Beams>();
  BeamMotion m = beams.motion(model);
  m.kick = 2e-8;
  m.drift = 1e-8;
  const double ratio = 0.3;

  const std::size_t padded = model.slots().padded_elements();
  Buffer<double> rows(8 * padded);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector v = noisy_vector(i), spin = 1e4 * noisy_vector(i + padded);
    const double row[] = {v.x,    v.y,    v.z,    m.inverse_mass[i],
                          spin.x, spin.y, spin.z, m.has_rotation ? m.inverse_inertia[i] : 0};
    std::copy_n(row, 8, rows.begin() + static_cast<std::ptrdiff_t>(8 * i));
  }
  std::vector<Vector> force(padded), moment(padded);
  std::vector<double> power(padded, 0);
  double largest = 0;
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const SlotReader slot{row, lane};
    const double* a = rows.begin() + std::ptrdiff_t{8} * i;
    const double* b = rows.begin() + std::ptrdiff_t{8} * j;
    const auto action = bond_damping(
        bond_dashpots(ratio, rigidity_in<double>(m, slot), slot.number(m.rest_length),
                      BondInertia<double>{a[3] + b[3], m.has_rotation ? a[7] + b[7] : 1}),
        ends_in(m.pose, m, slot, i, j).chord,
        BondMotion<double>{
            {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, {a[4], a[5], a[6]}, {b[4], b[5], b[6]}});
    const auto at = static_cast<std::size_t>(i);
    force[at] += action.load.force;
    moment[at] += action.load.moment_i;
    power[at] += action.power;
    largest = std::max(largest, norm(action.load.force));
  });
  ASSERT_GT(largest, 0);

  const std::size_t vectors = model.size(columns::velocity);
  const Buffer<double> velocity = copy_of(m.velocity, vectors);
  const Buffer<double> next = copy_of(m.next_pose, 8 * padded);
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    std::copy_n(velocity.begin(), vectors, m.velocity);
    std::copy_n(next.begin(), 8 * padded, m.next_pose);
    if (m.has_rotation) std::fill_n(m.angular_velocity, vectors, 0.0);
    Buffer<double> energy(padded);
    kernels->damp_bonds(m, {rows.begin(), ratio, energy.begin()}, 0, model.slots().blocks());
    Vector momentum{};
    double scale = 0, taken = 0, expected = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) {
      const std::size_t at = Model::at(columns::velocity, i);
      const Vector gain = lanes_vector(m.velocity, at) - lanes_vector(velocity.begin(), at);
      EXPECT_LT(norm(gain - m.kick * m.inverse_mass[i] * force[i]),
                1e-13 * m.kick * m.inverse_mass[i] * largest);
      EXPECT_LT(
          norm(row_vector(m.next_pose + 8 * i) - row_vector(next.begin() + 8 * i) - m.drift * gain),
          1e-15 * 1e-3);
      momentum += (1 / m.inverse_mass[i]) * gain;
      scale += norm(gain) / m.inverse_mass[i];
      taken += energy[i];
      expected += 0.5 * m.kick * power[i];
      if (!m.has_rotation) continue;
      const Vector spin = lanes_vector(m.angular_velocity, at);
      EXPECT_LT(norm(spin - m.kick * m.inverse_inertia[i] * moment[i]), 1e-12 * norm(spin));
      const Quaternion<double> turned = turn(pose_orientation(m.pose + 8 * i), spin, m.drift);
      EXPECT_NEAR(m.next_pose[8 * i + 4], turned.w, 1e-15);
      EXPECT_LT(norm(row_vector(m.next_pose + 8 * i + 5) - turned.v), 1e-15);
    }
    EXPECT_LT(norm(momentum), 1e-14 * scale);
    EXPECT_GT(taken, 0);
    EXPECT_NEAR(taken, expected, 1e-13 * expected);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Variants, DampedBondsKernel,
    testing::Values(BondVariant{BeamLaw::euler_bernoulli, BeamParameters::RadiusFrom::mean, false},
                    BondVariant{BeamLaw::timoshenko, BeamParameters::RadiusFrom::mean, true},
                    BondVariant{BeamLaw::euler_bernoulli, BeamParameters::RadiusFrom::pair, false},
                    BondVariant{BeamLaw::spring, BeamParameters::RadiusFrom::mean, false}));

/// Columns of some elements by themselves; the last of them are no elements.
class DampedMotionKernel : public testing::TestWithParam<bool> {};

TEST_P(DampedMotionKernel, slows_what_is_free_and_leaves_alone_what_stands) {
  constexpr std::size_t count = 3 * lanes;
  const std::size_t row_length = 8;
  const bool turns = GetParam();
  Buffer<double> inverse_mass(count), inverse_inertia(count), pose(row_length * count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool stands = i % 7 == 2 || i + 3 > count;
    inverse_mass[i] = stands ? 0 : 1e9 * (1.5 + noise(i));
    inverse_inertia[i] = stands ? 0 : 1e18 * (1.5 + noise(i + count));
    const Quaternion<double> q = turn(Quaternion<double>{}, noisy_vector(i), 1.0);
    const double row[] = {noise(i), noise(2 * i), noise(3 * i), 0, q.w, q.v.x, q.v.y, q.v.z};
    std::copy_n(row, row_length, pose.begin() + static_cast<std::ptrdiff_t>(row_length * i));
  }
  const double alpha = 0.3, left = 0.9, time_step = 1e-3;
  for (const Kernels* kernels : usable_kernels()) {
    SCOPED_TRACE(kernels->instruction_set);
    Buffer<double> now(3 * count), before(3 * count), viscous(count), local(count);
    for (std::size_t i = 0; i < count; ++i) {
      // One that goes on as it did, and one that turns back.
      set_lanes_vector(now.begin(), Model::at(columns::velocity, i),
                       i == 0 ? Vector{} : noisy_vector(i));
      set_lanes_vector(before.begin(), Model::at(columns::velocity, i),
                       i == 0 ? Vector{} : 0.7 * noisy_vector(i == 1 ? 5 : i));
    }
    Buffer<double> next = copy_of(pose.begin(), row_length * count);
    DampedElements d{};
    const DampedMotion motion{now.begin(), before.begin(),
                              (turns ? inverse_inertia : inverse_mass).begin(), viscous.begin(),
                              local.begin()};
    const DampedMotion none{};
    DampedMotion& damped = turns ? d.rotation : d.translation;
    damped = motion;
    Buffer<double> still(3 * count);
    if (turns) {
      d.translation = none;
      d.translation.velocity = still.begin();
      d.translation.inverse_inertia = inverse_mass.begin();
    }
    d.inverse_mass = inverse_mass.begin();
    d.pose = pose.begin();
    d.next_position = next.begin();
    d.row_length = row_length;
    d.velocity_is_felt = false;
    d.time_step = time_step;
    d.left = left;
    d.local = alpha;
    const Buffer<double> given = copy_of(now.begin(), 3 * count);
    const Buffer<double> last = copy_of(before.begin(), 3 * count);
    kernels->damp(d, 0, count / lanes);
    for (std::size_t i = 0; i < count; ++i) {
      SCOPED_TRACE(i);
      const std::size_t at = Model::at(columns::velocity, i);
      const Vector was = lanes_vector(last.begin(), at), free = lanes_vector(given.begin(), at);
      const double* moved = next.begin() + static_cast<std::ptrdiff_t>(row_length * i);
      const double* start = pose.begin() + static_cast<std::ptrdiff_t>(row_length * i);
      if (!(inverse_mass[i] > 0)) {
        EXPECT_EQ(norm(lanes_vector(now.begin(), at) - free), 0);
        EXPECT_TRUE(std::equal(moved, moved + row_length, start));
        EXPECT_EQ(viscous[i], 0);
        EXPECT_EQ(local[i], 0);
        continue;
      }
      Vector slow = free;
      for (int axis = 0; axis < 3; ++axis)
        component(slow, axis) += local_damping(alpha, component(was, axis), component(free, axis));
      const double inertia = 1 / (turns ? inverse_inertia : inverse_mass)[i];
      EXPECT_NEAR(local[i], -0.5 * inertia * dot(slow - free, was + slow), 1e-14 * inertia);
      EXPECT_NEAR(viscous[i],
                  0.5 * inertia * dot(slow, slow) * (1 - left * left) * (1 + left * left),
                  1e-14 * inertia);
      EXPECT_LT(norm(lanes_vector(now.begin(), at) - left * left * slow), 1e-15);
      EXPECT_LT(norm(lanes_vector(before.begin(), at) - left * left * slow), 1e-15);
      if (turns) {
        const Quaternion<double> turned = turn(pose_orientation(start), left * slow, time_step);
        EXPECT_LT(norm(row_vector(moved + 5) - turned.v), 1e-15);
        EXPECT_EQ(norm(row_vector(moved) - row_vector(start)), 0);
      } else {
        EXPECT_LT(norm(row_vector(moved) - row_vector(start) - time_step * (left * slow - free)),
                  1e-15);
        EXPECT_TRUE(std::equal(moved + 4, moved + row_length, start + 4));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(TranslationAndRotation, DampedMotionKernel, testing::Bool());

}  // namespace solidem::damping_kernels_test
