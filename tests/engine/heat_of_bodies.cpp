// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat in several bodies: each conducts as it does alone, however it is turned.
#include <gtest/gtest.h>

#include <cmath>

#include "effects/heat_load_parameters.hpp"
#include "engine/heat.hpp"
#include "laws/constants.hpp"
#include "model/error.hpp"
#include "specimen/bodies.hpp"
#include "support/heat.hpp"

namespace solidem::heat_of_bodies_test {

// A bar along x, from its origin.
BodyRecipe bar(const std::string& name, std::uint64_t seed) {
  BodyRecipe body;
  body.name = name;
  body.recipe.shape = "box";
  body.recipe.size = {2e-3, 1e-3, 1e-3};
  body.recipe.elements = 150;
  body.recipe.seed = seed;
  return body;
}

// Two bars, of which the second stands upright: x to z, z to −x.
std::vector<BodyRecipe> two_bars() {
  BodyRecipe upright = bar("upright", 2);
  upright.turned = {std::sqrt(0.5), {0, -std::sqrt(0.5), 0}};
  upright.shift = {9e-3, 0, 1e-3};
  return {bar("flat", 1), upright};
}

// A spot on the wall at the low end of the bar, which is held at the other end.
Setup heated(const std::string& body, const Vector& spot) {
  Setup setup = heat_setup(HeatLaw::voronoi, HeatIntegratorName::explicit_euler);
  setup.run.steps = 200;
  HeatFluxParameters flux;
  flux.name = "spot";
  flux.wall = body + "x_low";
  flux.spot_radius = 0.2e-3;
  flux.flux = TimeFunction::constant(1e7);
  flux.position = {TimeFunction::constant(spot.x), TimeFunction::constant(spot.y),
                   TimeFunction::constant(spot.z)};
  setup.all<HeatFluxParameters>().push_back(flux);
  setup.all<ImposedTemperatureParameters>().push_back(held_wall(body + "x_high", 350));
  return setup;
}

TEST(HeatOfBodies, IsThatOfEachAloneAndStaysInIt) {
  const std::vector<BodyRecipe> recipes = two_bars();
  Simulation alone(heated("", {0, 0.4e-3, 0.6e-3}), make_specimen(recipes[1].recipe));
  // Where x, y, z were, z, y, −x are.
  Simulation both(heated("upright.", {9e-3 - 0.6e-3, 0.4e-3, 1e-3}), make_bodies(recipes));
  alone.advance(200);
  both.advance(200);
  const double* expected = alone.model().data(columns::temperature);
  const double* found = both.model().data(columns::temperature);
  const std::vector<Body>& bodies = both.model().specimen().bodies;
  for (const std::int32_t element : bodies[0].elements) EXPECT_EQ(found[element], 298);
  double warmest = 0;
  for (std::size_t k = 0; k < bodies[1].elements.size(); ++k) {
    EXPECT_NEAR(found[bodies[1].elements[k]], expected[k], 1e-9);
    warmest = std::max(warmest, expected[k]);
  }
  EXPECT_GT(warmest, 310);
  EXPECT_LT(relative_imbalance(both), 1e-12);
}

TEST(HeatOfBodies, IsRefusedThroughFacesThatBondedBodiesDoNotShare) {
  std::vector<BodyRecipe> recipes = two_bars();
  recipes[1].bonded_to = {"flat"};
  try {
    Simulation both(heated("upright.", {8.4e-3, 0.4e-3, 1e-3}), make_bodies(recipes));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"upright\" and of \"flat\""), std::string::npos)
        << error.what();
  }
}

}  // namespace solidem::heat_of_bodies_test
