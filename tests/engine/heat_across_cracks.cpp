// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heat in bodies whose bonds break and are made anew.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <memory>

#include "effects/beam_parameters.hpp"
#include "effects/beams.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "effects/rupture.hpp"
#include "engine/heat.hpp"
#include "laws/platonic_conduction.hpp"
#include "model/error.hpp"
#include "support/beams.hpp"
#include "support/heat.hpp"

namespace solidem::heat_across_cracks_test {

using BrokenBonds = ConductionParameters::BrokenBonds;
using Saved = std::map<std::string, std::vector<double>>;

/// So large that heat passes while sound crosses the body.
constexpr double large_conductivity = 2e5;

/// What breaks, is pressed together and bonded anew while one of its ends is hot.
Setup crash(HeatLaw law, HeatIntegratorName integrator) {
  auto setup = yielding_setup(2e-3, 0.01);
  setup.materials[0].conductivity = large_conductivity;
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->law = law;
  setup.get<ConductionParameters>()->integrator = integrator;
  setup.get<ConductionParameters>()->initial_temperature = 300;
  if (law == HeatLaw::platonic_calibrated) setup.get<ConductionParameters>()->area_factor = 0.8;
  if (integrator == HeatIntegratorName::automatic) setup.get<ConductionParameters>()->tolerance = 1;
  setup.get<RuptureParameters>() = breaking_at_strain(0.02);
  setup.get<ContactParameters>() = ContactParameters{};
  setup.get<ContactParameters>()->rebonding_pressure = 1e9;
  setup.all<GripParameters>() = {hold("left", face(0, false))};
  setup.all<ImposedTemperatureParameters>().push_back(
      {"hot", face(0, false), TimeFunction::constant(800)});
  setup.all<InitialVelocity>() = {{between(1.4e-3, 2.1e-3), {160, 20, 0}},
                                  {between(2.1e-3, 1), {-210, 0, 30}}};
  setup.run.time_step_ratio = 0.3;
  return setup;
}

std::size_t count_of(const Simulation& simulation, const std::string& name) {
  return static_cast<std::size_t>(seen(simulation, name));
}

struct Case {
  HeatLaw law;
  HeatIntegratorName integrator;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << name_of(c.law) << " " << name_of(c.integrator);
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const HeatLaw law : {HeatLaw::platonic, HeatLaw::platonic_calibrated, HeatLaw::voronoi})
    for (const HeatIntegratorName integrator :
         {HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2,
          HeatIntegratorName::implicit, HeatIntegratorName::automatic})
      cases.push_back({law, integrator});
  return cases;
}

class HeatAcrossCracks : public testing::TestWithParam<Case> {};

TEST_P(HeatAcrossCracks, is_conserved_while_bonds_break_and_form) {
  for (const auto choice : {BrokenBonds::insulate, BrokenBonds::conduct}) {
    auto setup = crash(GetParam().law, GetParam().integrator);
    setup.get<ConductionParameters>()->broken_bonds = choice;
    Simulation simulation(setup, random_bar(120));
    const std::size_t conductors = simulation.model().conductors().pairs().size();
    simulation.advance(1500);
    const std::size_t pairs = simulation.model().conductors().pairs().size();
    std::printf("  %zu broken, %zu formed, %zu new pairs, imbalance %.1e\n",
                count_of(simulation, "broken_bonds"), count_of(simulation, "bonds_formed"),
                pairs - conductors, relative_imbalance(simulation));
    EXPECT_GT(count_of(simulation, "broken_bonds"), 20u);
    EXPECT_GT(count_of(simulation, "bonds_formed"), 20u);
    // Cells share faces over more than the way that elements go here.
    if (GetParam().law != HeatLaw::voronoi) {
      EXPECT_GT(pairs, conductors);
    }
    EXPECT_GT(seen(simulation, "heat_input"), 0.01);
    EXPECT_LT(relative_imbalance(simulation), 1e-13);
    const auto [low, high] = extremes(simulation);
    EXPECT_GE(low, 300 * (1 - 1e-12));
    EXPECT_LE(high, 800 * (1 + 1e-12));
  }
}

TEST_P(HeatAcrossCracks, goes_on_from_a_checkpoint_with_the_same_bits) {
  const auto setup = crash(GetParam().law, GetParam().integrator);
  const Specimen specimen = random_bar(120);
  Simulation whole(setup, specimen), first(setup, specimen), second(setup, specimen);
  first.advance(400);
  second.restore(first.step(), first.save());
  EXPECT_EQ(second.save(), first.save());
  whole.advance(1000);
  second.advance(600);
  EXPECT_GT(count_of(first, "bonds_formed"), 0u);
  EXPECT_GT(count_of(whole, "bonds_formed"), count_of(first, "bonds_formed"));
  EXPECT_GT(count_of(whole, "broken_bonds"), count_of(first, "broken_bonds"));
  EXPECT_EQ(second.save(), whole.save());
  EXPECT_EQ(second.observe().values, whole.observe().values);
}

