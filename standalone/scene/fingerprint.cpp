// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/fingerprint.hpp"

#include <algorithm>

namespace solidem {

namespace {

/// Whether a value says nothing of the states: what to call the run, how long it is, what to write.
/// What is said of the time step shows in the time step itself.
bool is_left_out(const std::string& name) {
  return name == "title" || name.rfind("[run] ", 0) == 0 || name.rfind("[output]", 0) == 0;
}

/// "[beams] young_modulus" as "beams.young_modulus".
std::string dotted(std::string name) {
  name.erase(std::remove(name.begin(), name.end(), '['), name.end());
  name.erase(std::remove(name.begin(), name.end(), ']'), name.end());
  std::replace(name.begin(), name.end(), ' ', '.');
  return name;
}

}  // namespace

std::string fingerprint(const Scene& scene) {
  std::string lines;
  for (const auto& [name, value] : scene.record)
    if (!is_left_out(name)) lines += dotted(name) + " = " + value + "\n";
  return lines;
}

}  // namespace solidem
