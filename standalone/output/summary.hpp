// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a run was and cost, for people and for the tables made from it.
#ifndef SOLIDEM_OUTPUT_SUMMARY_HPP
#define SOLIDEM_OUTPUT_SUMMARY_HPP

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace solidem {

/// The machine that a figure was measured on.
struct Hardware {
  std::string processor;           ///< as the system names it, "unknown" if it does not
  int processors = 0;              ///< that this process may use
  std::uint64_t memory_bytes = 0;  ///< of the machine
  std::string system;              ///< kernel name, release and architecture
};

/// Reads what machine this is; nothing is measured.
Hardware hardware();

/// The largest resident memory of this process so far, bytes.
std::uint64_t peak_memory_bytes();

/// Version of solidem, "major.minor.patch".
std::string version();

/// {"processor", "processors", "memory_bytes", "system"}
nlohmann::ordered_json to_json(const Hardware& hardware);

/// Writes a summary as indented JSON in one step: an error leaves an earlier file as it was.
/// Figures that are not finite become null. RunError names the file and the reason.
void write_summary(const std::string& path, const nlohmann::ordered_json& summary);

}  // namespace solidem

#endif