INSTANTIATE_TEST_SUITE_P(LawsAndIntegrators, HeatAcrossCracks, testing::ValuesIn(all_cases()));

TEST(HeatAcrossCracks, is_conserved_where_properties_depend_on_temperature) {
  for (const auto integrator : {HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2,
                                HeatIntegratorName::implicit}) {
    auto setup = crash(HeatLaw::platonic, integrator);
    setup.materials[0].conductivity =
        TemperatureFunction({300, 800}, {large_conductivity, 0.5 * large_conductivity});
    setup.materials[0].specific_heat = TemperatureFunction({300, 800}, {880, 1100});
    const Specimen specimen = random_bar(120);
    Simulation whole(setup, specimen), first(setup, specimen), second(setup, specimen);
    whole.advance(1000);
    first.advance(700);
    second.restore(first.step(), first.save());
    second.advance(300);
    EXPECT_GT(count_of(whole, "bonds_formed"), count_of(first, "bonds_formed"));
    EXPECT_LT(relative_imbalance(whole), 1e-13) << label(integrator);
    EXPECT_EQ(second.save(), whole.save()) << label(integrator);
  }
}

TEST(HeatAcrossCracks, is_the_same_on_any_number_of_threads) {
  const int before = omp_get_max_threads();
  // Large enough that threads share the blocks of the bonds.
  const Specimen specimen = random_bar(600);
  std::vector<Saved> states;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    Simulation simulation(crash(HeatLaw::platonic, HeatIntegratorName::explicit_euler), specimen);
    simulation.advance(600);
    EXPECT_GT(count_of(simulation, "broken_bonds"), 0u);
    states.push_back(simulation.save());
  }
  omp_set_num_threads(before);
  for (const Saved& state : states) EXPECT_EQ(state, states[0]);
}

/// Three elements in a row, the first hot, the last cold; the bond of the last breaks when asked
/// to.
struct Chain {
  std::unique_ptr<Simulation> simulation;
  double first, second;  ///< conductances, W/K

  explicit Chain(HeatIntegratorName integrator, std::optional<BrokenBonds> choice) {
    auto setup = beam_setup();
    setup.materials[0].conductivity = large_conductivity;
    setup.get<ConductionParameters>() = ConductionParameters{};
    setup.get<ConductionParameters>()->integrator = integrator;
    setup.get<ConductionParameters>()->initial_temperature = 300;
    setup.get<ConductionParameters>()->broken_bonds = choice;
    setup.get<RuptureParameters>() = breaking_at_strain(0.01);
    setup.all<ImposedTemperatureParameters>() = {
        {"hot", face(0, false), TimeFunction::constant(400)},
        {"cold", face(0, true), TimeFunction::constant(300)}};
    setup.run.time_step_ratio = 0.3;
    simulation = std::make_unique<Simulation>(setup, row_of(3));
    const PlatonicElement end{hand_radius, 1}, middle{hand_radius, 2};
    first = large_conductivity * platonic_transmission_area(end, middle) / (2 * hand_radius);
    second = first;
  }

  void tear() const {
    set_velocity(*simulation, 2, {1000, 0, 0});
    simulation->advance(10);
    set_velocity(*simulation, 2, {});
    ASSERT_EQ(seen(*simulation, "broken_bonds"), 1);
  }

  /// Power from the hot end, W, in the mean of some steps.
  double power() const {
    const double before = seen(*simulation, "temperature.hot.heat");
    simulation->advance(100);
    return (seen(*simulation, "temperature.hot.heat") - before) /
           (100 * simulation->time_step().value);
  }
  double middle() const { return simulation->model().data(columns::temperature)[1]; }
};

constexpr HeatIntegratorName fixed_integrators[] = {
    HeatIntegratorName::explicit_euler, HeatIntegratorName::rkl2, HeatIntegratorName::implicit};

TEST(CrackedChain, that_is_whole_conducts_as_its_resistances_in_series) {
  for (const auto integrator : fixed_integrators) {
    const Chain chain(integrator, {});
    chain.simulation->advance(4000);
    const double expected = 100 / (1 / chain.first + 1 / chain.second);
    EXPECT_NEAR(chain.power() / expected, 1, 1e-9) << label(integrator);
    EXPECT_NEAR(chain.middle(), 350, 1e-9) << label(integrator);
  }
}

TEST(CrackedChain, insulates_unless_told_otherwise) {
  for (const auto integrator : fixed_integrators)
    for (const auto choice : {std::optional<BrokenBonds>{}, std::optional(BrokenBonds::insulate)}) {
      const Chain chain(integrator, choice);
      chain.tear();
      const double cold = seen(*chain.simulation, "temperature.cold.heat");
      chain.simulation->advance(4000);
      EXPECT_NEAR(chain.middle(), 400, 1e-9) << label(integrator);
      EXPECT_NEAR(chain.power(), 0, 1e-9 * 100 * chain.first) << label(integrator);
      EXPECT_EQ(seen(*chain.simulation, "temperature.cold.heat"), cold) << label(integrator);
    }
}

