// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat through the whole surface of a body, whether its walls are known or not, and through what
// cracks lay open.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/exposed_surface.hpp"
#include "effects/rupture.hpp"
#include "effects/surroundings.hpp"
#include "engine/heat.hpp"
#include "laws/constants.hpp"
#include "model/error.hpp"
#include "specimen/bonds.hpp"
#include "support/beams.hpp"
#include "support/heat.hpp"

namespace solidem::exposed_surface_test {

Specimen packed(const std::string& shape, int elements) {
  SpecimenRecipe recipe;
  recipe.shape = shape;
  recipe.size = {3e-3, 1e-3, 1e-3};
  recipe.radius = 1e-3;
  recipe.elements = elements;
  return make_specimen(recipe);
}

/// The same, known by its spheres alone.
Specimen imported(Specimen specimen) {
  specimen.domain.shape = "imported";
  specimen.domain.radius = 0;
  return specimen;
}

/// The part of a specimen whose centres lie in a ball about the middle, with its volume.
Specimen ball_cut_from(const Specimen& whole, double radius) {
  Specimen part = whole;
  part.position.clear();
  part.radius.clear();
  part.bonds.clear();
  const Vector middle = 0.5 * (whole.domain.lower + whole.domain.upper);
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (norm(whole.position[i] - middle) < radius) {
      part.position.push_back(whole.position[i]);
      part.radius.push_back(whole.radius[i]);
    }
  return imported(part);
}

double area_of(const Specimen& specimen) {
  const Surroundings surroundings(specimen);
  double sum = 0;
  for (const double area : surroundings.areas(surroundings.openness())) sum += area;
  return sum;
}

TEST(ExposedArea, of_bodies_known_by_their_spheres_alone_is_that_of_their_outline) {
  EXPECT_NEAR(area_of(imported(crystal("simple_cubic", {10, 8, 7}))) / (4e-8 * 2 * (80 + 70 + 56)),
              1, 0.03)
      << "a lattice, whose pores are closed";
  EXPECT_NEAR(area_of(imported(packed("box", 2000))) / 14e-6, 1, 0.04) << "a packed bar";
  EXPECT_NEAR(area_of(imported(packed("sphere", 1000))) / (4e-6 * pi), 1, 0.05) << "a packed ball";
  // Its skin are elements that a knife went by, not elements that leant on a wall.
  EXPECT_NEAR(area_of(ball_cut_from(packed("sphere", 3000), 0.7e-3)) / (4e-6 * pi * 0.49), 1, 0.08)
      << "a ball cut from a packing";
}

TEST(ExposedArea, counts_both_faces_of_a_slit_as_wide_as_an_element_and_the_inside_of_a_hole) {
  Specimen bar = crystal("simple_cubic", {9, 6, 6});
  const double d = 2e-4;
  Specimen slit = bar;
  slit.position.clear();
  slit.radius.clear();
  for (std::size_t i = 0; i < bar.size(); ++i) {
    const bool is_cut =
        std::abs(bar.position[i].x - 4.5 * d) < 0.1 * d && bar.position[i].y > 3 * d;
    if (is_cut) continue;
    slit.position.push_back(bar.position[i]);
    slit.radius.push_back(bar.radius[i]);
  }
  // Of 2 (54 + 54 + 36) two faces of 3 × 6 and the ground of 6 come, 3 · 2 + 6 · 1 of the outside
  // go.
  EXPECT_NEAR(area_of(imported(slit)) / (d * d * (288 + 36 + 6 - 12)), 1, 0.03);
}

Setup cooled(HeatLaw law, double coefficient, double conductivity) {
  auto setup = heat_setup(law, HeatIntegratorName::implicit);
  setup.materials[0].conductivity = conductivity;
  setup.get<ConductionParameters>()->initial_temperature = 400;
  setup.all<ConvectionParameters>().push_back({"air", ExposedSurface::word,
                                               TimeFunction::constant(coefficient),
                                               TimeFunction::constant(300)});
  return setup;
}

double mean_excess(const Simulation& simulation) {
  double sum = 0, capacity = 0;
  for (std::size_t i = 0; i < simulation.model().elements(); ++i) {
    const double own = 1 / simulation.model().data(columns::inverse_heat_capacity)[i];
    sum += own * (simulation.model().data(columns::temperature)[i] - 300);
    capacity += own;
  }
  return sum / capacity / 100;
}

/// h A / (m c) of a body that conducts much better than it is cooled, as its cooling tells it.
double lumped_rate(Setup setup, const Specimen& specimen, double guess) {
  setup.run.time_step = 0.01 / guess;
  setup.run.steps = 100;
  Simulation simulation(setup, specimen);
  simulation.advance(100);
  EXPECT_LT(relative_imbalance(simulation), 1e-9);
  return -std::log(mean_excess(simulation)) / (100 * *setup.run.time_step);
}

TEST(ExposedSurface, cools_a_body_of_one_temperature_as_its_area_says) {
  constexpr double h = 10, conductivity = 1e4;
  const double bar = h * 14e-6 / (2790 * 880 * 3e-9), ball = h * 3 / (2790 * 880 * 1e-3);
  for (const HeatLaw law : {HeatLaw::voronoi, HeatLaw::platonic_calibrated}) {
    auto setup = cooled(law, h, conductivity);
    if (law == HeatLaw::platonic_calibrated) setup.get<ConductionParameters>()->area_factor = 0.8;
    EXPECT_NEAR(lumped_rate(setup, packed("box", 700), bar) / bar, 1, 1e-3) << name_of(law);
  }
  auto setup = cooled(HeatLaw::platonic_calibrated, h, conductivity);
  setup.get<ConductionParameters>()->area_factor = 0.8;
  EXPECT_NEAR(lumped_rate(setup, imported(packed("sphere", 1000)), ball) / ball, 1, 0.04);
}

TEST(ExposedSurface, cools_a_ball_as_the_series_says_where_conduction_and_convection_compete) {
  // Bi = h R / λ = 1: ζ cot ζ = 0, so ζ = π/2, 3π/2 … and the mean is Σ 6 exp(−ζ² Fo) / ζ⁴.
  constexpr double conductivity = 134, h = conductivity / 1e-3, fourier = 0.4;
  double mean = 0;
  for (int k = 0; k < 5; ++k) {
    const double square = std::pow((k + 0.5) * pi, 2);
    mean += 6 * std::exp(-square * fourier) / (square * square);
  }
  auto setup = cooled(HeatLaw::voronoi, h, conductivity);
  setup.run.steps = 100;
  setup.run.time_step = fourier * 1e-6 / (134 / (2790.0 * 880.0)) / 100;
  Simulation walled(setup, packed("sphere", 700));
  walled.advance(100);
  EXPECT_NEAR(mean_excess(walled) / mean, 1, 0.02);
  setup.get<ConductionParameters>()->law = HeatLaw::platonic_calibrated;
  setup.get<ConductionParameters>()->area_factor = 0.8;
  Simulation known_by_spheres(setup, imported(packed("sphere", 700)));
  known_by_spheres.advance(100);
  EXPECT_NEAR(mean_excess(known_by_spheres) / mean, 1, 0.05);
}

/// A bar with heat and bonds that may break.
std::unique_ptr<Simulation> breakable(
    HeatIntegratorName integrator = HeatIntegratorName::implicit) {
  auto setup = elastic_setup();
  setup.get<RuptureParameters>() = breaking_at_strain(0.5);
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->initial_temperature = 400;
  setup.get<ConductionParameters>()->integrator = integrator;
  setup.all<ConvectionParameters>().push_back(
      {"air", ExposedSurface::word, TimeFunction::constant(1e4), TimeFunction::constant(300)});
  setup.run.time_step_ratio = 0.3;
  return std::make_unique<Simulation>(setup, random_bar(1200));
}

void break_bonds(Simulation& simulation, const std::vector<Pair>& pairs) {
  for (const auto& effect : simulation.effects())
    if (auto* rupture = dynamic_cast<Rupture*>(effect.get()))
      rupture->break_bonds(pairs, {0, simulation.time_step().value, 0});
}

/// Breaks bonds from one side of the middle to the other, as far as they lie below a height.
void cut(Simulation& simulation, double height = 1) {
  const std::vector<Vector>& at = simulation.model().specimen().position;
  const Domain& domain = simulation.model().specimen().domain;
  const double middle = 0.5 * (domain.lower.x + domain.upper.x);
  const auto is_left = [&](std::int32_t e) { return at[static_cast<std::size_t>(e)].x < middle; };
  std::vector<Pair> across;
  for (const Pair& pair : simulation.model().slots().pairs())
    if (is_left(pair.i) != is_left(pair.j) && at[static_cast<std::size_t>(pair.i)].z < height)
      across.push_back(pair);
  break_bonds(simulation, across);
}

TEST(ExposedSurface, grows_by_two_sections_when_a_bar_breaks_and_the_new_faces_cool) {
  const auto simulation = breakable();
  const Domain& domain = simulation->model().specimen().domain;
  simulation->advance(1);
  const double before = seen(*simulation, "exposed_area");
  EXPECT_NEAR(before / wall_area(domain), 1, 1e-12);
  cut(*simulation);
  simulation->advance(1);
  const double section = domain.cross_section(0);
  EXPECT_NEAR((seen(*simulation, "exposed_area") - before) / (2 * section), 1, 0.1);
  const double heat = seen(*simulation, "convection.air.heat");
  simulation->advance(1);
  const double after = seen(*simulation, "convection.air.heat");
  EXPECT_LT(after, heat);
  EXPECT_LT(relative_imbalance(*simulation), 1e-9);
}

TEST(ExposedSurface, does_not_grow_by_single_bonds_while_others_hold_on_beside_them) {
  const auto simulation = breakable();
  const double before = seen(*simulation, "exposed_area");
  const std::vector<Pair> bonds = simulation->model().slots().pairs();
  std::vector<Pair> some;
  for (std::size_t k = 0; k < bonds.size(); k += 100) some.push_back(bonds[k]);
  break_bonds(*simulation, some);
  simulation->advance(1);
  EXPECT_LT(seen(*simulation, "exposed_area") / before, 1.02);
}

TEST(ExposedSurface, is_that_of_the_bonds_of_now_however_they_came_about) {
  const auto simulation = breakable(), at_once = breakable();
  const Vector upper = simulation->model().specimen().domain.upper;
  cut(*at_once);
  at_once->advance(1);
  for (const double part : {0.3, 0.6, 2.0}) {
    cut(*simulation, part * upper.z);
    simulation->advance(1);
  }
  EXPECT_EQ(seen(*simulation, "exposed_area"), seen(*at_once, "exposed_area"));
  const auto restored = breakable();
  restored->restore(simulation->step(), simulation->save());
  EXPECT_EQ(seen(*restored, "exposed_area"), seen(*simulation, "exposed_area"));
  simulation->advance(3);
  restored->advance(3);
  EXPECT_EQ(seen(*restored, "convection.air.heat"), seen(*simulation, "convection.air.heat"));
}

TEST(ExposedSurface, may_be_heated_in_a_region_alone_and_where_there_is_none_is_refused) {
  auto setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::explicit_euler);
  setup.all<HeatFluxParameters>().push_back(
      {"lamp", ExposedSurface::word, TimeFunction::constant(1e6)});
  setup.run.time_step = 1e-7;
  Region& region = setup.all<HeatFluxParameters>()[0].region;
  region = between(1e-3, 1);
  const Specimen bar = crystal("simple_cubic", {10, 5, 5});
  Simulation simulation(setup, bar);
  simulation.advance(10);
  // Five of ten layers along x: four sides of 1 × 1 mm and the end.
  EXPECT_NEAR(seen(simulation, "heat_flux.lamp.heat") / (1e6 * 1e-6 * 5e-6), 1, 1e-9);
  region.kind = Region::Kind::box;
  region.lower = {8e-4, 4e-4, 4e-4};
  region.upper = {12e-4, 6e-4, 6e-4};
  EXPECT_THROW(Simulation(setup, bar), InputError);
}

}  // namespace solidem::exposed_surface_test
