// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is foretold of a run before it begins.
#include "engine/grip_strain.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/grip_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "engine/run_forecast.hpp"
#include "support/axis_controls.hpp"
#include "support/specimens.hpp"

namespace solidem::grip_strain_test {

/// A bar whose ends are held, and moved so along x and y.
Setup moved_bar(AxisControl along, AxisControl across = held()) {
  Setup setup = elastic_setup();
  setup.all<GripParameters>() = {
      {"left", face(0, false), {held(), held(), held()}, true},
      {"right", face(0, true), {std::move(along), std::move(across), held()}, true}};
  setup.run.steps.reset();
  setup.run.duration = 1e-5;
  return setup;
}

Specimen body() {
  return jittered("simple_cubic", {8, 4, 4});
}

StrainForecast foretold(const Setup& setup) {
  const Simulation simulation(setup, body());
  return foretell_strain(simulation, 1e-5);
}

/// Between the middles of the grips of the bar, m.
double length() {
  const Specimen bar = body();
  double low = 0, high = 0;
  const std::vector<std::int32_t> left = select(face(0, false), bar),
                                  right = select(face(0, true), bar);
  for (const std::int32_t e : left) low += bar.position[static_cast<std::size_t>(e)].x;
  for (const std::int32_t e : right) high += bar.position[static_cast<std::size_t>(e)].x;
  return high / static_cast<double>(right.size()) - low / static_cast<double>(left.size());
}

TEST(GripStrain, is_the_way_of_the_grips_over_their_distance) {
  const StrainForecast pulled = foretold(moved_bar(moving(2)));
  EXPECT_NEAR(pulled.strain.size / (2e-5 / length()), 1, 1e-3);  // the line is not quite along x
  EXPECT_FALSE(pulled.strain.is_pressure);
  EXPECT_TRUE(foretold(moved_bar(moving(-2))).strain.is_pressure);
  const StrainForecast sheared = foretold(moved_bar(held(), moving(2)));
  EXPECT_NEAR(sheared.strain.size / (1e-5 / length()), 1, 1e-3);
}

TEST(GripStrain, of_bonds_is_less_where_none_lies_along_it) {
  const auto alignment = [](const char* lattice, const auto& setup) {
    return foretell_strain(Simulation(setup, crystal(lattice, {8, 4, 4})), 1e-5).alignment;
  };
  const auto pulled = moved_bar(moving(2)), sheared = moved_bar(held(), moving(2));
  EXPECT_NEAR(alignment("simple_cubic", pulled), 1, 1e-12);
  EXPECT_NEAR(alignment("bcc", pulled), 1.0 / 3, 1e-12);   // along the diagonals of cubes
  EXPECT_NEAR(alignment("bcc", sheared), 2.0 / 3, 1e-12);  // of half the shear
}

TEST(GripStrain, counts_the_largest_at_any_time) {
  AxisControl there_and_back{AxisControl::Kind::displacement,
                             {{0, 5e-6, 1e-5}, {0, 3e-6, 0}, 0, 0, 0}};
  const StrainForecast forecast = foretold(moved_bar(there_and_back));
  EXPECT_NEAR(forecast.strain.size / (3e-6 / length()), 1, 1e-3);
  EXPECT_NEAR(forecast.strain.time, 5e-6, 1e-8);
}

TEST(GripStrain, is_none_where_grips_go_together_or_are_free) {
  auto setup = moved_bar(moving(2));
  setup.all<GripParameters>()[0].axis[0] = moving(2);
  EXPECT_EQ(foretold(setup).strain.size, 0);
  setup.all<GripParameters>()[0].axis[0] = {};
  EXPECT_EQ(foretold(setup).strain.size, 0);
  EXPECT_NE(foretold(setup).sayings.at(0).find("no two grips"), std::string::npos);
}

TEST(GripStrain, limits_are_those_of_a_bond_that_is_pulled) {
  auto setup = moved_bar(moving(2));
  PlasticityParameters plasticity;
  plasticity.hardening = LinearHardening{0.002, 0.1};
  setup.get<PlasticityParameters>() = plasticity;
  EXPECT_DOUBLE_EQ(foretold(setup).limits.yield, 0.002);
  EXPECT_FALSE(foretold(setup).limits.rupture < unlimited);
  // On the yield surface the elastic strain is .01 at a plastic one of .08.
  setup.get<RuptureParameters>() = RuptureParameters{StrainLimit{0.01, unlimited}, 0, {}};
  EXPECT_NEAR(foretold(setup).limits.rupture, 0.09, 1e-12);
  setup.get<RuptureParameters>() = RuptureParameters{StrainLimit{unlimited, 0.05}, 0, {}};
  EXPECT_NEAR(foretold(setup).limits.rupture, 0.05, 1e-12);
  setup.get<RuptureParameters>() = RuptureParameters{MohrCoulombRupture{0.001, 0.05, 0}, 0, {}};
  EXPECT_NEAR(foretold(setup).limits.rupture, 0.001, 1e-12);
  setup.all<GripParameters>()[1].axis[0] = moving(-2);
  EXPECT_FALSE(foretold(setup).limits.rupture < unlimited);  // tension alone breaks it
}

TEST(GripStrain, of_central_forces_is_told_from_their_law) {
  auto setup = moved_bar(moving(2));
  setup.get<BeamParameters>().reset();
  CentralForceParameters forces;
  LennardJones law;
  law.energy = 1e-3;
  forces.law = law;
  forces.range = 1.6;
  setup.get<CentralForceParameters>() = forces;
  const PairLimits limits = foretold(setup).limits;
  EXPECT_NEAR(limits.yield, std::pow(13.0 / 7.0, 1.0 / 6.0) - 1, 1e-3);
  EXPECT_DOUBLE_EQ(limits.rupture, 0.6);
}

TEST(GripStrain, says_what_then_happens) {
  // Pulled slowly: the wave that begins it strains less than a bond yields at.
  for (const double factor : {0.2, 1.5}) {
    constexpr double yield = 0.01, duration = 1e-5;
    auto setup = moved_bar(moving(factor * yield * length() / duration));
    PlasticityParameters plasticity;
    plasticity.hardening = LinearHardening{yield, 0.1};
    setup.get<PlasticityParameters>() = plasticity;
    Simulation simulation(setup, body());
    const StrainForecast forecast = foretell_strain(simulation, duration);
    const bool will_flow = forecast.sayings.at(0).find("it will flow") != std::string::npos;
    EXPECT_EQ(will_flow, factor > 1);
    EXPECT_NEAR(forecast.flowing_share, std::max(0.0, 1 - 1 / factor), 2e-3);
    simulation.advance(simulation.steps_to_run());
    EXPECT_EQ(value_of(simulation.observe(), "plastic_work") > 0, will_flow);
  }
}

TEST(RunForecast, counts_what_a_run_does_and_leaves_nothing_behind) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "solidem_forecast_test";
  fs::create_directories(folder);
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", folder.c_str(), 1);
  auto setup = moved_bar(moving(2));
  setup.run.duration.reset();
  setup.run.steps = 1001;
  setup.run.observe_every = 100;
  setup.output.frames = 7;
  setup.output.checkpoint_every = 250;
  PlasticityParameters plasticity;
  plasticity.hardening = LinearHardening{1e-5, 0.1};
  setup.get<PlasticityParameters>() = plasticity;
  Simulation simulation(setup, body());
  const StrainForecast strain = foretell_strain(simulation, 1001 * simulation.time_step().value);
  const RunForecast forecast = foretell_run(simulation, strain);
  if (before == nullptr)
    unsetenv("TMPDIR");
  else
    setenv("TMPDIR", kept.c_str(), 1);
  EXPECT_EQ(forecast.counts.steps, 1001);
  EXPECT_EQ(forecast.counts.rows, 12);  // 0, 100 … 1000 and 1001
  EXPECT_EQ(forecast.counts.frames, 8);
  EXPECT_EQ(forecast.counts.checkpoints, 5);
  EXPECT_GT(forecast.flowing_share, 0.5);
  EXPECT_GT(forecast.flowing_step, 0);
  EXPECT_GT(forecast.costs.step, 0);
  EXPECT_GT(forecast.costs.frame, 0);
  EXPECT_GT(forecast.rows(), 11 * forecast.costs.row);
  EXPECT_DOUBLE_EQ(forecast.total(), forecast.steps() + forecast.rows() + forecast.files());
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(folder);
}

}  // namespace solidem::grip_strain_test
