// SPDX-License-Identifier: GPL-2.0-or-later
//
// Time of a bond-step: all that a time step does, over the number of bonds (each bond is worked out
// from both sides). Arguments: elements, threads. SOLIDEM_INSTRUCTION_SET chooses among the
// kernels.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <map>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "effects/kernels/kernels.hpp"
#include "engine/simulation.hpp"
#include "specimen/recipe.hpp"

namespace {

using namespace solidem;

/// A packed box, bonds at contact; made once for each size.
const Specimen& box(std::int64_t elements) {
  static std::map<std::int64_t, Specimen> made;
  if (made.count(elements) == 0) {
    SpecimenRecipe recipe;
    recipe.shape = "box";
    recipe.size = {1e-2, 1e-2, 1e-2};
    recipe.elements = elements;
    made[elements] = make_specimen(recipe);
  }
  return made[elements];
}

void time_steps(benchmark::State& state, const Setup& setup) {
  omp_set_num_threads(static_cast<int>(state.range(1)));
  Simulation simulation(setup, box(state.range(0)));
  simulation.advance(10);
  constexpr int steps = 20;
  for (auto _ : state) simulation.advance(steps);
  const auto bonds = static_cast<double>(simulation.model().slots().bonds());
  state.counters["ns_per_bond_step"] =
      benchmark::Counter(bonds * steps * 1e-9, benchmark::Counter::kIsIterationInvariantRate |
                                                   benchmark::Counter::kInvert);
  state.SetLabel(kernels().instruction_set);
}

Material aluminium() {
  Material material;
  material.density = 2790;
  material.specific_heat = 880;
  material.conductivity = 134;
  return material;
}

void beams(benchmark::State& state) {
  Setup setup;
  setup.materials.push_back(aluminium());
  BeamParameters parameters;
  parameters.young_modulus = 3.5e12;
  parameters.shear_modulus = 1.35e12;
  parameters.radius_ratio = 0.27;
  setup.get<BeamParameters>() = parameters;
  setup.all<InitialVelocity>().push_back({{}, {1, 0, 0}});
  time_steps(state, setup);
}

void conduction(benchmark::State& state) {
  Setup setup;
  setup.materials.push_back(aluminium());
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->initial_temperature = 298;
  time_steps(state, setup);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"elements", "threads"})->UseRealTime();
  for (const int threads : {1, 2}) benchmark->Args({20000, threads});
}

}  // namespace

BENCHMARK(beams)->Apply(sizes);
BENCHMARK(conduction)->Apply(sizes);
BENCHMARK_MAIN();
