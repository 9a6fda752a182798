// SPDX-License-Identifier: GPL-2.0-or-later
//
// The transmission laws, boundary conditions and properties of conduction against exact solutions.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "engine/heat.hpp"
#include "support/heat.hpp"
#include "support/refusal.hpp"

namespace solidem::heat_laws_test {

constexpr HeatIntegratorName integrators[] = {
    HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2, HeatIntegratorName::implicit,
    HeatIntegratorName::automatic};

/// A packing of some 700 elements, 3 × 1 × 1 mm.
Specimen packed_bar() {
  SpecimenRecipe recipe;
  recipe.shape = "box";
  recipe.size = {3e-3, 1e-3, 1e-3};
  recipe.elements = 700;
  return make_specimen(recipe);
}

double temperature_of(const Simulation& simulation, std::size_t i) {
  return simulation.model().data(columns::temperature)[i];
}

/// Runs towards the steady state: ten times L²/α.
void settle(Setup& setup) {
  setup.get<ConductionParameters>()->integrator = HeatIntegratorName::implicit;
  setup.run.steps = 40;
  setup.run.time_step = 0.25 * 9e-6 / (134 / (2790.0 * 880.0));
}

TEST(VoronoiConduction, carries_a_linear_field_exactly_between_walls) {
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::implicit);
  setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 300), held_wall("x_high", 400)};
  settle(setup);
  Simulation simulation(setup, packed_bar());
  simulation.advance(40);
  const Specimen& specimen = simulation.model().specimen();
  for (std::size_t i = 0; i < specimen.size(); ++i)
    EXPECT_NEAR(temperature_of(simulation, i), 300 + 100 * specimen.position[i].x / 3e-3, 1e-6);
}

TEST(VoronoiConduction, steady_heat_through_the_body_is_that_of_the_material) {
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::implicit);
  setup.all<HeatFluxParameters>().push_back({"in", "x_low", TimeFunction::constant(1e6)});
  setup.all<ConvectionParameters>().push_back(
      {"out", "x_high", TimeFunction::constant(2e4), TimeFunction::constant(298)});
  settle(setup);
  setup.run.time_step = *setup.run.time_step * 20;
  Simulation simulation(setup, packed_bar());
  simulation.advance(40);
  const Specimen& specimen = simulation.model().specimen();
  // The wall lies 1e6 / 2e4 = 50 K above the fluid, and the gradient is flux / λ.
  for (std::size_t i = 0; i < specimen.size(); ++i)
    EXPECT_NEAR(temperature_of(simulation, i),
                298 + 50 + 1e6 / 134 * (3e-3 - specimen.position[i].x), 1e-6);
}

TEST(CalibratedConduction, conducts_and_stores_heat_as_the_material_does) {
  auto setup = heat_setup(HeatLaw::platonic_calibrated, HeatIntegratorName::implicit);
  const Specimen body = packed_bar();
  settle(setup);
  Simulation simulation(setup, body);
  EXPECT_GT(simulation.heat()->area_factor(), 0.7);
  EXPECT_LT(simulation.heat()->area_factor(), 1);
  double capacity = 0;
  for (std::size_t i = 0; i < body.size(); ++i)
    capacity += 1 / simulation.model().data(columns::inverse_heat_capacity)[i];
  EXPECT_NEAR(capacity / (2790 * 880 * 3e-9), 1, 1e-12);
  // With the factor already in, a second test finds nothing to correct.
  setup.get<ConductionParameters>()->area_factor = simulation.heat()->area_factor();
  const Simulation again(setup, body);
  EXPECT_EQ(again.heat()->area_factor(), simulation.heat()->area_factor());
}

