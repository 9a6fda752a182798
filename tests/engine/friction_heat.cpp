// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat of friction between elements, and between elements and tools: how much, and whose.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "effects/conduction_parameters.hpp"
#include "effects/friction_heat.hpp"
#include "scene/scene_text.hpp"
#include "support/thermomechanics.hpp"

namespace solidem::test::friction_heat_test {

/// A scene whose specimen is made by hand: elements of metal with beams between them, warm.
solidem::Setup scene_with(const std::string& sections, const std::string& material = "") {
  return read_text_scene(
             "[specimen]\nshape = \"crystal\"\nlattice = \"simple_cubic\"\ncells = [1, 1, 1]\n"
             "element_radius = \"0.1 mm\"\n" +
             (material.empty()
                  ? "[material]\ndensity = \"2790 kg/m^3\"\nspecific_heat_capacity = \"880 J/(kg "
                    "K)\"\nconductivity = \"134 W/(m K)\"\n"
                  : material) +
             "[beams]\nyoung_modulus = \"70 GPa\"\nradius_ratio = 0.5\npoisson_ratio = 0.3\n"
             "[conduction]\ninitial_temperature = \"300 K\"\n" +
             sections + "[run]\nsteps = 1\ntime_step_ratio = 0.02\n")
      .setup;
}

/// Two elements without a bond, nearly in touch along x.
Specimen two_that_meet() {
  Specimen specimen = string_of({{0, 0, 0}, {2.0001 * hand_radius, 0, 0}});
  specimen.bonds.clear();
  return specimen;
}

const std::string rubbing =
    "[contact]\nnormal_stiffness = \"1 GN/m\"\nfriction = 0.2\n[friction_heat]\n";

/// Lets the second graze the first.
void graze(Simulation& simulation) {
  set_velocity(simulation, 1, {-1, 3, 0});
  bool met = false;
  for (int n = 0; n < 100000; ++n) {
    simulation.advance(1);
    const bool touch = seen(simulation, "contacts") > 0;
    if (met && !touch) return;
    met = met || touch;
  }
  FAIL() << "they did not meet, or never parted";
}

/// Heat that an element took up, J.
double heat_of(const Simulation& simulation, std::size_t element, double initial = 300) {
  return (temperature_of(simulation, element) - initial) /
         simulation.model().data(columns::inverse_heat_capacity)[element];
}

TEST(FrictionHeat, of_two_that_graze_is_the_exact_work_of_the_slip_and_halved) {
  Simulation simulation(scene_with(rubbing), two_that_meet());
  graze(simulation);
  // All the while they slip, so the impulse along the surface is μ times 2 m* v; both turn as well.
  const double per_mass = simulation.model().data(columns::inverse_mass)[0] +
                          simulation.model().data(columns::inverse_mass)[1];
  const double impulse = 0.2 * 2 / per_mass;
  const double work = impulse * (3 - 0.5 * 3.5 * per_mass * impulse);
  const HistoryRow row = simulation.observe();
  EXPECT_NEAR(value_of(row, "friction"), work, 2e-3 * work);
  EXPECT_NEAR(value_of(row, "friction_heat"), value_of(row, "friction"), 1e-15 * work);
  EXPECT_NEAR(value_of(row, "thermal_energy") + value_of(row, "waiting_heat"),
              value_of(row, "friction"), 1e-13 * work);
  EXPECT_NEAR(heat_of(simulation, 0), heat_of(simulation, 1), 1e-9 * work);
  EXPECT_NEAR(heat_of(simulation, 0), 0.5 * value_of(row, "friction"), 1e-9 * work);
}

TEST(FrictionHeat, goes_where_heat_is_taken_up_and_led_away_best) {
  const std::string materials =
      "[[material]]\nname = \"steel\"\ndensity = \"7800 kg/m^3\"\n"
      "specific_heat_capacity = \"490 J/(kg K)\"\nconductivity = \"50 W/(m K)\"\n"
      "region = { upper = [\"0.1 mm\", \"any\", \"any\"] }\n"
      "[[material]]\nname = \"wood\"\ndensity = \"500 kg/m^3\"\n"
      "specific_heat_capacity = \"1600 J/(kg K)\"\n"
      "conductivity = { temperature = [\"200 K\", \"400 K\"], "
      "value = [\"0.1 W/(m K)\", \"0.3 W/(m K)\"] }\n"
      "region = { lower = [\"0.1 mm\", \"any\", \"any\"] }\n";
  Simulation simulation(scene_with(rubbing, materials), two_that_meet());
  graze(simulation);
  const double steel = std::sqrt(7800.0 * 490 * 50), wood = std::sqrt(500.0 * 1600 * 0.2);
  EXPECT_NEAR(heat_of(simulation, 0) / heat_of(simulation, 1), steel / wood, 1e-6 * steel / wood);
  const double friction = seen(simulation, "friction");
  EXPECT_NEAR(heat_of(simulation, 0) + heat_of(simulation, 1) + seen(simulation, "waiting_heat"),
              friction, 1e-9 * friction);
}

TEST(FrictionHeat, is_the_fraction_of_what_slip_takes_and_that_of_what_dashpots_take) {
  const std::string lossy =
      "[contact]\nnormal_stiffness = \"1 GN/m\"\nfriction = 0.2\n"
      "restitution = 0.3\n[friction_heat]\n";
  for (const double damping : {0.0, 0.25, 1.0}) {
    Simulation simulation(
        scene_with(lossy + "fraction = 0.5\ndamping_fraction = " + std::to_string(damping) + "\n"),
        two_that_meet());
    graze(simulation);
    const HistoryRow row = simulation.observe();
    const double heat =
        0.5 * value_of(row, "friction") + damping * value_of(row, "contact_damping");
    EXPECT_GT(value_of(row, "contact_damping"), 0);
    EXPECT_NEAR(value_of(row, "friction_heat"), heat, 1e-15 * heat);
    EXPECT_NEAR(value_of(row, "thermal_energy") + value_of(row, "waiting_heat"), heat,
                1e-13 * heat);
  }
}

const std::string slippery_floor =
    "[[tools]]\nname = \"floor\"\nshape = \"plane\"\nstiffness = \"100 kN/m\"\n"
    "friction = 0.5\nrestitution = 0.1\n";
const std::string weight = "[gravity]\nacceleration = [\"0 m/s^2\", \"0 m/s^2\", \"-1e3 m/s^2\"]\n";

/// A ball that slides on a floor until it rolls, in which slip takes m v²/7.
std::unique_ptr<Simulation> rolling(const std::string& floor) {
  auto setup = scene_with(floor + weight + "[friction_heat]\n");
  setup.run.time_step_ratio = 0.1;
  auto simulation = std::make_unique<Simulation>(setup, string_of({{0, 0, hand_radius}}));
  set_velocity(*simulation, 0, {1, 0, 0});
  while (simulation->time() < 2 * 2 / (7 * 0.5 * 1e3)) simulation->advance(100);
  return simulation;
}

TEST(FrictionHeat, of_a_ball_that_comes_to_roll_on_a_tool_that_takes_none_is_a_seventh_of_m_v2) {
  const auto simulation = rolling(slippery_floor);
  const double m = 1 / simulation->model().data(columns::inverse_mass)[0];
  EXPECT_NEAR(heat_of(*simulation, 0), m / 7, 2e-3 * m);
  EXPECT_EQ(seen(*simulation, "tool.floor.heat"), 0);
  EXPECT_NEAR(seen(*simulation, "thermal_energy") + seen(*simulation, "waiting_heat"),
              seen(*simulation, "friction"), 1e-12 * m);
}

TEST(FrictionHeat, is_shared_with_a_tool_of_a_material_and_leaves_the_body_there) {
  const auto simulation = rolling(slippery_floor +
                                  "conductivity = \"50 W/(m K)\"\ndensity = \"7800 kg/m^3\"\n"
                                  "specific_heat_capacity = \"490 J/(kg K)\"\n");
  const HistoryRow row = simulation->observe();
  const double friction = value_of(row, "friction"), to_tool = value_of(row, "tool.floor.heat");
  const double steel = std::sqrt(7800.0 * 490 * 50), aluminium = std::sqrt(2790.0 * 880 * 134);
  EXPECT_NEAR(to_tool, steel / (steel + aluminium) * friction, 1e-12 * friction);
  EXPECT_NEAR(value_of(row, "thermal_energy") + value_of(row, "waiting_heat") + to_tool, friction,
              1e-12 * friction);
  EXPECT_LE(std::fabs(value_of(row, "heat_balance")), 1e-12 * friction);
  EXPECT_NEAR(value_of(row, "friction_heat"), friction, 1e-15 * friction);
}

/// Two blocks, the upper of which is pressed down and slides, on a floor that turns.
const Specimen& two_blocks() {
  static const Specimen specimen = [] {
    Specimen both = jittered("bcc", {4, 4, 2});
    const Specimen upper = jittered("bcc", {4, 4, 2});
    const auto count = static_cast<std::int32_t>(both.size());
    const double height = both.domain.upper.z - both.domain.lower.z;
    for (std::size_t i = 0; i < upper.size(); ++i) {
      both.position.push_back(upper.position[i] + Vector{0, 0, 1.03 * height});
      both.radius.push_back(upper.radius[i]);
    }
    for (const Pair& bond : upper.bonds) both.bonds.push_back({bond.i + count, bond.j + count});
    both.domain.upper.z += 1.03 * height;
    both.domain.volume *= 2;
    return both;
  }();
  return specimen;
}

solidem::Setup of_blocks(bool friction_heats = true) {
  double low = 1;
  for (std::size_t i = 0; i < two_blocks().size(); ++i)
    low = std::min(low, two_blocks().position[i].z - two_blocks().radius[i]);
  const std::string touching =
      "[contact]\nfriction = 0.3\nrestitution = 0.7\ninitial_overlap = \"kept\"\n"
      "[[tools]]\nname = \"floor\"\nshape = \"plane\"\nfriction = 0.3\n"
      "origin = [\"0.4 mm\", \"0.4 mm\", \"" +
      std::to_string(1e3 * low - 1e-3) +
      " mm\"]\nangular_velocity = \"20000 rad/s\"\nrotation_axis = [0, 0, 1]\n"
      "velocity = [\"0 m/s\", \"0 m/s\", \"3 m/s\"]\n";
  const std::string heating =
      "conductivity = \"50 W/(m K)\"\ndensity = \"7800 kg/m^3\"\n"
      "specific_heat_capacity = \"490 J/(kg K)\"\n[friction_heat]\ndamping_fraction = 1\n";
  auto setup = scene_with(friction_heats ? touching + heating : touching);
  setup.run.time_step_ratio = 0.2;
  return setup;
}

/// The upper block moves down and along the other.
std::unique_ptr<Simulation> sliding(const Setup& setup) {
  auto simulation = std::make_unique<Simulation>(setup, two_blocks());
  for (std::size_t i = two_blocks().size() / 2; i < two_blocks().size(); ++i)
    set_velocity(*simulation, i, {40, 12, -40});
  return simulation;
}

struct Case {
  const char* name;
  HeatIntegratorName integrator;
  std::int64_t every;
  bool capacity_varies;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class FrictionHeatOf : public testing::TestWithParam<Case> {};

TEST_P(FrictionHeatOf, blocks_that_slide_is_what_motion_lost_at_any_moment) {
  auto setup = of_blocks();
  setup.get<ConductionParameters>()->integrator = GetParam().integrator;
  setup.get<ConductionParameters>()->every = GetParam().every;
  if (GetParam().capacity_varies)
    setup.materials[0].specific_heat = TemperatureFunction({290, 320}, {880, 1000});
  const auto simulation = sliding(setup);
  // Temperatures near 300 K have no digits for less.
  double round_off = 0;
  for (std::size_t i = 0; i < two_blocks().size(); ++i)
    round_off += 1e-15 * 300 / simulation->model().data(columns::inverse_heat_capacity)[i];
  double lost = 0, of_elements = 0;
  for (int n = 0; n < 8; ++n) {
    simulation->advance(67);
    const HistoryRow row = simulation->observe();
    lost = value_of(row, "friction") + value_of(row, "contact_damping");
    of_elements = value_of(row, "thermal_energy") + value_of(row, "waiting_heat");
    EXPECT_NEAR(of_elements + value_of(row, "tool.floor.heat"), lost, round_off);
    EXPECT_LE(std::fabs(value_of(row, "heat_balance")), round_off);
  }
  EXPECT_GT(lost, 1e10 * round_off);
  EXPECT_GT(seen(*simulation, "tool.floor.heat"), 0.01 * lost);
  EXPECT_GT(of_elements, 0.1 * lost);
}

INSTANTIATE_TEST_SUITE_P(
    All, FrictionHeatOf,
    testing::Values(Case{"explicit", HeatIntegratorName::explicit_euler, 1, false},
                    Case{"explicit every 50", HeatIntegratorName::explicit_euler, 50, false},
                    Case{"rkl2 every 50", HeatIntegratorName::rkl2, 50, false},
                    Case{"implicit every 50", HeatIntegratorName::implicit, 50, false},
                    Case{"explicit, capacity", HeatIntegratorName::explicit_euler, 1, true}));

TEST(FrictionHeat, is_the_same_to_the_bit_on_any_threads_and_after_a_restart) {
  auto setup = of_blocks();
  setup.get<ConductionParameters>()->every = 30;
  omp_set_num_threads(1);
  const auto whole = sliding(setup);
  whole->advance(500);
  const auto expected = whole->save();
  omp_set_num_threads(2);
  const auto first = sliding(setup);
  first->advance(283);
  omp_set_num_threads(3);
  Simulation second(setup, two_blocks());
  second.restore(283, first->save());
  second.advance(217);
  omp_set_num_threads(1);
  EXPECT_EQ(second.save(), expected);
  EXPECT_EQ(seen(second, "tool.floor.heat"), seen(*whole, "tool.floor.heat"));
}

TEST(FrictionHeat, changes_no_bit_of_the_motion_and_is_nowhere_where_it_is_not_named) {
  auto cold = of_blocks();
  cold.get<FrictionHeatParameters>().reset();
  EXPECT_THROW(Simulation(cold, two_blocks()), InputError);  // the tool takes a share of nothing
  cold = of_blocks(false);
  const auto without = sliding(cold), warmed = sliding(of_blocks());
  without->advance(400);
  warmed->advance(400);
  EXPECT_GT(seen(*without, "friction"), 0);
  EXPECT_EQ(seen(*without, "thermal_energy"), 0);
  EXPECT_FALSE(without->model().has(columns::friction_heat));
  const auto expected = without->save(), found = warmed->save();
  for (const std::string name : {"pose", "velocity", "angular_velocity"})
    EXPECT_EQ(found.at("column." + name), expected.at("column." + name)) << name;
}

}  // namespace solidem::test::friction_heat_test