TEST(CrackedChain, conducts_as_if_whole_where_the_scene_says_so) {
  for (const auto integrator : fixed_integrators) {
    const Chain chain(integrator, BrokenBonds::conduct);
    chain.tear();
    chain.simulation->advance(4000);
    const double expected = 100 / (1 / chain.first + 1 / chain.second);
    EXPECT_NEAR(chain.power() / expected, 1, 1e-9) << label(integrator);
    EXPECT_NEAR(chain.middle(), 350, 1e-9) << label(integrator);
  }
}

TEST(RemovedElements, keep_their_heat) {
  auto setup = crash(HeatLaw::platonic, HeatIntegratorName::explicit_euler);
  setup.get<RuptureParameters>()->minimal_bonds = 3;
  Simulation simulation(setup, random_bar(120));
  simulation.advance(500);
  std::vector<std::pair<std::size_t, double>> removed;
  const double* temperature = simulation.model().data(columns::temperature);
  for (std::int32_t e = 0; e < 120; ++e)
    if (const auto i = static_cast<std::size_t>(e); simulation.find<Rupture>()->is_removed(e))
      removed.emplace_back(i, temperature[i]);
  ASSERT_GT(removed.size(), 0u);
  simulation.advance(500);
  temperature = simulation.model().data(columns::temperature);
  for (const auto& [i, value] : removed) EXPECT_EQ(temperature[i], value);
  EXPECT_LT(relative_imbalance(simulation), 1e-13);
}

TEST(Conductors, have_a_table_of_their_own_only_where_bonds_may_break) {
  auto setup = crash(HeatLaw::platonic, HeatIntegratorName::explicit_euler);
  const Specimen specimen = random_bar(120);
  const Simulation breaking(setup, specimen);
  EXPECT_FALSE(breaking.model().shares_conductors());
  setup.get<ContactParameters>().reset();
  setup.get<RuptureParameters>().reset();
  const Simulation lasting(setup, specimen);
  EXPECT_TRUE(lasting.model().shares_conductors());
  EXPECT_EQ(&lasting.model().conductors(), &lasting.model().slots());
  EXPECT_EQ(lasting.save().count("effect.conduction"), 0u);
  EXPECT_EQ(breaking.model().conductors().pairs(), lasting.model().conductors().pairs());
}

/// Bonds two elements at rest that were no neighbours, as if they had met at a distance.
void bond_anew(Simulation& simulation, double distance) {
  Model& model = simulation.model();
  const auto last = static_cast<std::int32_t>(model.elements()) - 1;
  for (std::int32_t i = 0; i < last; ++i)
    for (std::int32_t j = last; j > i; --j) {
      if (model.slots().find(i, j) || !model.make_bond({i, j}, distance)) continue;
      const Vector chord = centre_of(simulation, static_cast<std::size_t>(j)) -
                           centre_of(simulation, static_cast<std::size_t>(i));
      const auto here = *model.slots().find(i, j), there = *model.slots().find(j, i);
      simulation.find<Beams>()->bind(model, i, j, here.row, here.lane, chord);
      simulation.find<Beams>()->bind(model, j, i, there.row, there.lane, -chord);
      return;
    }
  FAIL() << "no element has a free slot";
}

TEST(Conductors, that_new_bonds_add_to_never_make_an_explicit_step_unstable_silently) {
  auto setup = crash(HeatLaw::platonic, HeatIntegratorName::explicit_euler);
  setup.all<InitialVelocity>().clear();
  const Specimen specimen = random_bar(120);
  const Simulation looked_at(setup, specimen);
  // The limit of heat is brought down to the step that motion asks for.
  setup.run.time_step = looked_at.time_step().value;
  setup.materials[0].conductivity =
      0.999 * large_conductivity * looked_at.heat()->limit() / looked_at.time_step().value;
  const double diameter = 2 * mean_radius(specimen);
  Simulation weak(setup, specimen);
  bond_anew(weak, 1e6 * diameter);
  EXPECT_NO_THROW(weak.advance(10));
  Simulation strong(setup, specimen);
  bond_anew(strong, 0.1 * diameter);
  try {
    strong.advance(1);
    FAIL() << "a step that is not stable was taken";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("bonds made anew"), std::string::npos);
  }
  // Stages follow the limit.
  for (const auto integrator : {HeatIntegratorName::rkl2, HeatIntegratorName::implicit}) {
    setup.get<ConductionParameters>()->integrator = integrator;
    Simulation staged(setup, specimen);
    staged.advance(1);
    bond_anew(staged, 0.01 * diameter);
    staged.advance(300);
    const auto [low, high] = extremes(staged);
    EXPECT_GE(low, 300 - 1e-3) << label(integrator);
    EXPECT_LE(high, 800 + 1e-3) << label(integrator);
    EXPECT_LT(relative_imbalance(staged), 1e-13) << label(integrator);
  }
}

}  // namespace solidem::heat_across_cracks_test