TEST(TemperatureDependence, of_conductivity_follows_kirchhoffs_transform) {
  // λ linear in T: the steady profile between 300 and 700 K makes Θ = ∫λ dT linear in x.
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::implicit);
  setup.materials[0].conductivity = TemperatureFunction({300, 700}, {100, 300});
  setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 300), held_wall("x_high", 700)};
  settle(setup);
  const auto error_of = [&](int cells) {
    Specimen body = crystal("simple_cubic", {cells, 2, 2});
    setup.run.time_step = 20 * std::pow(2e-4 * cells, 2) / 4e-5;
    Simulation simulation(setup, body);
    simulation.advance(40);
    double error = 0;
    const double length = 2e-4 * cells;
    for (std::size_t i = 0; i < body.size(); ++i) {
      const double x = body.position[i].x / length;
      const double above = (std::sqrt(100 * 100 + 2 * 0.5 * 80000 * x) - 100) / 0.5;
      error = std::max(error, std::abs(temperature_of(simulation, i) - 300 - above));
    }
    return error;
  };
  // Second order in the size of the elements.
  EXPECT_GT(error_of(8) / error_of(16), 3);
}

TEST(TemperatureDependence, of_capacity_stores_the_enthalpy_of_the_table) {
  for (const HeatIntegratorName integrator : integrators) {
    auto setup = heat_setup(HeatLaw::voronoi, integrator);
    setup.materials[0].specific_heat = TemperatureFunction({298, 498}, {800, 1600});
    setup.materials[0].conductivity = TemperatureFunction({298, 498}, {134, 60});
    auto source = ball_source(1, {}, 25);
    source.is_density = false;  // all of the body, however large the ball
    setup.all<HeatSourceParameters>().push_back(source);
    if (integrator != HeatIntegratorName::explicit_euler)
      setup.get<ConductionParameters>()->tolerance = 1e-3;
    const Specimen body = crystal("simple_cubic", {6, 3, 3});
    const double mass = 2790 * body.domain.volume;
    setup.run.steps.reset();
    setup.run.duration = mass * (800 + 1600) / 2 * 200 / 25;  // to 498 K everywhere
    setup.run.time_step = *setup.run.duration / 20000;
    if (integrator != HeatIntegratorName::explicit_euler)
      setup.run.time_step = *setup.run.duration / 20;
    Simulation simulation(setup, body);
    simulation.advance(simulation.steps_to_run());
    EXPECT_NEAR(temperature_of(simulation, 7), 498, 1e-9) << label(integrator);
    EXPECT_LT(relative_imbalance(simulation), 1e-12) << label(integrator);
  }
}

TEST(Contact, between_two_bodies_makes_the_temperature_jump) {
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::implicit);
  Region left, right;
  left.kind = right.kind = Region::Kind::box;
  left.upper.x = right.lower.x = 1e-3;
  setup.materials = {material_of(2790, 880, 134, left, "a"),
                     material_of(7800, 500, 50, right, "b")};
  setup.get<ConductionParameters>()->contacts.push_back({"b", "a", 2e4});
  setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 400), held_wall("x_high", 300)};
  settle(setup);
  setup.run.time_step = *setup.run.time_step * 100;
  Simulation simulation(setup, crystal("simple_cubic", {10, 2, 2}));
  simulation.advance(40);
  const double flux = 100 / (1e-3 / 134 + 1 / 2e4 + 1e-3 / 50);
  for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
    const double x = simulation.model().specimen().position[i].x;
    EXPECT_NEAR(temperature_of(simulation, i),
                x < 1e-3 ? 400 - flux * x / 134 : 300 + flux * (2e-3 - x) / 50, 1e-7);
  }
}

TEST(HeatBalance, closes_with_every_kind_of_load_by_every_integrator) {
  for (const HeatIntegratorName integrator : integrators)
    for (const HeatLaw law : {HeatLaw::platonic, HeatLaw::voronoi}) {
      auto setup = heat_setup(law, integrator);
      setup.all<ImposedTemperatureParameters>() = {held_wall("z_low", 350)};
      setup.all<ImposedTemperatureParameters>().push_back(
          {"layer", face(0, true), {{0, 1e-3}, {400, 800}, 20, 300, 0}});
      setup.all<HeatFluxParameters>().push_back({"lamp", "y_high", {{0, 0.01}, {0, 1e6}}});
      setup.all<ConvectionParameters>().push_back(
          {"air", "x_low", {{0, 0.01}, {100, 1e5}}, TimeFunction::constant(280)});
      auto source = ball_source(3e-4, {0, 5e-4, 5e-4}, 1e10);
      source.position[0] = {{0, 0.02}, {0, 3e-3}};
      setup.all<HeatSourceParameters>().push_back(source);
      if (integrator != HeatIntegratorName::explicit_euler)
        setup.get<ConductionParameters>()->tolerance = 0.1;
      setup.run.time_step = 1e-4;
      if (integrator == HeatIntegratorName::explicit_euler) setup.run.time_step = 2e-5;
      Simulation simulation(setup, packed_bar());
      // Loads that vary in time do not take explicit steps out of their one pass.
      EXPECT_EQ(simulation.heat()->integrator() == nullptr,
                integrator == HeatIntegratorName::explicit_euler);
      simulation.advance(100);
      const HistoryRow row = simulation.observe();
      EXPECT_LT(relative_imbalance(simulation), 1e-12) << label(integrator) << name_of(law);
      double sum = 0;
      for (const char* load : {"temperature.layer", "temperature.of_z_low", "heat_flux.lamp",
                               "convection.air", "heat_source.ball"})
        sum += value_of(row, load + std::string(".heat"));
      EXPECT_NEAR(sum / value_of(row, "heat_input"), 1, 1e-12);
    }
}

