// SPDX-License-Identifier: GPL-2.0-or-later
//
// Thermal expansion and moduli over temperature.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/rupture.hpp"
#include "laws/constants.hpp"
#include "solve/statics/static_equilibrium.hpp"
#include "support/thermomechanics.hpp"

namespace solidem::bond_temperature_test {

constexpr double alpha = 23e-6;

struct Body {
  const char* name;
  Setup setup;
};

void PrintTo(const Body& body, std::ostream* out) {
  *out << body.name;
}

class FreeBody : public testing::TestWithParam<Body> {};

TEST_P(FreeBody, of_one_temperature_expands_alike_in_every_direction_without_stress) {
  auto setup = expanding(GetParam().setup, 400, 300);
  setup.materials[0].expansion_coefficient = TemperatureFunction({300, 500}, {20e-6, 30e-6});
  const double strain = 100 * 22.5e-6;
  setup.run.time_step_ratio = 0.5;
  Simulation simulation(setup, jittered("bcc", {4, 2, 2}));
  const double pressed = seen(simulation, "elastic_energy");
  EXPECT_GT(pressed, 0);
  bring_to_rest(simulation, 2500);
  const std::vector<Vector>& cold = simulation.model().specimen().position;
  const double size = norm(simulation.model().specimen().domain.upper);
  double error = 0;
  for (std::size_t i = 0; i < cold.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double grown = norm(centre_of(simulation, i) - centre_of(simulation, j));
      const double expected = (1 + strain) * norm(cold[i] - cold[j]);
      error = std::max(error, std::fabs(grown - expected) / (strain * size));
    }
  std::printf("  %s: %.1e of the expansion, elastic energy %.1e of that at the start\n",
              GetParam().name, error, seen(simulation, "elastic_energy") / pressed);
  EXPECT_LT(error, 1e-9);
  EXPECT_LT(seen(simulation, "elastic_energy"), 1e-18 * pressed);
}

INSTANTIATE_TEST_SUITE_P(Laws, FreeBody,
                         testing::Values(Body{"elastic", beam_setup()},
                                         Body{"Timoshenko", beam_setup(BeamLaw::timoshenko)},
                                         Body{"that could flow", yielding_setup(0.5, 0.01)}));

/// Forces and moments that temperature makes the bonds of a body at rest exert.
std::vector<ElementLoad> thermal_loads(const Simulation& simulation) {
  Observation seen;
  simulation.observe(seen);
  std::vector<ElementLoad> loads;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    loads.push_back({static_cast<std::int32_t>(i), seen.motion.force[i], seen.motion.moment[i]});
  return loads;
}

TEST(HeldBody, bears_the_stress_of_the_strain_that_it_may_not_have) {
  constexpr double rise = 5, strain = alpha * rise;
  const Specimen specimen = jittered("bcc", {4, 2, 2});
  auto setup = expanding(beam_setup(), 300 + rise, 300);
  setup.all<GripParameters>() = {hold("left", face(0, false)), hold("right", face(0, true))};
  setup.run.time_step_ratio = 0.5;
  Simulation simulation(setup, specimen);
  bring_to_rest(simulation, 1500);

  // The same body, pressed together by as much as it would have grown.
  std::vector<Constraint> constraints;
  for (const bool high : {false, true})
    for (const std::int32_t e : select(face(0, high), specimen)) {
      const Vector& p = specimen.position[static_cast<std::size_t>(e)];
      for (int degree = 0; degree < 6; ++degree)
        constraints.push_back({e, degree, degree < 3 ? -strain * component(p, degree) : 0.0});
    }
  const Equilibrium pressed =
      small_equilibrium(beam_network(*setup.get<BeamParameters>(), specimen), constraints, {});
  double force = 0;
  for (const std::int32_t e : select(face(0, true), specimen))
    force += pressed.reaction[static_cast<std::size_t>(e)].x;
  const double found = seen(simulation, "grip.right.force_x");
  std::printf("  force %.6g N, statics %.6g N\n", found, force);
  EXPECT_LT(force, 0);
  EXPECT_NEAR(found, force, 1e-3 * std::fabs(force));
}

/// Slope of rotation along a free strip of two materials that is warmer than it was made, 1/m.
double curvature(const Specimen& specimen, double middle, double first, double second,
                 double rise) {
  Region upper;
  upper.kind = Region::Kind::box;
  upper.lower = {-1, -1, middle};
  upper.upper = {1, 1, 1};
  Region lower = upper;
  lower.lower.z = -1;
  lower.upper.z = middle;
  auto setup = expanding(beam_setup(), 300 + rise, 300, first);
  setup.materials = {material_of(2790, 880, 134, lower), material_of(2790, 880, 134, upper)};
  setup.materials[0].expansion_coefficient = first;
  setup.materials[1].expansion_coefficient = second;
  const Simulation simulation(setup, specimen);
  std::vector<Constraint> constraints;
  for (int degree = 0; degree < 6; ++degree) constraints.push_back({0, degree, 0.0});
  const Equilibrium bent = small_equilibrium(beam_network(*setup.get<BeamParameters>(), specimen),
                                             constraints, thermal_loads(simulation));
  // The slope of the turns about y against x, over the middle half.
  const double length = specimen.domain.upper.x;
  double n = 0, x = 0, turn = 0, xx = 0, xturn = 0;
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const double at = specimen.position[i].x;
    if (at < 0.25 * length || at > 0.75 * length) continue;
    n += 1;
    x += at;
    turn += bent.rotation[i].y;
    xx += at * at;
    xturn += at * bent.rotation[i].y;
  }
  return (n * xturn - x * turn) / (n * xx - x * x);
}

