// SPDX-License-Identifier: GPL-2.0-or-later
//
// What is fuzzed: each takes any bytes for one kind of input. An input is either refused with an
// InputError (a RunError, where it runs) or good; anything else ends the program.
#ifndef SOLIDEM_TESTS_FUZZ_TARGETS_HPP
#define SOLIDEM_TESTS_FUZZ_TARGETS_HPP

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace solidem::fuzz {

/// A scene file.
void scene(std::string_view bytes);
/// A specimen as text: the first byte chooses LIGGGHTS, YADE or CSV.
void text(std::string_view bytes);
/// Data and attributes of a specimen file.
void specimen(std::string_view bytes);
/// What a checkpoint holds, behind its seal: some numbers of a good one are replaced.
void checkpoint(std::string_view bytes);

struct Target {
  const char* name;
  void (*run)(std::string_view bytes);
  std::vector<std::string> seeds;  ///< good inputs, to start from
};

/// All of them, with inputs to start from.
std::vector<Target> targets();

}  // namespace solidem::fuzz

#endif
