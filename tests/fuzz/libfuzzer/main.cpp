// SPDX-License-Identifier: GPL-2.0-or-later
//
// One of the targets, FUZZ_TARGET, for libFuzzer.
#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  solidem::fuzz::FUZZ_TARGET({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
