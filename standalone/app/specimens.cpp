// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/say.hpp"
#include "output/results_folder.hpp"
#include "scene/body.hpp"
#include "specimen/bonds.hpp"
#include "specimen/report.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem {

void prepare_scene(const std::string& scene_path, const std::string& output, bool overwrite) {
  insist_on_new_file(output, overwrite);
  const Scene scene = read_scene(scene_path);
  // Whether the step is stable is for the run to judge: other codes may take another step.
  const Simulation simulation(scene.setup, make_body(scene), true);
  write_prepared(output, simulation);
  say("{}: {} elements, {} bonds\n", output, simulation.model().elements(),
      simulation.model().slots().bonds());
}

void make_scene_specimen(const std::string& scene_path, const std::string& output, bool overwrite) {
  insist_on_new_file(output, overwrite);
  Specimen body = make_body(read_scene(scene_path));
  measure_specimen(body);
  write_specimen(output, body);
  say("{}\n{}", output, format_report(body));
}

void convert_specimen(const std::string& from, const std::string& to, bool overwrite) {
  insist_on_new_file(to, overwrite);
  Specimen specimen = read_specimen(from);
  write_specimen(to, specimen);
  say("{} -> {}: {} elements, {} bonds\n", from, to, specimen.size(), specimen.bonds.size());
}

void describe_specimen(const std::string& file) {
  Specimen specimen = read_specimen(file);
  if (specimen.bonds.empty()) make_bonds(specimen, 0);
  measure_specimen(specimen);
  say("{}\n{}", file, format_report(specimen));
}

}  // namespace solidem
