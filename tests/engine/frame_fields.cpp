// SPDX-License-Identifier: GPL-2.0-or-later
//
// Patch tests: in a body that is strained and loaded evenly, each element shows the strain and the
// stress of the whole.
#include "engine/frame_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "engine/element_tensors.hpp"
#include "model/error.hpp"
#include "support/specimens.hpp"

namespace solidem::frame_fields_test {

Setup moving(bool beams) {
  Setup setup;
  setup.materials.push_back(material_of(1000, 880, 134));
  setup.run.steps = 1;
  if (beams) {
    BeamParameters parameters;
    parameters.young_modulus = 1e11;
    parameters.shear_modulus = 4e10;
    parameters.radius_ratio = 0.5;
    setup.get<BeamParameters>() = parameters;
    return setup;
  }
  LennardJones law;
  law.energy = 1;
  CentralForceParameters forces;
  forces.law = law;
  forces.range = 1.2;
  forces.equilibrium = CentralForceParameters::Equilibrium::radii;
  setup.get<CentralForceParameters>() = forces;
  return setup;
}

Specimen block(const std::string& lattice = "fcc",
               std::array<bool, 3> periodic = {false, false, false}) {
  Specimen specimen = crystal(lattice, {4, 4, 4}, periodic);
  make_bonds(specimen, 0);
  return specimen;
}

/// Moves all elements by a homogeneous deformation.
void deform(Simulation& simulation, const Eigen::Matrix3d& gradient) {
  Model& model = simulation.model();
  const auto positions = model.positions();
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector& rest = model.specimen().position[i];
    const Eigen::Vector3d now = gradient * Eigen::Vector3d(rest.x, rest.y, rest.z);
    std::copy(now.data(), now.data() + 3, positions[i]);
  }
}

/// Values of a field that a frame would show now.
std::vector<double> shown(const Simulation& simulation, const std::string& name) {
  const std::vector<Pair> pairs = simulation.model().slots().pairs();
  Frame frame(pairs);
  for (const auto& effect : simulation.effects()) effect->show(simulation.model(), frame);
  return FrameFields(simulation, {name}).of_now(frame).at(0).values;
}

const Eigen::Matrix3d stretch_and_shear{{1.002, 0.001, 0}, {0, 0.999, 0.0005}, {0.0003, 0, 1.001}};

TEST(FrameFields, show_a_homogeneous_deformation_of_any_packing_exactly) {
  Eigen::Matrix3d turn;
  turn = Eigen::Matrix3d{{0.8, -0.6, 0}, {0.6, 0.8, 0}, {0, 0, 1}};
  const Eigen::Matrix3d gradient = turn * stretch_and_shear;
  for (const bool beams : {true, false}) {
    Simulation simulation(moving(beams), block());
    deform(simulation, gradient);
    const std::vector<double> found = shown(simulation, "deformation_gradient");
    const std::vector<double> strain = shown(simulation, "strain");
    const Eigen::Matrix3d expected =
        0.5 * (stretch_and_shear.transpose() * stretch_and_shear - Eigen::Matrix3d::Identity());
    for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
      for (std::size_t k = 0; k < 9; ++k)
        ASSERT_NEAR(found[9 * i + k], gradient(int(k / 3), int(k % 3)), 1e-10);
      EXPECT_NEAR(strain[6 * i], expected(0, 0), 1e-10);  // a turn strains nothing
      EXPECT_NEAR(strain[6 * i + 3], expected(0, 1), 1e-10);
      EXPECT_NEAR(strain[6 * i + 2], expected(2, 2), 1e-10);
    }
  }
}

/// dU/dε of a crystal over its volume, from its energy at two strains: the mean of its stress.
double stress_by_energy(bool beams, const Eigen::Matrix3d& gradient, int row, int column) {
  const double small = 1e-6;
  double energy[2];
  for (const int side : {0, 1}) {
    Simulation simulation(moving(beams), block());
    Eigen::Matrix3d further = Eigen::Matrix3d::Zero();
    further(row, column) += 0.5 * (side == 0 ? -small : small);
    further(column, row) += 0.5 * (side == 0 ? -small : small);
    deform(simulation, (Eigen::Matrix3d::Identity() + further) * gradient);
    Observation observation;
    simulation.observe(observation);
    energy[side] = observation.energies.stored();
  }
  const double volume = block().domain.volume;
  return (energy[1] - energy[0]) / (2 * small) / volume;
}

/// How many bonds each element has.
std::vector<int> bond_counts(const Simulation& simulation) {
  std::vector<int> count(simulation.model().elements(), 0);
  for (const Pair& pair : simulation.model().slots().pairs())
    for (const std::int32_t element : {pair.i, pair.j}) ++count[static_cast<std::size_t>(element)];
  return count;
}

TEST(FrameFields, show_the_stress_that_the_energy_of_a_strained_crystal_asks_for) {
  const int rows[] = {0, 1, 2, 0, 1, 0}, columns[] = {0, 1, 2, 1, 2, 2};
  for (const bool beams : {true, false}) {
    Simulation simulation(moving(beams), block());
    deform(simulation, stretch_and_shear);
    const std::vector<double> stress = shown(simulation, "stress");
    const std::vector<int> bonds = bond_counts(simulation);
    for (std::size_t k = 0; k < 6; ++k) {
      double mean = 0, largest = 0;
      std::vector<double> within;  // of elements with all twelve neighbours: the same for all
      for (std::size_t i = 0; i < bonds.size(); ++i) {
        mean += stress[6 * i + k] / static_cast<double>(bonds.size());
        largest = std::max(largest, std::abs(stress[6 * i]));
        if (bonds[i] == 12) within.push_back(stress[6 * i + k]);
      }
      ASSERT_GT(within.size(), 10);
      for (const double value : within) EXPECT_NEAR(value, within[0], 1e-10 * largest);
      const double expected = stress_by_energy(beams, stretch_and_shear, rows[k], columns[k]);
      EXPECT_NEAR(mean, expected, 1e-6 * largest) << beams << k;
    }
  }
}

