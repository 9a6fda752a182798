// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/scene.hpp"

#include <fstream>

#include "bytes.hpp"
#include "model/error.hpp"
#include "scene/fingerprint.hpp"
#include "targets.hpp"

namespace solidem::fuzz {

void scene(std::string_view bytes) {
  const std::string path = file_in_memory(".toml");
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    fingerprint(read_scene(path));
  } catch (const InputError&) {
  }
  std::filesystem::remove(path);
}

}  // namespace solidem::fuzz
