// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_MODEL_SECONDS_SINCE_HPP
#define SOLIDEM_MODEL_SECONDS_SINCE_HPP

#include <chrono>

namespace solidem {

using Clock = std::chrono::steady_clock;

/// Wall time since a moment, s.
inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace solidem

#endif