TEST(FrameFields, show_invariants_of_the_stress) {
  Simulation simulation(moving(true), block());
  deform(simulation, stretch_and_shear);
  const auto stress = shown(simulation, "stress"), mean = shown(simulation, "mean_stress"),
             mises = shown(simulation, "von_mises_stress"),
             principal = shown(simulation, "principal_stresses");
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const double* s = &stress[6 * i];
    const double* p = &principal[3 * i];
    const double scale = std::abs(p[0]) + std::abs(p[2]);
    EXPECT_NEAR(mean[i], (s[0] + s[1] + s[2]) / 3, 1e-12 * scale);
    EXPECT_NEAR(p[0] + p[1] + p[2], 3 * mean[i], 1e-12 * scale);
    EXPECT_GE(p[0], p[1]);
    EXPECT_GE(p[1], p[2]);
    const double of_principal = std::sqrt(
        0.5 * (std::pow(p[0] - p[1], 2) + std::pow(p[1] - p[2], 2) + std::pow(p[2] - p[0], 2)));
    EXPECT_NEAR(mises[i], of_principal, 1e-12 * scale);
  }
}

TEST(FrameFields, of_the_whole_body_are_what_its_gauge_measures) {
  solidem::Setup setup = moving(true);
  setup.gauge = Gauge{0, 2e-4, 8e-4};
  Specimen specimen = crystal("simple_cubic", {10, 4, 4}, {false, false, false});
  make_bonds(specimen, 0);
  Simulation simulation(setup, specimen);
  const double stretch = 1.0001;
  deform(simulation, Eigen::Vector3d(stretch, 1, 1).asDiagonal());
  const std::vector<double> stress = shown(simulation, "stress");
  const double gauge = value_of(simulation.observe(), "gauge.stress");
  // An element within, with a bond on either side; the gauge's chord is that at rest.
  const std::size_t within = 5;
  ASSERT_NEAR(simulation.model().specimen().position[within].x, 11e-4 / 2, 6e-4);
  EXPECT_NEAR(*std::max_element(stress.begin(), stress.end()), gauge * stretch,
              1e-9 * std::abs(gauge));
}

TEST(FrameFields, show_forces_of_bonds_and_turns_of_elements) {
  Simulation simulation(moving(true), block("simple_cubic"));
  deform(simulation, Eigen::Vector3d(1.001, 1, 1).asDiagonal());
  const std::vector<double> force = shown(simulation, "bond_force");
  const std::vector<Pair> pairs = simulation.model().slots().pairs();
  ASSERT_EQ(force.size(), 3 * pairs.size());
  const Specimen& specimen = simulation.model().specimen();
  double pull = 0;
  for (std::size_t b = 0; b < pairs.size(); ++b) {
    const Vector chord = rest_chord(specimen, pairs[b]);
    if (std::abs(chord.x) < 0.5 * norm(chord)) {
      EXPECT_NEAR(force[3 * b], 0, 1e-9);
      continue;
    }
    if (pull == 0) pull = std::abs(force[3 * b]);
    EXPECT_NEAR(force[3 * b] * (chord.x > 0 ? 1 : -1), pull, 1e-9 * pull);  // towards the other
  }
  EXPECT_GT(pull, 0);
  const std::vector<double> orientation = shown(simulation, "orientation");
  EXPECT_EQ(orientation[0], 1);
  EXPECT_EQ(orientation[3], 0);
}

TEST(FrameFields, show_the_gradient_of_a_linear_field_of_temperatures_exactly) {
  solidem::Setup setup = moving(true);
  ConductionParameters conduction;
  conduction.initial_temperature = 300;
  setup.get<ConductionParameters>() = conduction;
  Simulation simulation(setup, block());
  Model& model = simulation.model();
  for (std::size_t i = 0; i < model.elements(); ++i) {
    const Vector& p = model.specimen().position[i];
    model.data(columns::temperature)[i] = 300 + 2e4 * p.x - 1e4 * p.y + 5e3 * p.z;
  }
  const std::vector<double> gradient = shown(simulation, "temperature_gradient");
  for (std::size_t i = 0; i < model.elements(); ++i) {
    ASSERT_NEAR(gradient[3 * i], 2e4, 1e-5);
    ASSERT_NEAR(gradient[3 * i + 1], -1e4, 1e-5);
    ASSERT_NEAR(gradient[3 * i + 2], 5e3, 1e-5);
  }
}

TEST(FrameFields, that_a_body_has_not_are_refused) {
  const Simulation central(moving(false), block());
  EXPECT_THROW(FrameFields(central, {"orientation"}), InputError);
  EXPECT_THROW(FrameFields(central, {"temperature_gradient"}), InputError);
  EXPECT_THROW(FrameFields(central, {"plastic_strain"}), InputError);
  EXPECT_THROW(FrameFields(central, {"bond_force"}), InputError);
  EXPECT_NO_THROW(FrameFields(central, {"stress", "strain", "displacement"}));
}

}  // namespace solidem::frame_fields_test
