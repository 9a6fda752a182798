// SPDX-License-Identifier: GPL-2.0-or-later
//
// Writes the good inputs that fuzzing starts from: write_seeds FOLDER makes FOLDER/TARGET/0, 1 ...
#include <filesystem>
#include <fstream>

#include "fuzz/targets.hpp"

int main(int, char** words) {
  for (const solidem::fuzz::Target& target : solidem::fuzz::targets()) {
    const std::filesystem::path folder = std::filesystem::path(words[1]) / target.name;
    std::filesystem::create_directories(folder);
    for (std::size_t k = 0; k < target.seeds.size(); ++k)
      std::ofstream(folder / std::to_string(k), std::ios::binary) << target.seeds[k];
  }
}
