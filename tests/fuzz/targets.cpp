// SPDX-License-Identifier: GPL-2.0-or-later
#include "targets.hpp"

#include <filesystem>

#include "output/read_file.hpp"
#include "specimen/text_formats.hpp"
#include "support/specimens.hpp"

namespace solidem::fuzz {

namespace {

std::vector<std::string> example_scenes() {
  std::vector<std::string> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(SOLIDEM_SOURCE_DIR "/docs/examples"))
    if (entry.path().extension() == ".toml") scenes.push_back(read_file(entry.path().string()));
  return scenes;
}

std::vector<std::string> texts() {
  const Specimen body = crystal("simple_cubic", {2, 2, 1});
  return {'\0' + liggghts_text(body), '\1' + yade_text(body), '\2' + csv_text(body)};
}

}  // namespace

std::vector<Target> targets() {
  const std::string few(40, '\x11'), many(400, '\x23');
  return {{"scene", scene, example_scenes()},
          {"text", text, texts()},
          {"specimen", specimen, {few, many}},
          {"checkpoint", checkpoint, {few, many}}};
}

}  // namespace solidem::fuzz
