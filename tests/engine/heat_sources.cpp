// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat that comes in through a shape or a spot, against its exact volume, area or integral:
// whatever the size of the elements.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/conduction_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "engine/heat.hpp"
#include "laws/constants.hpp"
#include "model/error.hpp"
#include "specimen/tessellation.hpp"
#include "support/heat.hpp"

namespace solidem::heat_sources_test {

constexpr double element = 2e-4;  // diameter in crystals of the tests, m

Shape::Part part_of(Shape::Kind kind, double radius, const Vector& size = {}) {
  Shape::Part part;
  part.kind = kind;
  part.radius = radius;
  part.size = size;
  return part;
}

std::array<TimeFunction, 3> at_rest(const Vector& place) {
  return {TimeFunction::constant(place.x), TimeFunction::constant(place.y),
          TimeFunction::constant(place.z)};
}

std::array<TimeFunction, 3> from_to(const Vector& from, const Vector& to, double duration) {
  return {TimeFunction{{0, duration}, {from.x, to.x}}, TimeFunction{{0, duration}, {from.y, to.y}},
          TimeFunction{{0, duration}, {from.z, to.z}}};
}

HeatSourceParameters source_of(const Shape::Part& part, std::array<TimeFunction, 3> position,
                               double power, bool is_density) {
  HeatSourceParameters source;
  source.name = "spot";
  source.shape = Shape{{part}};
  source.position = std::move(position);
  source.power = TimeFunction::constant(power);
  source.is_density = is_density;
  return source;
}

std::vector<ElementValue> powers_at(const Simulation& simulation, double time) {
  std::vector<ElementValue> powers;
  simulation.heat()->loads()[0]->powers(time, simulation.model().data(columns::temperature),
                                        powers);
  return powers;
}

double total_at(const Simulation& simulation, double time) {
  double sum = 0;
  for (const ElementValue& power : powers_at(simulation, time)) sum += power.value;
  return sum;
}

Setup with_source(HeatLaw law, const HeatSourceParameters& source) {
  auto setup = heat_setup(law, HeatIntegratorName::explicit_euler);
  setup.run.steps = 1;
  setup.all<HeatSourceParameters>().push_back(source);
  return setup;
}

Setup with_flux(HeatLaw law, const HeatFluxParameters& flux) {
  auto setup = heat_setup(law, HeatIntegratorName::explicit_euler);
  setup.run.steps = 1;
  setup.all<HeatFluxParameters>().push_back(flux);
  return setup;
}

TEST(Cells, as_solids_fill_the_body) {
  const Specimen body = jittered("bcc", {5, 4, 3});
  double sum = 0;
  for (const CellSolid& cell : cell_solids(body, body.domain.lower, body.domain.upper))
    sum += volume(cell.solid);
  EXPECT_NEAR(sum / body.domain.volume, 1, 1e-9);
  double area = 0;
  for (const CellSolid& slab : wall_slabs(body, "x_low", 1e-6)) area += volume(slab.solid) / 1e-6;
  const Vector size = body.domain.upper - body.domain.lower;
  EXPECT_NEAR(area / (size.y * size.z), 1, 1e-9);
}

TEST(HeatSource, smaller_than_an_element_delivers_its_power_between_rows) {
  // A laser of a fifth of an element runs along the faces between two rows.
  const double duration = 1;
  for (const HeatLaw law : {HeatLaw::voronoi, HeatLaw::platonic}) {
    const auto path =
        from_to({2 * element, 5 * element, 0}, {8 * element, 5 * element, 0}, duration);
    Simulation simulation(
        with_source(law, source_of(part_of(Shape::Kind::cylinder, 0.2 * element), path, 35, false)),
        crystal("simple_cubic", {10, 10, 2}));
    for (int k = 0; k <= 300; ++k)
      ASSERT_NEAR(total_at(simulation, duration * k / 300), 35, 1e-9) << k;
  }
}

TEST(HeatSource, of_a_density_heats_the_volume_of_its_shape_whatever_its_size_and_place) {
  Specimen body = jittered("simple_cubic", {8, 8, 4}, 0.3);
  const double thickness = 4 * element;
  for (const double radius : {0.05, 0.2, 1.0, 2.5})
    for (const Vector& place : {Vector{4, 4, 0}, Vector{3.5, 4.5, 0}, Vector{4.3, 3.9, 0}}) {
      const double r = radius * element;
      Simulation simulation(
          with_source(HeatLaw::voronoi, source_of(part_of(Shape::Kind::cylinder, r),
                                                  at_rest(element * place), 1e9, true)),
          body);
      EXPECT_NEAR(total_at(simulation, 0) / (1e9 * pi * r * r * thickness), 1, 1e-6) << radius;
    }
  for (const double size : {0.1, 1.0, 3.7}) {
    const Vector edges = element * Vector{size, 0.7 * size, 0.3 * size};
    Simulation simulation(
        with_source(HeatLaw::voronoi,
                    source_of(part_of(Shape::Kind::box, 0, edges),
                              at_rest(element * Vector{4.2, 3.9, 1.7}), 1e9, true)),
        body);
    EXPECT_NEAR(total_at(simulation, 0) / (1e9 * edges.x * edges.y * edges.z), 1, 1e-6) << size;
  }
}

TEST(HeatSource, that_is_a_box_of_whole_cells_heats_them_alone) {
  const Vector edges{2 * element, 2 * element, 2 * element};
  const Vector middle{3 * element, 3 * element, 3 * element};
  Simulation simulation(with_source(HeatLaw::voronoi, source_of(part_of(Shape::Kind::box, 0, edges),
                                                                at_rest(middle), 1e9, true)),
                        crystal("simple_cubic", {6, 6, 6}));
  const std::vector<ElementValue> powers = powers_at(simulation, 0);
  double sum = 0;
  int heated = 0;
  for (const ElementValue& power : powers) {
    sum += power.value;
    heated += power.value > 1e-9 * 1e9 * element * element * element ? 1 : 0;
  }
  EXPECT_EQ(heated, 8);
  EXPECT_NEAR(sum / (1e9 * 8 * element * element * element), 1, 1e-12);
}

TEST(HeatSource, that_moves_is_followed_to_a_per_cent_of_an_element) {
  const Specimen body = jittered("simple_cubic", {8, 6, 3}, 0.3);
  const Shape::Part disc = part_of(Shape::Kind::cylinder, 0.3 * element);
  const Vector from = element * Vector{2, 2.2, 0}, to = element * Vector{5, 3.7, 0};
  Simulation moving(with_source(HeatLaw::voronoi, source_of(disc, from_to(from, to, 1), 1, true)),
                    body);
  const double whole = pi * disc.radius * disc.radius * 3 * element;
  for (const double time : {0.113, 0.52, 0.871}) {
    Simulation still(
        with_source(HeatLaw::voronoi, source_of(disc, at_rest(from + time * (to - from)), 1, true)),
        body);
    std::vector<double> exact(body.size());
    for (const ElementValue& power : powers_at(still, 0))
      exact[static_cast<std::size_t>(power.element)] = power.value;
    for (const ElementValue& power : powers_at(moving, time))
      EXPECT_NEAR(power.value / whole, exact[static_cast<std::size_t>(power.element)] / whole,
                  0.01);
  }
}

TEST(HeatSource, in_a_periodic_body_goes_on_at_the_other_end) {
  const Shape::Part ball_part = part_of(Shape::Kind::sphere, 0.7 * element);
  const double volume = 4 * pi / 3 * std::pow(ball_part.radius, 3);
  for (const double x : {0.0, 2.3, 6.0, 9.1}) {
    Simulation simulation(
        with_source(HeatLaw::voronoi,
                    source_of(ball_part, at_rest(element * Vector{x, 2, 2}), 1e9, true)),
        crystal("simple_cubic", {6, 4, 4}, {true, false, false}));
    EXPECT_NEAR(total_at(simulation, 0) / (1e9 * volume), 1, 1e-7) << x;
  }
  const auto too_large =
      with_source(HeatLaw::voronoi,
                  source_of(part_of(Shape::Kind::sphere, 4 * element), at_rest({}), 1e9, true));
  EXPECT_THROW(Simulation(too_large, crystal("simple_cubic", {6, 4, 4}, {true, false, false})),
               InputError);
}

HeatFluxParameters flux_of(const std::string& wall, double flux) {
  HeatFluxParameters parameters{"lamp", wall, TimeFunction::constant(flux)};
  return parameters;
}

TEST(HeatFlux, on_a_part_of_a_wall_is_flux_times_its_area) {
  const Specimen body = jittered("bcc", {6, 5, 4}, 0.2);
  const Vector top{0.5 * body.domain.upper.x, 0.4 * body.domain.upper.y, body.domain.upper.z};
  for (const double radius : {0.1, 1.0, 1.9}) {
    HeatFluxParameters flux = flux_of("z_high", 1e6);
    flux.shape = Shape{{part_of(Shape::Kind::cylinder, radius * element)}};
    flux.position = at_rest(top);
    Simulation simulation(with_flux(HeatLaw::voronoi, flux), body);
    const double area = pi * std::pow(radius * element, 2);
    EXPECT_NEAR(total_at(simulation, 0) / (1e6 * area), 1, 1e-6) << radius;
  }
  // A quarter of a disc at the corner; all of a power.
  HeatFluxParameters corner = flux_of("z_high", 1e6);
  corner.shape = Shape{{part_of(Shape::Kind::cylinder, element)}};
  corner.position = at_rest({0, 0, top.z});
  Simulation quarter(with_flux(HeatLaw::voronoi, corner), body);
  EXPECT_NEAR(total_at(quarter, 0) / (1e6 * pi * element * element / 4), 1, 1e-6);
  corner.is_power = true;
  corner.flux = TimeFunction::constant(7);
  Simulation whole(with_flux(HeatLaw::voronoi, corner), body);
  EXPECT_NEAR(total_at(whole, 0), 7, 1e-12);
}

TEST(HeatFlux, of_a_gaussian_spot_is_that_of_the_error_function_on_each_face) {
  const double w = 0.8 * element, peak = 1e7;
  const Vector centre = element * Vector{4.3, 3.9, 3};
  HeatFluxParameters flux = flux_of("z_high", peak);
  flux.spot_radius = w;
  flux.position = at_rest(centre);
  const Specimen body = crystal("simple_cubic", {8, 8, 3});
  Simulation simulation(with_flux(HeatLaw::voronoi, flux), body);
  const auto along = [&](double from, double to) {
    const double root = std::sqrt(2.0) / w;
    return std::sqrt(pi) / 2 / root * (std::erf(root * to) - std::erf(root * from));
  };
  const double whole = peak * pi / 2 * w * w;
  EXPECT_NEAR(total_at(simulation, 0) / whole, 1 - std::exp(-8), 1e-8);
  for (const ElementValue& power : powers_at(simulation, 0)) {
    const Vector p = body.position[static_cast<std::size_t>(power.element)] - centre;
    const double exact = peak * along(p.x - element / 2, p.x + element / 2) *
                         along(p.y - element / 2, p.y + element / 2);
    EXPECT_NEAR(power.value / whole, exact / whole, 4e-4);  // cut at two radii
  }
}

TEST(HeatFlux, of_a_spot_that_leaves_delivers_its_power_to_the_last) {
  HeatFluxParameters flux = flux_of("z_high", 35);
  flux.is_power = true;
  flux.spot_radius = 0.1 * element;
  flux.position = from_to(element * Vector{1, 2, 2}, element * Vector{7, 2, 2}, 6);
  for (const HeatLaw law : {HeatLaw::voronoi, HeatLaw::platonic}) {
    Simulation simulation(with_flux(law, flux), crystal("simple_cubic", {6, 4, 2}));
    for (int k = 0; k <= 51; ++k) ASSERT_NEAR(total_at(simulation, 0.1 * k), 35, 1e-9) << k;
    EXPECT_EQ(total_at(simulation, 5.5), 0);
  }
}

TEST(HeatSource, keeps_the_balance_of_heat_while_it_moves) {
  const auto path = from_to(element * Vector{1, 2, 1}, element * Vector{5, 2, 1}, 2e-3);
  for (const HeatIntegratorName integrator :
       {HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2}) {
    auto setup = with_source(
        HeatLaw::voronoi, source_of(part_of(Shape::Kind::sphere, 0.4 * element), path, 3, false));
    setup.get<ConductionParameters>()->integrator = integrator;
    setup.run.steps.reset();
    setup.run.duration = 2e-3;
    if (integrator == HeatIntegratorName::rkl2) setup.run.time_step = 1e-4;
    Simulation simulation(setup, crystal("simple_cubic", {6, 4, 2}));
    simulation.advance(simulation.steps_to_run());
    EXPECT_NEAR(simulation.time() / 2e-3, 1, 1e-12);
    EXPECT_NEAR(value_of(simulation.observe(), "heat_input"), 3 * 2e-3, 1e-12);
    EXPECT_LT(relative_imbalance(simulation), 1e-11);
  }
}

}  // namespace solidem::heat_sources_test
