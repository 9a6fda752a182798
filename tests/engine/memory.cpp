// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "effects/conduction_parameters.hpp"
#include "support/specimens.hpp"

namespace solidem::memory_test {

/// A packing with about 6.2 neighbours an element, as users make them.
const Specimen& packing() {
  static const Specimen specimen = [] {
    SpecimenRecipe recipe;
    recipe.shape = "box";
    recipe.size = {1e-2, 1e-2, 1e-2};
    recipe.elements = 1000;
    return make_specimen(recipe);
  }();
  return specimen;
}

double bytes_per_element(const Setup& setup) {
  const Simulation simulation(setup, packing());
  return static_cast<double>(simulation.model().bytes()) /
         static_cast<double>(simulation.model().elements());
}

TEST(Memory, of_conduction_alone_is_little) {
  const double bytes = bytes_per_element(thermal_setup());
  std::printf("conduction: %.1f bytes per element\n", bytes);
  EXPECT_LE(bytes, 150);
}

TEST(Memory, of_elastic_beams) {
  const double bytes = bytes_per_element(elastic_setup());
  std::printf("elastic beams: %.1f bytes per element\n", bytes);
  EXPECT_LE(bytes, 1200);
}

TEST(Memory, of_two_effects_is_that_of_each_but_for_what_they_share) {
  auto both = elastic_setup();
  both.get<ConductionParameters>() = ConductionParameters{};
  const Simulation simulation(both, packing());
  const Model& model = simulation.model();
  const auto elements = static_cast<double>(model.elements());
  const double shared = static_cast<double>(model.slots().bytes()) / elements + 32;
  EXPECT_NEAR(bytes_per_element(both),
              bytes_per_element(elastic_setup()) + bytes_per_element(thermal_setup()) - shared,
              0.1);
}

}  // namespace solidem::memory_test