/// Curvature times height over that of Timoshenko (J. Opt. Soc. Am. 11, 233, 1925), for halves of
/// equal thickness and modulus, of a strip so many cells high.
double over_timoshenko(int cells) {
  const Specimen strip = crystal("bcc", {4 * cells, 1, cells});
  const double height = strip.domain.upper.z;
  const double expected = 1.5 * (23e-6 - 12e-6) * 10 / height;
  return std::fabs(curvature(strip, 0.5 * height, 23e-6, 12e-6, 10)) / expected;
}

TEST(BimetalStrip, bends_as_Timoshenko_says) {
  // Layers of elements at the faces bear less than a continuum: that goes with one over the height.
  const double coarse = over_timoshenko(4), fine = over_timoshenko(8);
  const double without_faces = 2 * fine - coarse;
  std::printf("  4 and 8 cells high: %.4f, %.4f of Timoshenko; without faces %.4f\n", coarse, fine,
              without_faces);
  EXPECT_LT(std::fabs(fine - 1), 0.6 * std::fabs(coarse - 1));
  EXPECT_NEAR(without_faces, 1, 0.03);
}

TEST(BimetalStrip, of_one_material_stays_straight) {
  const Specimen strip = crystal("bcc", {8, 1, 2});
  EXPECT_NEAR(curvature(strip, 0.5 * strip.domain.upper.z, 23e-6, 23e-6, 10), 0, 1e-9);
}

TEST(Bond, whose_ends_differ_by_500_K_is_as_long_as_its_halves) {
  auto setup = expanding(beam_setup(), 300, 300);
  setup.materials[0].conductivity = 1e-12;
  Simulation simulation(setup, row_of(2));
  simulation.model().data(columns::temperature)[1] = 800;
  simulation.advance(1);
  const double length = 2 * hand_radius;
  EXPECT_NEAR(rest_length(simulation, 0, 1), length * (1 + alpha * 250), 1e-14 * length);
  EXPECT_EQ(rest_length(simulation, 0, 1), rest_length(simulation, 1, 0));
}

TEST(HeatingWork, is_what_a_held_row_stores) {
  auto setup = expanding(beam_setup(), 300, 300);
  setup.all<HeatSourceParameters>().push_back(heated_everywhere(1e14));
  setup.all<GripParameters>() = {hold("left", face(0, false)), hold("right", face(0, true))};
  Simulation simulation(setup, row_of(6));
  simulation.advance(300);
  const double rise = temperature_of(simulation, 2) - 300;
  EXPECT_GT(rise, 10);
  const HistoryRow row = simulation.observe();
  const double stored = value_of(row, "elastic_energy");
  EXPECT_GT(stored, 0);
  EXPECT_NEAR(value_of(row, "thermal_work"), stored, 1e-12 * stored);
  EXPECT_LE(std::fabs(value_of(row, "energy_balance")), 1e-12 * stored);
  const double radius = 0.27 * hand_radius;
  const double rigidity = 3.5e12 * pi * radius * radius;
  const double expected = -rigidity * alpha * rise / (1 + alpha * rise);
  EXPECT_NEAR(value_of(row, "grip.right.force_x"), expected, 1e-9 * std::fabs(expected));
}

/// A bar that swings and flows while one half of it is heated so fast that it is shaken.
std::unique_ptr<Simulation> shaken(double ratio, bool flows, std::int64_t every) {
  auto setup = expanding(flows ? yielding_setup(2e-3, 0.05) : beam_setup(), 300, 300);
  setup.get<SofteningParameters>() = SofteningParameters{TemperatureFunction({300, 700}, {1, 0.4})};
  setup.get<ConductionParameters>()->every = every;
  auto source = heated_everywhere(4e14);
  source.region = between(-1, 1e-3);
  setup.all<HeatSourceParameters>().push_back(source);
  setup.run.time_step_ratio = ratio;
  return struck(setup, jittered("bcc", {8, 2, 2}), 20);
}

TEST(HeatingWork, closes_the_balance_of_a_body_in_motion_the_better_the_finer_the_step) {
  for (const bool flows : {false, true}) {
    std::vector<double> errors;
    for (const int finer : {1, 2, 4}) {
      const auto simulation = shaken(0.2 / finer, flows, 1);
      double error = 0, scale = 0, work = 0;
      for (int n = 0; n < 20; ++n) {
        simulation->advance(10 * finer);
        const HistoryRow row = simulation->observe();
        work = value_of(row, "thermal_work");
        scale = std::max(scale, value_of(row, "elastic_energy"));
        error = std::max(error, std::fabs(value_of(row, "energy_balance")));
      }
      EXPECT_GT(std::fabs(work), 0.02 * scale);
      errors.push_back(error / scale);
    }
    std::printf("  balance %.1e, %.1e, %.1e of the elastic energy\n", errors[0], errors[1],
                errors[2]);
    EXPECT_LT(errors[0], 1e-4);
    EXPECT_LT(errors[2], 0.1 * errors[0]);  // second order
  }
}

