// SPDX-License-Identifier: GPL-2.0-or-later
//
// A bond that goes from rest to far beyond its limit within one step, in tension, compression,
// shear, bending and torsion: it breaks at the first pose that the law says so, its load there acts
// once, and after that its elements are free.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "laws/beam_plasticity.hpp"
#include "laws/bond_limit.hpp"
#include "support/beams.hpp"

namespace solidem::bond_breaks_in_one_step_test {

struct Mode {
  const char* name;
  Vector velocity{}, spin{};  ///< of the second element against the first, in m and rad per step
};

void PrintTo(const Mode& mode, std::ostream* out) {
  *out << mode.name;
}

class BreaksInOneStep : public testing::TestWithParam<std::tuple<Mode, int>> {};

enum Kind { brittle, brittle_by_stress, radial_return_law, scaled_offset_law };

Setup setup_of(int kind) {
  auto setup = beam_setup();
  if (kind >= radial_return_law)
    setup = yielding_setup(
        2e-3, 0.01, kind == radial_return_law ? FlowLaw::radial_return : FlowLaw::scaled_offset);
  setup.get<RuptureParameters>() =
      kind == brittle_by_stress ? breaking_at_elastic_strain(0.01) : breaking_at_strain(0.01);
  setup.run.time_step_ratio = 0.3;
  return setup;
}

/// Two elements, the second of which will have moved by so much after one step.
std::unique_ptr<Simulation> struck(const Setup& setup, const Mode& mode, double size) {
  auto simulation = std::make_unique<Simulation>(setup, row_of(2));
  const double rate = 0.5 * size / simulation->time_step().value;
  set_velocity(*simulation, 0, -rate * mode.velocity);
  set_velocity(*simulation, 1, rate * mode.velocity);
  set_spin(*simulation, 0, -rate * mode.spin);
  set_spin(*simulation, 1, rate * mode.spin);
  return simulation;
}

TEST_P(BreaksInOneStep, and_its_elements_fly_on) {
  const auto& mode = std::get<0>(GetParam());  // a lambda may not hold a binding's name
  const auto& kind = std::get<1>(GetParam());
  const auto simulation = struck(setup_of(kind), mode, 1);
  simulation->advance(1);
  // The bond is whole at the start and is looked at again at the next pose.
  EXPECT_EQ(seen(*simulation, "broken_bonds"), 0);
  simulation->advance(1);
  EXPECT_EQ(seen(*simulation, "broken_bonds"), 1);
  const auto velocity = simulation->save().at("column.velocity");
  const auto spin = simulation->save().at("column.angular_velocity");
  for (const double v : velocity) EXPECT_TRUE(std::isfinite(v));
  simulation->advance(100);
  EXPECT_EQ(simulation->save().at("column.velocity"), velocity);
  EXPECT_EQ(simulation->save().at("column.angular_velocity"), spin);
  EXPECT_EQ(seen(*simulation, "broken_bonds"), 1);
  EXPECT_EQ(seen(*simulation, "elastic_energy"), 0);
  EXPECT_GT(seen(*simulation, "fracture_energy"), 0);
  EXPECT_EQ(simulation->model().slots().pairs().size(), 0u);
}

TEST_P(BreaksInOneStep, only_beyond_its_limit) {
  // Half of the limit holds, twice the limit breaks: by the law's own strain of the pose.
  const auto& mode = std::get<0>(GetParam());  // a lambda may not hold a binding's name
  const auto& kind = std::get<1>(GetParam());
  const auto setup = setup_of(kind);
  const auto strain_of = [&](double size) {
    const auto simulation = struck(beam_setup(), mode, size);
    simulation->advance(1);
    const double* pose = simulation->model().data(columns::pose);
    const auto orientation = [&](int i) {
      const double* row = pose + std::ptrdiff_t{8} * i;
      return Quaternion<double>{row[4], {row[5], row[6], row[7]}};
    };
    const Vector chord = centre_of(*simulation, 1) - centre_of(*simulation, 0);
    const BeamPose<double> p = beam_pose<double>(chord, {1, 0, 0}, orientation(0), orientation(1));
    return equivalent_strain(0.27 * hand_radius, 1.35 / 3.5, p,
                             beam_deformation(2 * hand_radius, p));
  };
  const double whole = strain_of(1e-3) / 1e-3;  // of a motion of size 1, were it small
  for (const double fraction : {0.5, 2.0}) {
    const double size = fraction * 0.01 / whole;
    const auto simulation = struck(setup, mode, size);
    simulation->advance(2);
    EXPECT_EQ(seen(*simulation, "broken_bonds"), fraction > 1 ? 1 : 0)
        << fraction << " of the limit: strain " << strain_of(size);
  }
}

// A motion within one step: tenths of the length, or of a radian.
constexpr double l = 2 * hand_radius;
INSTANTIATE_TEST_SUITE_P(
    Modes, BreaksInOneStep,
    testing::Combine(
        testing::Values(Mode{"tension", {0.2 * l, 0, 0}}, Mode{"compression", {-0.2 * l, 0, 0}},
                        Mode{"bending", {}, {0, 0.6, 0}}, Mode{"torsion", {}, {0.6, 0, 0}},
                        Mode{"all at once", {0.1 * l, 0.1 * l, 0}, {0.3, 0.3, 0.2}}),
        testing::Values(brittle, brittle_by_stress, radial_return_law, scaled_offset_law)));

TEST(BreaksInOneStep, in_shear) {
  // Shear alone does not stress the middle of a beam: by the law it is the bending at mid-length
  // and the tension of a longer chord that count. Half a length aside, the chord is 12 % longer.
  for (const int kind : {brittle, brittle_by_stress, radial_return_law, scaled_offset_law}) {
    const auto simulation = struck(setup_of(kind), {"shear", {0, 0.5 * l, 0}}, 1);
    simulation->advance(2);
    EXPECT_EQ(seen(*simulation, "broken_bonds"), 1) << kind;
    const auto velocity = simulation->save().at("column.velocity");
    simulation->advance(100);
    EXPECT_EQ(simulation->save().at("column.velocity"), velocity);
  }
}

TEST(BreaksInOneStep, with_momentum_kept_and_energy_counted) {
  // However far beyond its limit a bond is found, its load acts on both ends alike, and the energy
  // it held is told.
  for (const int kind : {brittle, radial_return_law, scaled_offset_law}) {
    auto setup = setup_of(kind);
    setup.run.time_step_ratio = 1e-3;  // so small that the work of the last step is small as well
    const Mode mode{"all", {2e-4 * l, 1e-4 * l, 5e-5 * l}, {3e-4, 2e-4, -1e-4}};
    const auto simulation = struck(setup, mode, 1);
    const Momenta start = momenta_of(*simulation);
    const double energy = seen(*simulation, "kinetic_energy");
    simulation->advance(2000);
    ASSERT_EQ(seen(*simulation, "broken_bonds"), 1);
    const Momenta end = momenta_of(*simulation);
    std::printf("  kind %d: balance %.1e, fracture energy %.1e of the energy\n", kind,
                seen(*simulation, "energy_balance") / energy,
                seen(*simulation, "fracture_energy") / energy);
    EXPECT_LT(norm(end.linear - start.linear), 1e-12 * start.linear_scale);
    EXPECT_LT(norm(end.angular - start.angular), 1e-12 * start.angular_scale);
    EXPECT_LT(std::fabs(seen(*simulation, "energy_balance")), 1e-3 * energy);
  }
}

}  // namespace solidem::bond_breaks_in_one_step_test