TEST(Integrators, agree_on_the_same_body) {
  std::vector<double> reference;
  for (const HeatIntegratorName integrator : integrators) {
    auto setup = heat_setup(HeatLaw::voronoi, integrator);
    setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 798)};
    setup.run.steps.reset();
    setup.run.duration = 0.02;
    const bool is_explicit = integrator == HeatIntegratorName::explicit_euler;
    if (is_explicit) setup.run.time_step = 1e-6;
    if (!is_explicit) setup.get<ConductionParameters>()->tolerance = 1e-3;
    Simulation simulation(setup, packed_bar());
    simulation.advance(simulation.steps_to_run());
    const double* t = simulation.model().data(columns::temperature);
    if (is_explicit) reference.assign(t, t + simulation.model().elements());
    for (std::size_t i = 0; i < reference.size(); ++i)
      ASSERT_NEAR(t[i], reference[i], 0.1) << label(integrator);
  }
}

TEST(Restart, goes_on_with_the_same_bits_by_every_integrator) {
  for (const HeatIntegratorName integrator : integrators) {
    auto setup = heat_setup(HeatLaw::voronoi, integrator);
    setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 798)};
    setup.all<HeatSourceParameters>().push_back(ball_source(3e-4, {1e-3, 5e-4, 5e-4}, 1e10));
    const bool is_explicit = integrator == HeatIntegratorName::explicit_euler;
    if (!is_explicit) setup.get<ConductionParameters>()->tolerance = 0.1;
    if (!is_explicit) setup.run.time_step = 5e-4;
    const Specimen body = packed_bar();
    Simulation straight(setup, body), first(setup, body), second(setup, body);
    straight.advance(20);
    first.advance(10);
    second.restore(10, first.save());
    second.advance(10);
    for (std::size_t i = 0; i < body.size(); ++i)
      ASSERT_EQ(temperature_of(second, i), temperature_of(straight, i)) << label(integrator);
    EXPECT_EQ(value_of(second.observe(), "heat_input"), value_of(straight.observe(), "heat_input"));
  }
}

TEST(Threads, however_many_give_the_same_bits) {
  // Large enough that every loop is shared out.
  const Specimen body = jittered("simple_cubic", {29, 29, 29});
  const int before = omp_get_max_threads();
  for (const HeatIntegratorName integrator : integrators) {
    auto setup = heat_setup(HeatLaw::platonic, integrator);
    setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 798)};
    setup.all<HeatSourceParameters>().push_back(ball_source(3e-4, {1e-3, 5e-4, 5e-4}, 1e10));
    const bool is_explicit = integrator == HeatIntegratorName::explicit_euler;
    if (!is_explicit) setup.get<ConductionParameters>()->tolerance = 5;
    if (!is_explicit) setup.run.time_step = 2e-3;
    std::vector<std::vector<double>> seen;
    for (const int threads : {1, 2, 3}) {
      omp_set_num_threads(threads);
      Simulation simulation(setup, body);
      simulation.advance(2);
      const double* t = simulation.model().data(columns::temperature);
      seen.emplace_back(t, t + body.size());
    }
    EXPECT_EQ(seen[0], seen[1]) << label(integrator);
    EXPECT_EQ(seen[0], seen[2]) << label(integrator);
  }
  omp_set_num_threads(before);
}

