// SPDX-License-Identifier: GPL-2.0-or-later
#include <cstdlib>
#include <string>

#include "effects/kernels/block_rows.hpp"
#include "effects/kernels/kernels.hpp"
#include "model/error.hpp"

namespace solidem {

namespace baseline {
extern const Kernels kernels;
void multiply_rows(const BlockRows& rows, std::size_t first, std::size_t last, const double* x,
                   double* y);
}  // namespace baseline
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v3)
namespace x86_64_v3 {
extern const Kernels kernels;
void multiply_rows(const BlockRows& rows, std::size_t first, std::size_t last, const double* x,
                   double* y);
}  // namespace x86_64_v3
#endif
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v4)
namespace x86_64_v4 {
extern const Kernels kernels;
void multiply_rows(const BlockRows& rows, std::size_t first, std::size_t last, const double* x,
                   double* y);
}  // namespace x86_64_v4
#endif

std::vector<const Kernels*> usable_kernels() {
  std::vector<const Kernels*> usable;
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v4)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512cd"))
    usable.push_back(&x86_64_v4::kernels);
#endif
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v3)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    usable.push_back(&x86_64_v3::kernels);
#endif
  usable.push_back(&baseline::kernels);
  return usable;
}

namespace {

/// Of the best instruction set, or of the one that the environment asks for.
const Kernels& choose(const std::string& asked) {
  std::string names;
  for (const Kernels* candidate : usable_kernels()) {
    if (asked.empty() || asked == candidate->instruction_set) return *candidate;
    names += std::string(" ") + candidate->instruction_set;
  }
  throw InputError("SOLIDEM_INSTRUCTION_SET=" + asked +
                   ": unknown, or this machine lacks it; usable here:" + names);
}

struct Choice {
  const Kernels* set;
  Kernels kernels;
};

const Choice& choice() {
  static const Choice made = [] {
    const char* variable = std::getenv("SOLIDEM_INSTRUCTION_SET");
    const std::string asked = variable == nullptr ? "" : variable;
    const Kernels& set = choose(asked);
    Choice found{&set, set};
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v3) && defined(SOLIDEM_COMPILED_FOR_x86_64_v4)
    // Conduction does little but gather. Where the processor gathers more slowly than it loads, the
    // loops that load are better: docs/speed.md.
    if (asked.empty() && found.set == &x86_64_v4::kernels && __builtin_cpu_is("amd")) {
      found.kernels.conduct = x86_64_v3::kernels.conduct;
      found.kernels.conducted_power = x86_64_v3::kernels.conducted_power;
    }
#endif
    return found;
  }();
  return made;
}

}  // namespace

const Kernels& kernels() {
  return choice().kernels;
}

MultiplyRows multiply_rows() {
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v4)
  if (choice().set == &x86_64_v4::kernels) return x86_64_v4::multiply_rows;
#endif
#if defined(SOLIDEM_COMPILED_FOR_x86_64_v3)
  if (choice().set == &x86_64_v3::kernels) return x86_64_v3::multiply_rows;
#endif
  return baseline::multiply_rows;
}

const SoftSphereKernels& soft_sphere_kernels() {
  return kernels().soft_spheres;
}

}  // namespace solidem
