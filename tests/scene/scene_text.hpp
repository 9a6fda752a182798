// SPDX-License-Identifier: GPL-2.0-or-later
//
// Scenes to start from, and reading a scene from text.
#ifndef SOLIDEM_TESTS_SCENE_SCENE_TEXT_HPP
#define SOLIDEM_TESTS_SCENE_SCENE_TEXT_HPP

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "model/error.hpp"
#include "scene/scene.hpp"

namespace solidem::test {

/// A folder of its own for this process, gone at its end.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("solidem_scene_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

inline const TemporaryFolder& folder() {
  static const TemporaryFolder temporary;
  return temporary;
}

inline Scene read_text_scene(const std::string& text) {
  return read_scene(folder().write("scene.toml", text));
}

/// What reading the scene complains about; empty when it does not.
inline std::string complaint(const std::string& text) {
  try {
    read_text_scene(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// `text` with one part replaced; the part must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the scene has no \"" + from + "\"");
  return text.replace(at, from.size(), to);
}

/// The line, from 1, on which `part` begins.
inline int line_of(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) throw std::logic_error("the scene has no \"" + part + "\"");
  int line = 1;
  for (std::size_t k = 0; k < at; ++k) line += text[k] == '\n' ? 1 : 0;
  return line;
}

inline std::string file_text(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

inline const std::string bar_scene = R"toml(title = "a bar"
[specimen]
shape = "box"
size = ["5 mm", "3 mm", "2 mm"]
elements = 1000
[bonds]
tolerance = 0.05
[material]
density = "2790 kg/m^3"
[beams]
young_modulus = "3.5 TPa"
poisson_ratio = 0.3
radius_ratio = 0.27
[sets]
left = { axis = "x", side = "low", depth = "0.3 mm" }
[[grips]]
name = "left"
region = { set = "left" }
velocity = ["0 m/s", "0 m/s", "0 m/s"]
[[grips]]
name = "right"
region = { axis = "x", side = "high", layers = 1.5 }
velocity = [{ time = ["0 s", "1 ms"], value = ["0 m/s", "2 m/s"] }, "free", "free"]
force = ["free", { mean = "5 N", amplitude = "2 N", frequency = "50 Hz", phase = "90 degree" }, "free"]
rotation = "free"
[[initial_velocities]]
region = { lower = ["1 mm", "any", "any"], upper = ["2 mm", "1 mm", "any"] }
velocity = ["1 m/s", "0 m/s", "-3.3 mm/s"]
[[sensors]]
name = "A"
point = ["1 mm", "-2 mm", "3 mm"]
quantity = "displacement"
[gauge]
axis = "x"
lower = "1.5 mm"
upper = "3.5 mm"
[run]
duration = "1 ms"
time_step_ratio = 0.2
observe_every = 10
[output]
frames = 20
checkpoint_every = 1000
)toml";

inline const std::string heat_scene = R"toml([specimen]
shape = "cylinder"
length = "2 mm"
radius = "0.1 mm"
mean_radius = "9 um"
seed = 7
radius_spread = 0.1
axis = "y"
periodic = [false, true, false]
origin = ["1 mm", "0 m", "-1 mm"]
[material]
density = "2.79 g/cm^3"
specific_heat_capacity = "880 J/(kg °C)"
conductivity = "134 W/(m K)"
[conduction]
law = "platonic"
initial_temperature = "25 °C"
[[temperatures]]
name = "hot"
region = { all = true }
value = "798 K"
[[sensors]]
name = "B"
point = ["1 mm", "0 mm", "0 mm"]
quantity = "temperature"
[run]
steps = 100
time_step = "1 ns"
)toml";

}  // namespace solidem::test

#endif
