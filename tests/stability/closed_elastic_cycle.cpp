// SPDX-License-Identifier: GPL-2.0-or-later
//
// Round a closed path an elastic bond gives back all the work it took, through any mode and however
// far it turns; and which of its elements comes first plays no part.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "laws/beam_plasticity.hpp"
#include "laws/constants.hpp"
#include "laws/rigid_sphere.hpp"
#include "support/beams.hpp"

namespace solidem::closed_elastic_cycle_test {

using Turn = Quaternion<double>;

/// An orientation and its angular velocity.
struct Turning {
  Turn orientation;
  Vector rate;
};

/// First about one axis by `angle`, then about another by `second`, with their rates.
Turning turned(const Vector& axis, double angle, double rate, const Vector& second_axis,
               double second, double second_rate) {
  const auto about = [](const Vector& a, double by) {
    return Turn{std::cos(0.5 * by), std::sin(0.5 * by) * a};
  };
  const Turn first = about(axis, angle), then = about(second_axis, second);
  return {then * first, second_rate * second_axis + rotate(then, rate * axis)};
}

class ClosedCycle : public testing::TestWithParam<const char*> {
 protected:
  static constexpr double E = 3.5e12, G = 1.35e12, radius = 3e-5, length = 2e-4;
  static BeamRigidity<double> rigidity(const std::string& law) {
    const BeamSection<double> section{E, G, radius};
    if (law == "timoshenko") return timoshenko_rigidity(section, length, 0.9);
    return law == "spring" ? spring_rigidity(section) : euler_bernoulli_rigidity(section);
  }
};

TEST_P(ClosedCycle, of_one_bond_takes_no_work) {
  const BeamRigidity<double> beam = rigidity(GetParam());
  const Vector direction{0.6, 0.64, 0.48};
  // The trapezoidal rule converges faster than any power on smooth closed paths.
  constexpr int points = 400;
  double work = 0, size = 0, peak = 0;
  for (int n = 0; n < points; ++n) {
    const double s = 2 * pi * n / points, c = std::cos(s), d = std::sin(s);
    const Vector chord =
        length * direction + (0.1 * length) * Vector{d, 0.7 * c, 0.5 * std::sin(2 * s)};
    const Vector rate = (0.1 * length) * Vector{c, -0.7 * d, std::cos(2 * s)};
    const Turning i = turned({0, 0.6, 0.8}, 0.4 * d, 0.4 * c, {1, 0, 0}, 0.3 * c, -0.3 * d);
    const Turning j = turned({0.8, 0, 0.6}, 0.5 * c, -0.5 * d, {0, 1, 0}, 0.3 * std::sin(2 * s),
                             0.6 * std::cos(2 * s));
    const BeamPose<double> pose = beam_pose(chord, direction, i.orientation, j.orientation);
    const BeamLoad<double> load = beam_load(beam, length, pose);
    // The force on j is −F_i, and the chord's rate is that of j against i.
    const double power =
        -dot(load.force, rate) + dot(load.moment_i, i.rate) + dot(load.moment_j, j.rate);
    work += power;
    size += std::fabs(power);
    peak = std::max(peak, beam_energy(beam, length, pose));
  }
  work *= 2 * pi / points;
  size *= 2 * pi / points;
  std::printf("  %s: %.1e of the peak energy\n", GetParam(), work / peak);
  EXPECT_GT(size, peak);  // the path goes up and down again
  EXPECT_LT(std::fabs(work), 1e-10 * peak);
}

INSTANTIATE_TEST_SUITE_P(Laws, ClosedCycle,
                         testing::Values("euler-bernoulli", "timoshenko", "spring"));

/// Work and peak energy of three elements led round a closed path by grips.
std::pair<double, double> led_round(BeamLaw law, double time_step, const Specimen& body) {
  auto setup = beam_setup(law);
  setup.run.time_step = time_step;
  constexpr int steps = 2000;
  const double frequency = 1 / (steps * time_step), a = 4e-6;
  const auto wave = [&](double amplitude, double phase) {
    return TimeFunction{{0.0}, {0.0}, amplitude, frequency, phase};
  };
  // Each element is held at every instant, so all work is that of the bonds.
  const TimeFunction still = TimeFunction::constant(0);
  const auto of = [](std::int32_t e) {
    Region region;
    region.kind = Region::Kind::set;
    region.set = "element" + std::to_string(e);
    return region;
  };
  setup.all<GripParameters>() = {
      hold("first", of(0)), hold("second", of(1), {wave(a, 0.3), wave(0.8 * a, 1.4), wave(a, 2.6)}),
      hold("third", of(2), {wave(1.2 * a, 2.0), still, wave(0.7 * a, 0.9)})};
  Simulation simulation(setup, body);
  // From one passage of a point of the path to the next.
  simulation.advance(steps / 4);
  const double start = seen(simulation, "external_work");
  double peak = 0;
  for (int n = 0; n < 100; ++n) {
    simulation.advance(steps / 100);
    peak = std::max(peak, seen(simulation, "elastic_energy"));
  }
  return {seen(simulation, "external_work") - start, peak};
}

Specimen triangle(const std::array<std::int32_t, 3>& order) {
  const std::array<Vector, 3> places{Vector{0, 0, 0}, Vector{2e-4, 0, 0},
                                     Vector{1e-4, 1.7e-4, 2e-5}};
  Specimen body = string_of({places[0], places[1], places[2]});
  for (std::size_t k = 0; k < 3; ++k) {
    body.position[static_cast<std::size_t>(order[k])] = places[k];
    body.sets["element" + std::to_string(k)] = {order[k]};
  }
  body.bonds = {{0, 1}, {0, 2}, {1, 2}};
  return body;
}

TEST(ClosedCycle, of_a_body_led_by_grips_takes_no_work_in_any_order) {
  for (const BeamLaw law : {BeamLaw::euler_bernoulli, BeamLaw::timoshenko, BeamLaw::spring}) {
    std::vector<double> works;
    for (const std::array<std::int32_t, 3> order :
         {std::array{0, 1, 2}, std::array{2, 1, 0}, std::array{1, 2, 0}}) {
      const auto [work, peak] = led_round(law, 1e-10, triangle(order));
      EXPECT_LT(std::fabs(work), 1e-10 * peak) << name_of(law);
      works.push_back(work / peak);
    }
    std::printf("  %s: %.1e, %.1e, %.1e of the peak energy\n", name_of(law), works[0], works[1],
                works[2]);
  }
}

}  // namespace solidem::closed_elastic_cycle_test
