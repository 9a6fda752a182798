// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_kernels.h"

#include <stdlib.h>
#include <string.h>

namespace LAMMPS_NS {

namespace baseline {
extern const SolidemKernels kernels;
}
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
namespace x86_64_v3 {
extern const SolidemKernels kernels;
}
namespace x86_64_v4 {
extern const SolidemKernels kernels;
}
#endif

namespace {

const SolidemKernels& choose() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  const char* asked = getenv("SOLIDEM_INSTRUCTION_SET");
  const auto wanted = [asked](const char* set) { return !asked || strcmp(asked, set) == 0; };
  if (wanted("x86_64_v4") && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd"))
    return x86_64_v4::kernels;
  if ((wanted("x86_64_v3") || wanted("x86_64_v4")) && __builtin_cpu_supports("avx2") &&
      __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return x86_64_v3::kernels;
#endif
  return baseline::kernels;
}

}  // namespace

const SolidemKernels& solidem_kernels() {
  static const SolidemKernels& chosen = choose();
  return chosen;
}

}  // namespace LAMMPS_NS
