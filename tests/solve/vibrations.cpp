// SPDX-License-Identifier: GPL-2.0-or-later
//
// Natural frequencies against theory.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "laws/rigid_sphere.hpp"
#include "model/error.hpp"
#include "solve/bonded_bodies.hpp"
#include "solve/statics/modes.hpp"

namespace solidem::vibrations_test {

struct Masses {
  explicit Masses(const Specimen& specimen) : mass(represented_mass(specimen, {2790.0})) {
    for (std::size_t i = 0; i < mass.size(); ++i)
      inertia.push_back(sphere_inertia(mass[i], specimen.radius[i]));
  }
  std::vector<double> mass, inertia;
};

TEST(Vibrations, CantileverSwingsByBeamTheory) {
  const Row row(81);
  const Masses masses(row.specimen);
  const auto modes = lowest_modes(row.network, row.clamped, masses.mass, masses.inertia, 6);
  // The body ends half an element beyond the last centre.
  const double length = row.length + 1e-4, line_density = masses.mass[0] / 2e-4;
  const double unit = std::sqrt(row.bending() / line_density) / (length * length) / (2 * pi);
  const double roots[] = {1.87510406871196, 4.69409113297418, 7.85475743823761};
  for (std::size_t m = 0; m < 6; ++m) {  // each in two directions
    const double exact = roots[m / 2] * roots[m / 2] * unit;
    EXPECT_NEAR(modes[m].frequency / exact, 1, 1e-3) << "mode " << m;
    EXPECT_LT(modes[m].residual, 1e-4);
  }
}

TEST(Vibrations, RowOfSpringsAndMassesIsExact) {
  const int count = 12;
  const Row row(count + 1, beam_parameters(BeamParameters::Law::spring));
  std::vector<Constraint> held = {{row.first, 0, 0.0}};
  for (std::int32_t e = 0; e <= count; ++e)
    for (int axis = 1; axis < 3; ++axis) held.push_back({e, axis, 0.0});
  const Masses masses(row.specimen);
  const auto modes = lowest_modes(row.network, held, masses.mass, masses.inertia, count);
  const double stiffness = row.young * row.area / 2e-4;
  for (int m = 1; m <= count; ++m) {
    const double exact = std::sqrt(stiffness / masses.mass[0]) / pi *
                         std::sin((2 * m - 1) * pi / (2.0 * (2 * count + 1)));
    EXPECT_NEAR(modes[static_cast<std::size_t>(m - 1)].frequency / exact, 1, 1e-8);
  }
  EXPECT_THROW(lowest_modes(row.network, held, masses.mass, masses.inertia, count + 1), InputError);
}

TEST(Vibrations, BothWaysOfSolvingAgree) {
  const Specimen body = jittered("bcc", {8, 3, 3});
  const BeamNetwork network = beam_network(beam_parameters(), body);
  std::vector<Constraint> held;
  for (const std::int32_t e : select(face(0, false), body))
    for (int degree = 0; degree < 6; ++degree) held.push_back({e, degree, 0.0});
  const Masses masses(body);
  ModesOptions options;
  options.method = LinearMethod::factorised;
  const auto a = lowest_modes(network, held, masses.mass, masses.inertia, 5, nullptr, options);
  options.method = LinearMethod::iterated;
  const auto b = lowest_modes(network, held, masses.mass, masses.inertia, 5, nullptr, options);
  for (std::size_t m = 0; m < 5; ++m) {
    EXPECT_NEAR(a[m].frequency / b[m].frequency, 1, 1e-7);
    for (std::size_t k = 0; k < m; ++k) {  // orthogonal in the masses
      double product = 0, square = 0;
      for (std::size_t i = 0; i < body.size(); ++i) {
        product += masses.mass[i] * dot(a[m].displacement[i], a[k].displacement[i]) +
                   masses.inertia[i] * dot(a[m].rotation[i], a[k].rotation[i]);
        square += masses.mass[i] * dot(a[m].displacement[i], a[m].displacement[i]);
      }
      EXPECT_LT(std::abs(product), 1e-6 * square);
    }
  }
}

TEST(Vibrations, ARunSwingsAsTheLowestMode) {
  const Row row(9);
  const Masses masses(row.specimen);
  const Mode mode = lowest_modes(row.network, row.clamped, masses.mass, masses.inertia, 1).front();
  auto setup = elastic_setup();
  GripParameters clamp;
  clamp.name = "clamp";
  clamp.region = face(0, false, 0.6);
  for (AxisControl& axis : clamp.axis)
    axis = {AxisControl::Kind::displacement, TimeFunction::constant(0)};
  setup.all<GripParameters>() = {clamp};
  const double speed = 1e-3, small = 1e-6;
  for (std::size_t i = 0; i < row.specimen.size(); ++i) {
    Region here;
    here.kind = Region::Kind::box;
    here.lower = row.specimen.position[i] - Vector{small, small, small};
    here.upper = row.specimen.position[i] + Vector{small, small, small};
    setup.all<InitialVelocity>().push_back({here, speed * mode.displacement[i]});
  }
  setup.run.time_step_ratio = 0.1;
  Simulation simulation(setup, row.specimen);
  // After whole periods the free end is back where it started.
  const double dt = simulation.time_step().value;
  simulation.advance(std::lround(5 / mode.frequency / dt));
  const double* pose = simulation.model().data(columns::pose) + 8 * row.last;
  const Vector moved = Vector{pose[0], pose[1], pose[2]} - at(row.specimen.position, row.last);
  const double amplitude = speed / (2 * pi * mode.frequency);
  EXPECT_LT(norm(moved), 0.03 * amplitude);  // a thousandth of the frequency
}

}  // namespace solidem::vibrations_test