TEST(HeatingWork, is_the_same_bits_after_a_restart_between_two_steps_of_heat) {
  const auto whole = shaken(0.2, true, 7), first = shaken(0.2, true, 7),
             second = shaken(0.2, true, 7);
  first->advance(100);
  second->restore(first->step(), first->save());
  EXPECT_EQ(second->observe().values, first->observe().values);
  whole->advance(300);
  second->advance(200);
  EXPECT_EQ(second->save(), whole->save());
  EXPECT_EQ(second->observe().values, whole->observe().values);
}

TEST(Softening, makes_all_stiffness_of_a_bond_that_of_its_halves_in_series) {
  auto setup = warm(beam_setup(), 300);
  setup.get<SofteningParameters>() =
      SofteningParameters{TemperatureFunction({300, 800}, {1, 0.25})};
  setup.materials[0].conductivity = 1e-12;
  Simulation simulation(setup, row_of(2));
  const auto rigidity = [&] {
    const Slots::Place place = *simulation.model().slots().find(0, 1);
    std::vector<double> found;
    for (int k = 0; k < 4; ++k)
      found.push_back(simulation.model().data(columns::bond_rigidity)[Model::at_slot(
          columns::bond_rigidity, place.row, place.lane, k)]);
    return found;
  };
  const std::vector<double> hard = rigidity();
  simulation.model().data(columns::temperature)[1] = 800;
  simulation.advance(1);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(rigidity()[k], hard[k] * 2 * 0.25 / 1.25, 1e-12 * hard[k]);
}

TEST(Softening, that_stiffens_bounds_the_time_step_by_the_stiffest_temperature) {
  auto setup = warm(beam_setup(), 300);
  const Simulation plain(setup, jittered("bcc", {4, 2, 2}));
  setup.get<SofteningParameters>() = SofteningParameters{TemperatureFunction({200, 300}, {4, 1})};
  const Simulation stiffening(setup, jittered("bcc", {4, 2, 2}));
  EXPECT_NEAR(stiffening.time_step().limit, 0.5 * plain.time_step().limit,
              1e-6 * plain.time_step().limit);
}

TEST(Expansion, beyond_yield_in_the_first_pose_is_paid_for_by_the_start) {
  auto setup = expanding(yielding_setup(1e-4, 0.1), 400, 300);
  setup.run.time_step_ratio = 0.1;
  Simulation simulation(setup, jittered("bcc", {4, 2, 2}));
  EXPECT_EQ(seen(simulation, "energy_balance"), 0);
  simulation.advance(400);
  const double flowed = seen(simulation, "plastic_work");
  EXPECT_GT(flowed, seen(simulation, "kinetic_energy"));
  EXPECT_LT(std::fabs(seen(simulation, "energy_balance")), 1e-4 * flowed);
}

TEST(Expansion, of_one_material_named_twice_is_that_of_one) {
  auto once = expanding(yielding_setup(2e-3, 0.05), 320, 300);
  once.all<HeatSourceParameters>().push_back(heated_everywhere(1e14));
  auto twice = once;
  twice.materials.push_back(once.materials[0]);
  twice.materials[0].region = between(-1, 1e-3);
  twice.materials[1].region = between(1e-3, 1);
  const Specimen specimen = jittered("bcc", {8, 2, 2});
  const auto a = struck(once, specimen, 20), b = struck(twice, specimen, 20);
  a->advance(200);
  b->advance(200);
  EXPECT_EQ(a->save(), b->save());
}

TEST(Expansion, goes_on_in_the_bonds_that_are_left) {
  auto setup = expanding(beam_setup(), 300, 300);
  setup.get<RuptureParameters>() = breaking_at_strain(0.01);
  setup.get<ConductionParameters>()->every = 5;
  setup.all<HeatSourceParameters>().push_back(heated_everywhere(1e14));
  Simulation simulation(setup, row_of(4));
  set_velocity(simulation, 3, {300, 0, 0});
  simulation.advance(500);
  ASSERT_EQ(simulation.find<Rupture>()->broken().size(), 1u);
  ASSERT_FALSE(simulation.model().slots().find(2, 3));
  const double rise = temperature_of(simulation, 0) - 300;
  EXPECT_GT(rise, 10);
  const double length = 2 * hand_radius;
  EXPECT_NEAR(rest_length(simulation, 0, 1), length * (1 + alpha * rise), 1e-12 * length);
  const HistoryRow row = simulation.observe();
  EXPECT_LE(std::fabs(value_of(row, "energy_balance")), 2e-3 * value_of(row, "kinetic_energy"));
}

}  // namespace solidem::bond_temperature_test
