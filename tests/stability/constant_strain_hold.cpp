// SPDX-License-Identifier: GPL-2.0-or-later
//
// Held at a constant strain after yield, a bond keeps its stress: a million steps of round-off in
// the return to the yield surface must not make it creep.
#include <gtest/gtest.h>

#include "effects/grip_parameters.hpp"
#include "support/beams.hpp"

namespace solidem::constant_strain_hold_test {

struct Case {
  const char* name;
  FlowLaw flow;
  double hardening;
  Vector strain;  ///< displacement of the far end, in shares of the length
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class ConstantStrainHold : public testing::TestWithParam<Case> {};

TEST_P(ConstantStrainHold, keeps_its_stress_for_a_million_steps) {
  const Case& c = GetParam();
  auto setup = yielding_setup(2e-3, c.hardening, c.flow);
  const Specimen body = row_of(2);
  const double length = 2 * hand_radius;
  const double step = Simulation(setup, body).time_step().value;
  constexpr int ramp = 4000, hold_steps = 1000000;
  const auto to = [&](double fraction) {
    return TimeFunction{{0, ramp * step}, {0, fraction * length}};
  };
  setup.all<GripParameters>() = {
      hold("left", face(0, false)),
      hold("right", face(0, true), {to(c.strain.x), to(c.strain.y), to(c.strain.z)})};
  Simulation simulation(setup, body);
  simulation.advance(ramp);
  simulation.advance(10);  // the ramp ends within a step or two
  const auto force = [&] {
    const HistoryRow row = simulation.observe();
    return Vector{value_of(row, "grip.right.force_x"), value_of(row, "grip.right.force_y"),
                  value_of(row, "grip.right.force_z")};
  };
  const Vector start = force();
  const double work = seen(simulation, "plastic_work");
  ASSERT_GT(work, 0);
  simulation.advance(hold_steps);
  const Vector end = force();
  std::printf("  %s: drift of the force %.1e, of the plastic work %.1e\n", c.name,
              norm(end - start) / norm(start), seen(simulation, "plastic_work") / work - 1);
  EXPECT_LT(norm(end - start), 1e-9 * norm(start));
  EXPECT_GE(seen(simulation, "plastic_work"), work);
  EXPECT_LT(seen(simulation, "plastic_work"), work * (1 + 1e-9));
}

const Vector tension{0.02, 0, 0}, mixed{0.02, 0.1, -0.05};
INSTANTIATE_TEST_SUITE_P(
    Laws, ConstantStrainHold,
    testing::Values(Case{"tension", FlowLaw::radial_return, 0, tension},
                    Case{"all modes", FlowLaw::radial_return, 0, mixed},
                    Case{"all modes, hardening", FlowLaw::radial_return, 0.01, mixed},
                    Case{"all modes, scaled offset", FlowLaw::scaled_offset, 0.01, mixed}));

}  // namespace solidem::constant_strain_hold_test
