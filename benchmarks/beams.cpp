// SPDX-License-Identifier: GPL-2.0-or-later
//
// What beams cost in each state of their bonds: bench_beams [ROUNDS [ELEMENTS]]. A body of 20 000
// elements by default, nanoseconds for each bond and step, one thread, medians of rounds in turn:
//
// - elastic;
// - plastic, nothing flows;
// - the same with rupture and contact, nothing breaks or touches;
// - all flow: a body that stretches so fast that nearly every bond flows in each step, for some ten
//   rounds; then it comes to rest.
//
// Time is that of the processor, so that a busy machine disturbs little.
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "effects/kernels/kernels.hpp"
#include "engine/simulation.hpp"
#include "scene/body.hpp"
#include "stretched_cube.hpp"

namespace {

using namespace solidem;

constexpr const char* elastic = R"(
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
)";
constexpr const char* strong = R"(
[plasticity]
yield_strain = 0.5
hardening_ratio = 0.007
)";
constexpr const char* weak = R"(
[plasticity]
yield_strain = 0.0001
hardening_ratio = 0.007
)";
constexpr const char* may_break = R"(
[rupture]
strain = 0.9
[contact]
friction = 0.3
)";

/// A state of bonds.
struct Case {
  const char* name;
  std::string sections;
  double rate;                             ///< at which the body stretches when it begins, 1/s
  std::unique_ptr<Simulation> simulation;  ///< which goes on from round to round
  std::vector<double> times;               ///< ns for each bond and step
};

/// ns for each bond and step.
double time_of(Simulation& simulation) {
  constexpr int steps = 20;
  const double start = processor_seconds();
  simulation.advance(steps);
  const double seconds = processor_seconds() - start;
  return 1e9 * seconds / steps / static_cast<double>(simulation.model().slots().bonds());
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void measure(int rounds, const std::string& elements) {
  omp_set_num_threads(1);
  Case cases[] = {
      {"elastic", elastic, 4, {}, {}},
      {"nothing flows", std::string(elastic) + strong, 4, {}, {}},
      {"with rupture and contact", std::string(elastic) + strong + may_break, 4, {}, {}},
      {"all flow", std::string(elastic) + weak, 4e4, {}, {}},
  };
  const Specimen specimen = make_body(stretched_cube(cases[0].sections, elements, cases[0].rate));
  for (Case& one : cases) {
    one.simulation = std::make_unique<Simulation>(
        stretched_cube(one.sections, elements, one.rate).setup, specimen);
    one.simulation->advance(30);
  }
  for (int round = 0; round < rounds; ++round)
    for (Case& one : cases) one.times.push_back(time_of(*one.simulation));
  for (const Case& one : cases) {
    const auto [least, most] = std::minmax_element(one.times.begin(), one.times.end());
    std::printf("%s elements, %s, %s: %.1f ns (%.1f to %.1f), %.2f of elastic\n", elements.c_str(),
                kernels().instruction_set, one.name, median(one.times), *least, *most,
                median(one.times) / median(cases[0].times));
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    measure(count > 1 ? std::atoi(words[1]) : 7, count > 2 ? words[2] : "20000");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
