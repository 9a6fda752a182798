// SPDX-License-Identifier: GPL-2.0-or-later
//
// Bodies at rest whose bonds are longer than they were made.
#include <gtest/gtest.h>

#include "solve/bonded_bodies.hpp"

namespace solidem::thermal_strain_test {

constexpr double strain = 1e-3;

TEST(ThermalStrain, of_a_body_that_is_free_makes_it_larger_and_stresses_nothing) {
  const Specimen body = jittered("bcc", {4, 3, 3});
  BeamNetwork network = beam_network(beam_parameters(), body);
  network.thermal_strain.assign(network.bonds.size(), strain);
  std::vector<Constraint> held;
  for (int degree = 0; degree < 6; ++degree) held.push_back({0, degree, 0.0});
  const Equilibrium e = small_equilibrium(network, held, {});
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Vector expected = strain * (body.position[i] - body.position[0]);
    EXPECT_LT(norm(e.displacement[i] - expected), 1e-9 * strain * body.domain.upper.x);
  }
  const double scale = network.rigidity[0].axial * strain;
  for (const Vector& force : e.bond_force) EXPECT_LT(norm(force), 1e-8 * scale);
  EXPECT_LT(std::abs(e.energy), 1e-10 * scale * strain * body.domain.upper.x);
}

TEST(ThermalStrain, of_a_body_that_is_held_stresses_it_as_the_way_back_would) {
  // Warm and held is stress-free, moved back: minus the loads that stretch it by the same, cold.
  const Specimen body = jittered("bcc", {4, 3, 3});
  BeamNetwork network = beam_network(beam_parameters(), body);
  std::vector<Constraint> back, held;
  for (const bool high : {false, true})
    for (const std::int32_t e : select(face(0, high), body))
      for (int degree = 0; degree < 6; ++degree) {
        const double way = degree < 3 ? component(at(body.position, e), degree) : 0.0;
        held.push_back({e, degree, 0.0});
        back.push_back({e, degree, -strain * way});
      }
  const Equilibrium pressed = small_equilibrium(network, back, {});
  network.thermal_strain.assign(network.bonds.size(), strain);
  const Equilibrium warm = small_equilibrium(network, held, {});
  double largest = 0;
  for (const Vector& force : pressed.bond_force) largest = std::max(largest, norm(force));
  for (std::size_t b = 0; b < network.bonds.size(); ++b)
    EXPECT_LT(norm(warm.bond_force[b] - pressed.bond_force[b]), 1e-8 * largest);
  EXPECT_NEAR(warm.energy / pressed.energy, 1, 1e-8);
}

TEST(ElementStress, sums_to_the_mean_stress_of_the_body) {
  const Specimen body = jittered("bcc", {4, 3, 3});
  const BeamNetwork network = beam_network(beam_parameters(), body);
  const Equilibrium e = small_equilibrium(network, stretched(body, 1e-6), {});
  const std::vector<double> volume = represented_mass(body, {1.0});
  const auto stress = element_stress(network, e, volume);
  const Matrix3 mean = mean_stress(network, e);
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    xx += stress[i].xx * volume[i] / body.domain.volume;
    xy += stress[i].xy * volume[i] / body.domain.volume;
  }
  EXPECT_NEAR(xx / mean[0].x, 1, 1e-12);
  EXPECT_NEAR(xy / mean[0].x, 0.5 * (mean[0].y + mean[1].x) / mean[0].x, 1e-12);
}

}  // namespace solidem::thermal_strain_test
