// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/build_details.hpp"

#include "build_commit.hpp"
#include "effects/kernels/kernels.hpp"
#include "output/summary.hpp"

namespace solidem {

namespace {

std::string compiler() {
#if defined(__clang__)
  return "clang " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__);
#else
  return "g++ " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__);
#endif
}

}  // namespace

std::string version_and_build() {
  const std::string commit = SOLIDEM_COMMIT;
  std::string sets;
  for (const Kernels* kernels : usable_kernels())
    sets += (sets.empty() ? "" : ", ") + std::string(kernels->instruction_set);
  return version() + " (" + (commit.empty() ? "" : "commit " + commit + ", ") + compiler() + ", " +
         SOLIDEM_BUILD_TYPE + "; instruction sets here: " + sets + ")";
}

}  // namespace solidem
