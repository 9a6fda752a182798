// SPDX-License-Identifier: GPL-2.0-or-later
//
//   bench_floors [BYTES ...]
//
// What this machine can do at most, on one thread and on all, as JSON: fused products and sums,
// divisions and roots of each instruction set, and a triad (a = b + s c) of so many bytes in all.
// Beside it what a bond needs: the arithmetic of its law, counted. The least time of a loop is the
// larger of two: its arithmetic at the rate of the former, its bytes at the rate of the latter.
#include <omp.h>

// g++ 12 finds what its own header leaves undefined on purpose.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "counted.hpp"
#include "effects/bond_state.hpp"
#include "effects/kernels/kernels.hpp"
#include "laws/bond_limit.hpp"
#include "laws/central_interaction.hpp"
#include "laws/linear_hardening.hpp"
#include "laws/piecewise.hpp"

namespace {

using nlohmann::json;
using solidem::Counted;

double seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// The largest rate of several trials: work of all threads over the time of the slowest.
template <class Work>
double best_rate(int threads, double work_of_a_thread, Work work) {
  double best = 0;
  for (int trial = 0; trial < 7; ++trial) {
    double start = 0, end = 0;
#pragma omp parallel num_threads(threads)
    {
#pragma omp barrier
#pragma omp master
      start = seconds();
      work(omp_get_thread_num());
#pragma omp barrier
#pragma omp master
      end = seconds();
    }
    best = std::max(best, threads * work_of_a_thread / (end - start));
  }
  return best;
}

constexpr int chains = 16;  // that do not wait for one another: more than latency × ports
constexpr long repetitions = 200'000;

// What is computed is kept, or it would not be computed.
#define SOLIDEM_CHAINS(name, target_set, Pack, one, operation) \
  __attribute__((target(target_set))) void name() {            \
    Pack numbers[chains];                                      \
    for (Pack & number : numbers) number = one(1.5);           \
    const Pack a = one(0.999), b = one(0.001);                 \
    for (long k = 0; k < repetitions; ++k)                     \
      for (Pack & x : numbers) x = operation;                  \
    volatile double kept = 0;                                  \
    for (Pack & x : numbers) kept = kept + x[0];               \
    (void)a, (void)b;                                          \
  }

SOLIDEM_CHAINS(fused_2, "sse2", __m128d, _mm_set1_pd, _mm_add_pd(_mm_mul_pd(x, a), b))
SOLIDEM_CHAINS(divided_2, "sse2", __m128d, _mm_set1_pd, _mm_div_pd(a, x))
SOLIDEM_CHAINS(root_2, "sse2", __m128d, _mm_set1_pd, _mm_sqrt_pd(x))
SOLIDEM_CHAINS(fused_4, "avx2,fma", __m256d, _mm256_set1_pd, _mm256_fmadd_pd(x, a, b))
SOLIDEM_CHAINS(divided_4, "avx2,fma", __m256d, _mm256_set1_pd, _mm256_div_pd(a, x))
SOLIDEM_CHAINS(root_4, "avx2,fma", __m256d, _mm256_set1_pd, _mm256_sqrt_pd(x))
SOLIDEM_CHAINS(fused_8, "avx512f", __m512d, _mm512_set1_pd, _mm512_fmadd_pd(x, a, b))
SOLIDEM_CHAINS(divided_8, "avx512f", __m512d, _mm512_set1_pd, _mm512_div_pd(a, x))
SOLIDEM_CHAINS(root_8, "avx512f", __m512d, _mm512_set1_pd, _mm512_sqrt_pd(x))
#undef SOLIDEM_CHAINS

struct InstructionSet {
  const char* name;
  int lanes;
  bool usable;
  void (*fused)();
  void (*divided)();
  void (*root)();
};

std::vector<InstructionSet> instruction_sets() {
  return {{"x86_64_v4", 8, __builtin_cpu_supports("avx512f") != 0, fused_8, divided_8, root_8},
          {"x86_64_v3", 4, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"), fused_4,
           divided_4, root_4},
          {"baseline", 2, true, fused_2, divided_2, root_2}};
}

/// Per second, of all lanes of all threads.
json arithmetic(int threads) {
  json sets;
  for (const InstructionSet& set : instruction_sets()) {
    if (!set.usable) continue;
    const double work = double(chains) * repetitions * set.lanes;
    sets[set.name] = {
        {"fused", best_rate(threads, work, [&](int) { set.fused(); })},
        {"divisions", best_rate(threads, work, [&](int) { set.divided(); })},
        {"roots", best_rate(threads, work, [&](int) { set.root(); })},
    };
  }
  return sets;
}

/// Bytes per second of a triad over three arrays of `bytes` in all: two are read, one is written.
double triad(int threads, std::size_t bytes) {
  const std::size_t count =
      std::max<std::size_t>(bytes / 24 / static_cast<std::size_t>(threads), 64);
  std::vector<std::vector<double>> parts(static_cast<std::size_t>(threads));
#pragma omp parallel num_threads(threads)
  parts[static_cast<std::size_t>(omp_get_thread_num())].assign(3 * count,
                                                               1.0);  // touched first here
  const auto times = static_cast<long>(std::max<std::size_t>(1, 50'000'000 / (24 * count)));
  return best_rate(threads, 24.0 * static_cast<double>(count) * static_cast<double>(times),
                   [&](int thread) {
                     double* a = parts[static_cast<std::size_t>(thread)].data();
                     double *b = a + count, *c = b + count;
                     for (long k = 0; k < times; ++k) {
#pragma omp simd
                       for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 0.5 * c[i];
                       std::swap(a, c);
                     }
                   });
}

json told(const solidem::Operations& operations) {
  return {{"simple", operations.simple},
          {"divisions", operations.divisions},
          {"roots", operations.roots}};
}

using Vector = solidem::Vector3<Counted>;
using Orientation = solidem::Quaternion<Counted>;

Vector vector(double x, double y, double z) {
  return {Counted(x), Counted(y), Counted(z)};
}

/// A slot whose columns are not there: any number does, as only what is done with it counts.
struct AnySlot {
  Counted number(const double*, int = 1, int = 0) const { return Counted(0.01); }
  Vector vector(const double*) const { return ::vector(1, 0, 0); }
};

/// Sums the load of a bond up.
void add(const solidem::BeamLoad<Counted>& load) {
  Vector force = vector(0, 0, 0), moment = vector(0, 0, 0);
  force += load.force;
  moment += load.moment_i;
}

/// Arithmetic of one side of a beam: chord, pose, deformation, load, and its sum.
json of_a_beam_slot() {
  const solidem::BeamMotion columns{};
  const Orientation turned{Counted(1), vector(0, 0, 0)};
  Counted::operations() = {};
  const solidem::BondKind kind{true, false, false};
  const auto bond = load_bond(kind, columns, AnySlot{}, false, vector(1, 0, 0) - vector(0, 0, 0),
                              turned, turned, turned);
  add(beam_load(bond.rigidity, bond.pose, bond.deformation));
  return told(Counted::operations());
}

/// The same of one that flows by radial return and linear hardening: its shape, the flow, the
/// deformation in the pose before, the work between both, what it remembers and up to where it is
/// safe then.
json of_a_flowing_slot() {
  const solidem::BeamMotion columns{};
  const Orientation turned{Counted(1), vector(0, 0, 0)};
  const solidem::LinearHardening law{1e-4, 0.01};
  const AnySlot slot;
  Counted::operations() = {};
  const solidem::BondKind kind{true, false, true};
  auto bond = load_bond(kind, columns, slot, true, vector(1, 0, 0) - vector(0, 0, 0), turned,
                        turned, turned);
  bond.history.strain = slot.number(nullptr);
  const solidem::YieldingBeam<Counted> beam{bond.rigidity, bond.rest_length, Counted(1),
                                            Counted(0.4)};
  const auto posed =
      posed_beam(kind, columns, slot, solidem::FlowRule::radial_return, bond, turned, turned);
  const auto curve = yield_curve(law, columns, slot, Counted(0), bond.history.strain);
  const auto flow =
      solidem::beam_flow<solidem::FlowRule::radial_return>(curve, beam, bond.history.strain, posed);
  const Vector last_chord = rotate(turned, vector(1, 0, 0) - vector(0, 0, 0));
  const auto last = last_beam(kind, bond, turned, last_chord, turned * turned);
  const auto response = flowed_response(beam, bond.history, posed, flow, last);
  add(response.load);
  Counted work(0);
  work += Counted(0.5) * response.plastic_work;
  strain_before_flow(curve, solidem::FlowRule::radial_return, flow.strain);
  solidem::Operations needed = Counted::operations();
  // Of a response the loop leaves the energy out.
  Counted::operations() = {};
  beam_energy(beam.rigidity, flow.left.pose, flow.left.deformation);
  needed.simple -= Counted::operations().simple;
  return told(needed);
}

/// Arithmetic of one side of a pair under the piecewise law.
json of_a_central_slot(bool dissipates) {
  const solidem::Piecewise law{1, 0.01};
  Counted::operations() = {};
  const Vector chord = vector(1, 0, 0) - vector(0, 0, 0);
  const Counted square = dot(chord, chord), inverse = Counted(1) / sqrt(square);
  const solidem::Separation<Counted> at{square * inverse, inverse, Counted(1)};
  Counted push = law.force(at), dissipated(0);
  at.compression_ratio();
  if (dissipates) {
    const Counted drag =
        solidem::dissipative_force(Counted(1), chord, inverse, vector(1, 0, 0) - vector(0, 0, 0));
    push += drag;
    dissipated += drag * drag;
  }
  Vector force = vector(0, 0, 0);
  force += (push * inverse) * chord;
  return told(Counted::operations());
}

}  // namespace

int main(int count, char** words) {
  const int all = omp_get_max_threads();
  json report;
  for (const int threads : all > 1 ? std::vector<int>{1, all} : std::vector<int>{1}) {
    json& found = report["threads"][std::to_string(threads)];
    found["arithmetic"] = arithmetic(threads);
    for (int k = 1; k < count; ++k)
      found["triad"][words[k]] = triad(threads, std::stoull(words[k]));
  }
  // Of a conductor: the difference of two temperatures, times a conductance, added.
  report["slot"] = {{"beams", of_a_beam_slot()},
                    {"beams_flowing", of_a_flowing_slot()},
                    {"central_fixed", of_a_central_slot(false)},
                    {"central_changing", of_a_central_slot(true)},
                    {"conduction", told({3, 0, 0})}};
  std::cout << report.dump(2) << "\n";
}
