// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/summary.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "output/replace_file.hpp"

namespace solidem {

namespace {

constexpr std::uint64_t kibibyte = 1024;

/// What follows "KEY <tab> :" or "KEY:" in one of the system's tables, empty if KEY is not there.
std::string value_in_table(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::size_t colon = line.find_first_not_of(" \t", key.size());
    if (colon == std::string::npos || line[colon] != ':') continue;
    const std::size_t start = line.find_first_not_of(" \t", colon + 1);
    return start == std::string::npos ? "" : line.substr(start);
  }
  return "";
}

int usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof(set), &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
}

}  // namespace

Hardware hardware() {
  Hardware machine;
  machine.processor = value_in_table("/proc/cpuinfo", "model name");
  if (machine.processor.empty()) machine.processor = "unknown";
  machine.processors = usable_processors();
  machine.memory_bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  utsname name{};
  if (::uname(&name) == 0)
    machine.system = std::string(name.sysname) + ' ' + name.release + ' ' + name.machine;
  return machine;
}

std::uint64_t peak_memory_bytes() {
  // The kernel's table before getrusage: the latter starts from the peak of the program that called
  // us.
  const std::string high_water = value_in_table("/proc/self/status", "VmHWM");
  if (!high_water.empty()) return std::stoull(high_water) * kibibyte;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kibibyte;
}

std::string version() {
  return SOLIDEM_VERSION;
}

nlohmann::ordered_json to_json(const Hardware& hardware) {
  return {{"processor", hardware.processor},
          {"processors", hardware.processors},
          {"memory_bytes", hardware.memory_bytes},
          {"system", hardware.system}};
}

void write_summary(const std::string& path, const nlohmann::ordered_json& summary) {
  // A name in another encoding than UTF-8 must not cost the run its summary.
  replace_text_file(
      path, summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
}

}  // namespace solidem
