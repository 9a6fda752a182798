// SPDX-License-Identifier: GPL-2.0-or-later
//
// What the micro-benchmarks share: a cube of elements that stretches or shrinks, and the
// processor's time.
#ifndef SOLIDEM_BENCHMARKS_STRETCHED_CUBE_HPP
#define SOLIDEM_BENCHMARKS_STRETCHED_CUBE_HPP

#include <time.h>

#include <string>

#include "scene/scene.hpp"

namespace solidem {

/// A cube with these sections beside. `rate`: at which it stretches when it begins, 1/s.
inline Scene stretched_cube(const std::string& sections, const std::string& elements, double rate) {
  const std::string each = '"' + std::to_string(rate) + " 1/s\"";
  SceneSource source("cube.toml");
  source.text =
      "[specimen]\nshape = \"box\"\nsize = [\"10 mm\", \"10 mm\", \"10 mm\"]\nelements = " +
      elements + "\n[material]\ndensity = \"2790 kg/m^3\"\n" + sections +
      "[[initial_velocities]]\nregion = { all = true }\nstretching = [" + each + ", " + each +
      ", " + each + "]\n[run]\nsteps = 1000000\n";
  return read_scene(source);
}

/// Seconds that this thread has had of the processor, so that a busy machine disturbs little.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace solidem

#endif
