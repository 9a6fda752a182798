// SPDX-License-Identifier: GPL-2.0-or-later
#include <cstdlib>
#include <string>

#include "effects/kernels/kernels.hpp"
#include "model/error.hpp"

namespace solidem {

namespace baseline {
extern const Kernels kernels;
}
#if defined(__x86_64__)
namespace x86_64_v3 {
extern const Kernels kernels;
}
namespace x86_64_v4 {
extern const Kernels kernels;
}
#endif

namespace {

struct Candidate {
  const Kernels* kernels;
  bool usable;
};

const Kernels& choose() {
  const Candidate candidates[] = {
#if defined(__x86_64__)
    {&x86_64_v4::kernels, __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                              __builtin_cpu_supports("avx512bw") &&
                              __builtin_cpu_supports("avx512dq") &&
                              __builtin_cpu_supports("avx512cd")},
    {&x86_64_v3::kernels, __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                              __builtin_cpu_supports("bmi2")},
#endif
    {&baseline::kernels, true},
  };
  const char* asked = std::getenv("SOLIDEM_INSTRUCTION_SET");
  std::string usable;
  for (const Candidate& candidate : candidates) {
    if (!candidate.usable) continue;
    if (asked == nullptr || std::string(asked) == candidate.kernels->instruction_set)
      return *candidate.kernels;
    usable += std::string(" ") + candidate.kernels->instruction_set;
  }
  throw InputError("SOLIDEM_INSTRUCTION_SET=" + std::string(asked) +
                   ": unknown, or this machine lacks it; usable here:" + usable);
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace solidem
