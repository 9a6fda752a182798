// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/fingerprint.hpp"

#include <algorithm>
#include <sstream>

namespace solidem {

namespace {

/// Whether a value says nothing of the states: what to call the run, how long it is, what to write.
bool is_left_out(const std::string& name) {
  for (const char* free : {"title", "[run] duration", "[run] steps", "[run] observe_every"})
    if (name == free) return true;
  return name.rfind("[output]", 0) == 0;
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

std::string first_difference(const std::string& first, const std::string& second) {
  std::istringstream a(first), b(second);
  std::string line_a, line_b;
  while (true) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) return "";
    if (!more_b) return line_a + ", not given";
    if (!more_a) return "not given, not " + line_b;
    if (line_a == line_b) continue;
    const std::size_t name_end = line_a.find(" = ");
    const bool same_name = name_end != std::string::npos &&
                           line_b.compare(0, name_end + 3, line_a, 0, name_end + 3) == 0;
    return line_a + ", not " + (same_name ? line_b.substr(name_end + 3) : line_b);
  }
}

}  // namespace solidem