TEST(Sampling, by_a_linear_fit_is_exact_for_linear_fields) {
  auto setup = heat_setup(HeatLaw::platonic, HeatIntegratorName::explicit_euler);
  const Vector point{1.234e-3, 0.4e-3, 0.6e-3};
  setup.sensors.push_back({"nearest", point, Sensor::Quantity::temperature});
  setup.sensors.push_back({"fit", point, Sensor::Quantity::temperature, Sensor::Sampling::fit});
  Simulation simulation(setup, packed_bar());
  const auto field = [](const Vector& p) { return 300 + 1e5 * p.x - 5e4 * p.y + 2e4 * p.z; };
  for (std::size_t i = 0; i < simulation.model().elements(); ++i)
    simulation.model().data(columns::temperature)[i] =
        field(simulation.model().specimen().position[i]);
  const HistoryRow row = simulation.observe();
  EXPECT_NEAR(value_of(row, "sensor.fit.temperature"), field(point), 1e-9);
  EXPECT_GT(std::abs(value_of(row, "sensor.nearest.temperature") - field(point)), 0.1);
}

TEST(BesideBeams, voronoi_cells_conduct_while_bonds_carry) {
  // Elements as in a scene of heat alone, to the bit, though the bonds are others.
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::explicit_euler);
  setup.all<ImposedTemperatureParameters>() = {held_wall("x_low", 400)};
  setup.run.time_step = 1e-9;
  const Specimen body = packed_bar();
  Simulation alone(setup, body);
  setup.get<BeamParameters>() = elastic_setup().get<BeamParameters>();
  Simulation both(setup, body);
  EXPECT_EQ(both.model().conductors().bonds(), alone.model().slots().bonds());
  EXPECT_LT(both.model().slots().bonds(), both.model().conductors().bonds());
  alone.advance(50);
  both.advance(50);
  for (std::size_t i = 0; i < body.size(); ++i)
    EXPECT_EQ(temperature_of(both, i), temperature_of(alone, i));
}

std::string message_of(const Setup& setup, const Specimen& body) {
  return test::refusal_of([&] { Simulation simulation(setup, body); });
}

TEST(BadInput, of_heat_loads_is_refused_with_what_would_be_right) {
  const Specimen body = crystal("simple_cubic", {5, 3, 3});
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text << " lacks " << part;
  };
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::explicit_euler);
  setup.all<ImposedTemperatureParameters>() = {held_wall("front", 400)};
  has(message_of(setup, body), "wall = \"front\"");
  has(message_of(setup, body), "x_low, x_high");

  setup.all<ImposedTemperatureParameters>().clear();
  setup.run.steps = 10;
  setup.all<HeatSourceParameters>().push_back(ball_source(1e-4, {1, 1, 1}, 1e9));
  has(message_of(setup, body), "outside the body");

  setup.all<HeatSourceParameters>().clear();
  setup.get<ConductionParameters>()->law = HeatLaw::platonic;
  setup.all<ImposedTemperatureParameters>().push_back(
      {"hot", face(0, true, 0.6), TimeFunction::constant(400)});
  Specimen loose = crystal("simple_cubic", {5, 1, 1});
  loose.position.back().x += 1e-4;
  loose.domain.upper.x += 1e-4;
  make_bonds(loose, 0);
  has(message_of(setup, loose), "has a neighbour to pass heat to");
  setup.all<ImposedTemperatureParameters>().clear();

  setup.get<ConductionParameters>()->law = HeatLaw::platonic_calibrated;
  Specimen broken = crystal("simple_cubic", {9, 3, 3});
  std::vector<Pair> kept;
  for (const Pair& bond : broken.bonds) {
    const double a = broken.position[static_cast<std::size_t>(bond.i)].x;
    const double b = broken.position[static_cast<std::size_t>(bond.j)].x;
    if ((a < 9e-4) == (b < 9e-4)) kept.push_back(bond);
  }
  broken.bonds = kept;
  has(message_of(setup, broken), "no heat passes from end to end");
}

}  // namespace solidem::heat_laws_test
