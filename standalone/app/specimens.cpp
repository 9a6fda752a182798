// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/notes.hpp"
#include "app/print_json.hpp"
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
  if (specimen.outline != nullptr && format != ".h5")
    notes.push_back(format + " holds no outline: " +
                    (specimen.domain.cuts > 0 ? "where the cuts are" : "the mesh") +
                    " stays behind, without which there are no cells");
  return notes;
}

std::vector<std::string> joined(std::vector<std::string> notes,
                                const std::vector<std::string>& others) {
  notes.insert(notes.end(), others.begin(), others.end());
  return notes;
}

/// Figures that a report lacks, such as those of walls that are not known, are not numbers.
nlohmann::ordered_json json_of(const std::string& file, const Specimen& specimen,
                               const std::vector<std::string>& notes) {
  const Domain& domain = specimen.domain;
  const auto vector = [](const Vector& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
  nlohmann::ordered_json json = {{"file", file},
                                 {"shape", domain.shape},
                                 {"lower", vector(domain.lower)},
                                 {"upper", vector(domain.upper)},
                                 {"periodic", domain.periodic},
                                 {"volume", domain.volume},
                                 {"elements", specimen.size()},
                                 {"bonds", specimen.bonds.size()},
                                 {"bond_tolerance", nullptr},
                                 {"sets", nlohmann::ordered_json::object()},
                                 {"report", specimen.report},
                                 {"notes", notes}};
  if (specimen.bond_tolerance > -1) json["bond_tolerance"] = specimen.bond_tolerance;
  for (const auto& [name, elements] : specimen.sets) json["sets"][name] = elements.size();
  return json;
}

/// The report of a specimen, in words or for programs.
void tell(const std::string& file, const Specimen& specimen, const std::vector<std::string>& notes,
          bool json) {
  if (json) return print_json(json_of(file, specimen, notes));
  say("{}\n{}", file, format_report(specimen));
  print_notes(notes);
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

void prepare_scene(const SpecimenCommand& command) {
  const std::string& output = command.output;
  insist_on_new_file(output, command.overwrite);
  const Scene scene = read_scene(command.scene);
  // Whether the step is stable is for the run to judge: other codes may take another step.
  const Simulation simulation =
      at_places_of(scene, [&] { return Simulation(scene.setup, make_body(scene), true); });
  write_prepared(output, simulation);
  say("{}: {} elements, {} bonds\n", output, simulation.model().elements(),
      simulation.model().slots().bonds());
  print_notes(notes_on(simulation.model().specimen(), simulation.pairs()));
}

void make_scene_specimen(const SpecimenCommand& command) {
  const std::string& output = command.output;
  insist_on_new_file(output, command.overwrite);
  Specimen body = make_body(read_scene(command.scene));
  measure_specimen(body);
  write_specimen(output, body);
  tell(output, body, joined(notes_on(body, body.bonds), notes_on_format(body, output)),
       command.json);
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

void describe_specimen(const std::string& file, bool json) {
  Specimen specimen = read_specimen(file);
  if (specimen.bonds.empty()) make_bonds(specimen, 0, BondImages::several);
  measure_specimen(specimen);
  tell(file, specimen, notes_on(specimen, specimen.bonds), json);
}

}  // namespace solidem
