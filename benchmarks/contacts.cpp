// SPDX-License-Identifier: GPL-2.0-or-later
//
// What contacts cost: bench_contacts [ROUNDS [ELEMENTS]]. Bodies of 20 000 elements by default, in
// turns, the fastest of each:
//
// - crushed: loose elements that all touch, ns a contact and step, on one thread and on two;
// - nothing touches: beams with [contact] over beams without;
// - mesh: beams that stand on a tool of ten thousand facets over beams without.
//
// Time is that of the processor in the calling thread: while it waits for other threads or for a
// busy machine it does not count, so that figures of two threads are what two free cores would
// give.
#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

#include "effects/kernels/kernels.hpp"
#include "effects/tools.hpp"
#include "engine/simulation.hpp"
#include "model/error.hpp"
#include "scene/body.hpp"
#include "stretched_cube.hpp"

namespace {

using namespace solidem;

constexpr const char* loose = R"(
[contact]
young_modulus = "70 GPa"
friction = 0.3
restitution = 0.8
initial_overlap = "kept"
)";
constexpr const char* beams = R"(
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
)";
constexpr const char* beside_beams = R"(
[contact]
friction = 0.3
)";

/// A floor under the whole body, of two facets a square, as a file for as long as it lives.
class FloorOfFacets {
 public:
  explicit FloorOfFacets(int squares)
      : path_(std::filesystem::temp_directory_path() / "solidem_bench_floor.obj") {
    std::ofstream file(path_);
    for (int j = 0; j <= squares; ++j)
      for (int i = 0; i <= squares; ++i)
        file << "v " << 12.0 * i / squares - 1 << ' ' << 12.0 * j / squares - 1 << " 0\n";
    for (int j = 0; j < squares; ++j)
      for (int i = 1; i <= squares; ++i) {
        const int a = j * (squares + 1) + i, c = a + squares + 1;
        file << "f " << a << ' ' << a + 1 << ' ' << c + 1 << '\n';
        file << "f " << a << ' ' << c + 1 << ' ' << c << '\n';
      }
  }
  ~FloorOfFacets() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  FloorOfFacets(const FloorOfFacets&) = delete;
  FloorOfFacets& operator=(const FloorOfFacets&) = delete;

  /// Of a tool that presses up.
  std::string section() const {
    return "[[tools]]\nname = \"floor\"\nshape = \"mesh\"\nfile = \"" + path_.string() +
           "\"\nunit = \"1 mm\"\nfriction = 0.3\n"
           "velocity = [\"0 m/s\", \"0 m/s\", \"0.5 m/s\"]\n";
  }

 private:
  std::filesystem::path path_;
};

/// A scene on a body that is made once.
struct Case {
  Scene scene;
  const Specimen* specimen;
  std::int64_t steps_before, steps;

  /// Seconds of a step, and contacts of elements, or elements that tools touch, in the middle.
  std::pair<double, double> time(int threads) const {
    omp_set_num_threads(threads);
    Simulation simulation(scene.setup, *specimen);
    simulation.advance(steps_before);
    double seconds = 0, contacts = 0;
    for (int half = 0; half < 2; ++half) {
      const double start = processor_seconds();
      simulation.advance(steps / 2);
      seconds += processor_seconds() - start;
      if (half > 0) continue;
      for (const auto& [name, value] : simulation.observe().values)
        if (name == "contacts") contacts = value;
      for (const auto& effect : simulation.effects())
        if (const auto* tool = dynamic_cast<const Tool*>(effect.get()))
          contacts += static_cast<double>(tool->touched().size());
    }
    return {seconds / static_cast<double>(steps), contacts};
  }
};

void measure(int rounds, const std::string& elements) {
  // A body that shrinks so fast that all of its elements touch within a few steps.
  const Scene crushed = stretched_cube(loose, elements, -4000);
  const FloorOfFacets floor(71);
  const Specimen packing = make_body(crushed);
  const Case grains{crushed, &packing, 30, 60},
      bonded{stretched_cube(beams, elements, 4), &packing, 10, 60},
      watched{stretched_cube(std::string(beams) + beside_beams, elements, 4), &packing, 10, 60},
      pressed{stretched_cube(beams + floor.section(), elements, 4), &packing, 10, 60};
  double best[5];
  std::fill_n(best, 5, std::numeric_limits<double>::infinity());
  double contacts = 0, touched = 0;
  for (int round = 0; round < rounds; ++round) {
    for (int threads : {1, 2}) {
      const auto [seconds, count] = grains.time(threads);
      best[threads - 1] = std::min(best[threads - 1], seconds);
      contacts = count;
    }
    best[2] = std::min(best[2], bonded.time(1).first);
    best[3] = std::min(best[3], watched.time(1).first);
    const auto [with_mesh, on_mesh] = pressed.time(1);
    best[4] = std::min(best[4], with_mesh);
    touched = on_mesh;
    std::printf(
        "%s elements, %.0f contacts, %s: crushed %.1f ns a contact and step, two threads "
        "%.2f times as fast; nothing touches: %.2f %% of beams; a mesh of 10082 facets, which %.0f "
        "elements touch: %.2f %%\n",
        elements.c_str(), contacts, kernels().instruction_set, 1e9 * best[0] / contacts,
        best[0] / best[1], 100 * (best[3] / best[2] - 1), touched, 100 * (best[4] / best[2] - 1));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int count, char** words) {
  try {
    measure(count > 1 ? std::atoi(words[1]) : 5, count > 2 ? words[2] : "20000");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
