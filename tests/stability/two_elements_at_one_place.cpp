// SPDX-License-Identifier: GPL-2.0-or-later
//
// Between two elements at one place a force has no direction: at the start that is an error that
// names both; in a run they do nothing to each other until they have parted.
#include <gtest/gtest.h>

#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "support/central_forces.hpp"

namespace solidem::two_elements_at_one_place_test {

TEST(TwoElementsAtOnePlace, are_refused_at_the_start) {
  std::vector<Vector> places = lattice({3, 3, 3});
  places[17] = places[4];
  for (const CentralLaw& law : usual_laws()) {
    try {
      const Simulation simulation(central_setup(law), elements_at(places));
      FAIL() << name_of(law);
    } catch (const InputError& error) {
      const std::string words = error.what();
      EXPECT_NE(words.find("elements 4 and 17 stand at one place"), std::string::npos) << words;
      EXPECT_NE(words.find("expected"), std::string::npos) << words;
    }
  }
}

TEST(TwoElementsAtOnePlace, are_refused_across_a_period) {
  std::vector<Vector> places = lattice({3, 3, 3});
  places[26] = places[0] + Vector{6 * hand_radius, 0, 0};
  Specimen body = elements_at(places);
  body.domain.periodic = {true, false, false};
  body.domain.lower.x = -hand_radius;
  body.domain.upper.x = 5 * hand_radius;
  EXPECT_THROW(Simulation(central_setup(), body), InputError);
}

TEST(TwoElementsAtOnePlace, do_nothing_to_each_other_in_a_run) {
  for (const CentralLaw& law : usual_laws())
    for (const bool drags : {false, true}) {
      auto setup = central_setup(law);
      if (drags) setup.get<CentralForceParameters>()->dissipation = 0.05;
      setup.get<DamageParameters>() = DamageParameters{0.3, 1, 0, 100};
      setup.run.time_step_ratio = 0.1;
      Simulation simulation(setup, elements_at({{0, 0, 0},
                                                {2 * hand_radius, 0, 0},
                                                {4 * hand_radius, 0, 0},
                                                {2 * hand_radius, 2 * hand_radius, 0}}));
      std::copy_n(simulation.model().positions()[0], 3, simulation.model().positions()[1]);
      launch(simulation, 1, {0, 10, 0});
      Observation observation;
      simulation.observe(observation);
      for (const Vector& force : observation.motion.force)
        EXPECT_TRUE(std::isfinite(norm(force))) << name_of(law);
      simulation.advance(1);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(std::isfinite(norm(place_of(simulation, i)))) << name_of(law);
        EXPECT_TRUE(std::isfinite(norm(velocity_of(simulation, i)))) << name_of(law);
      }
      EXPECT_NO_THROW(simulation.observe());
    }
}

TEST(TwoElementsAtOnePlace, by_a_head_on_flight_leave_it_again) {
  // Without any attraction or repulsion until the very middle is met: a law that is all but void.
  for (const bool drags : {false, true}) {
    auto setup = central_setup(ShiftedLennardJones{1e-300, 1.3}, 3);
    setup.get<CentralForceParameters>()->bond_tolerance = 0;
    if (drags) setup.get<CentralForceParameters>()->dissipation = 1e-300;
    setup.run.time_step = std::ldexp(1.0, -27);
    const double x = std::ldexp(1.0, -12);
    Simulation simulation(setup, elements_at({{-x, 0, 0}, {x, 0, 0}, {0, 1, 0}, {2e-4, 1, 0}}),
                          true);
    launch(simulation, 0, {2048, 0, 0});
    launch(simulation, 1, {-2048, 0, 0});
    bool met = false;
    for (int n = 0; n < 32; ++n) {
      simulation.advance(1);
      met = met || norm(place_of(simulation, 0) - place_of(simulation, 1)) == 0;
      EXPECT_NO_THROW(simulation.observe());
    }
    EXPECT_TRUE(met);
    EXPECT_EQ(place_of(simulation, 0).x, x);
    EXPECT_EQ(place_of(simulation, 1).x, -x);
  }
}

}  // namespace solidem::two_elements_at_one_place_test
