// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_BUILD_DETAILS_HPP
#define SOLIDEM_APP_BUILD_DETAILS_HPP

#include <string>

namespace solidem {

/// "0.1.0 (commit 0a1b2c3, g++ 12.2.0, Release; kernels baseline, x86_64_v3, x86_64_v4)". The
/// commit is that of the sources when they were built, "-dirty" with changes; not every copy of
/// the sources knows its own.
std::string version_and_build();

}  // namespace solidem

#endif
