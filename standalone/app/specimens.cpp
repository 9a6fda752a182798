// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <filesystem>

#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/say.hpp"
#include "output/results_folder.hpp"
#include "scene/body.hpp"
#include "specimen/bonds.hpp"
#include "specimen/pieces.hpp"
#include "specimen/report.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem {

namespace {

/// What a format of text does not hold.
std::vector<std::string> notes_on_format(const Specimen& specimen, const std::string& path) {
  const std::string format = std::filesystem::path(path).extension().string();
  const bool keeps_bonds = format == ".h5" || format == ".data";
  std::vector<std::string> notes;
  if (!specimen.bonds.empty() && !keeps_bonds)
    notes.push_back(
        fmt::format("{} holds no bonds: {} stay behind", format, specimen.bonds.size()));
  if (!specimen.sets.empty() && format != ".h5")
    notes.push_back(fmt::format("{} holds no sets: {} stay behind", format, specimen.sets.size()));
  return notes;
}

}  // namespace

std::string specimen_formats() {
  return R"(The ending of a file says its format. All numbers are in SI units.
  .h5    specimen of solidem (HDF5): everything
  .data  data file of LIGGGHTS and LAMMPS (units = si): spheres and bonds.
         Read: "Atoms # STYLE" with sphere or granular (id type diameter density x y z),
         bpm/sphere (id molecule type diameter density x y z), or a hybrid such as
         "hybrid bond sphere" (id type x y z, then what each style adds); image flags may
         follow. Without a style: seven values are granular, eight hybrid granular molecular
         (id type x y z diameter density molecule), which is what is written. Periodic sides:
         "boundary p p f" in the title or a comment.
  .txt   YADE: x y z r a line, or as "#format" says (x_y_z_r, x_y_z_r_clumpId, x_y_z_r_matId,
         id_x_y_z_r_matId, x_y_z_r_attrs); "##PERIODIC:: X Y Z" is a periodic cell from 0
  .csv   header x,y,z,radius
Text written by solidem tells the body in comments ("# solidem shape cylinder"); spheres of other
files have the volume of their cells, cut at the spheres, and no walls, unless the scene says more
([specimen] volume, or shape and its measures).)";
}

void prepare_scene(const std::string& scene_path, const std::string& output, bool overwrite) {
  insist_on_new_file(output, overwrite);
  const Scene scene = read_scene(scene_path);
  // Whether the step is stable is for the run to judge: other codes may take another step.
  const Simulation simulation(scene.setup, make_body(scene), true);
  write_prepared(output, simulation);
  say("{}: {} elements, {} bonds\n", output, simulation.model().elements(),
      simulation.model().slots().bonds());
  print_notes(notes_on(simulation.model().specimen(), simulation.pairs()));
}

void make_scene_specimen(const std::string& scene_path, const std::string& output, bool overwrite) {
  insist_on_new_file(output, overwrite);
  Specimen body = make_body(read_scene(scene_path));
  measure_specimen(body);
  write_specimen(output, body);
  say("{}\n{}", output, format_report(body));
  print_notes(notes_on(body, body.bonds));
  print_notes(notes_on_format(body, output));
}

void convert_specimen(const std::string& from, const std::string& to, bool overwrite) {
  insist_on_new_file(to, overwrite);
  Specimen specimen = read_specimen(from);
  write_specimen(to, specimen);
  say("{} -> {}: {} elements, {} bonds\n", from, to, specimen.size(), specimen.bonds.size());
  print_notes(notes_on_format(specimen, to));
  if (specimen.bonds.empty()) make_bonds(specimen, 0, BondImages::several);
  print_notes(notes_on(specimen, specimen.bonds));
}

void describe_specimen(const std::string& file) {
  Specimen specimen = read_specimen(file);
  if (specimen.bonds.empty()) make_bonds(specimen, 0, BondImages::several);
  measure_specimen(specimen);
  say("{}\n{}", file, format_report(specimen));
  print_notes(notes_on(specimen, specimen.bonds));
}

}  // namespace solidem
