// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/error.hpp"
#include "specimen/specimen_file.hpp"
#include "specimen/text_formats.hpp"
#include "targets.hpp"

namespace solidem::fuzz {

void text(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::string content(bytes.substr(1));
  try {
    const int format = bytes[0] % 3;
    const Specimen specimen = format == 0   ? specimen_of_liggghts_text(content, "a.data")
                              : format == 1 ? specimen_of_yade_text(content, "a.txt")
                                            : specimen_of_csv_text(content, "a.csv");
    check_specimen(specimen, "fuzzed");
  } catch (const InputError&) {
  }
}

}  // namespace solidem::fuzz
