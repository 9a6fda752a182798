// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/body.hpp"

#include <algorithm>

#include "laws/platonic_conduction.hpp"
#include "laws/rigid_sphere.hpp"
#include "output/hdf5.hpp"
#include "specimen/bonds.hpp"
#include "specimen/report.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem {

Specimen make_body(const Scene& scene, const ReportProgress& progress) {
  Specimen specimen = make_specimen(scene.specimen, progress);
  const bool from_file = !scene.specimen.file.empty();
  if (scene.bond_tolerance) {
    if (specimen.bond_tolerance != *scene.bond_tolerance)
      make_bonds(specimen, *scene.bond_tolerance);
  } else if (!from_file || specimen.bonds.empty()) {
    make_bonds(specimen, 0);
  }
  return specimen;
}

void write_prepared(const std::string& path, const Simulation& simulation) {
  const Model& model = simulation.model();
  Specimen specimen = model.specimen();
  specimen.bonds = model.slots().pairs();
  for (const auto& [name, elements] : simulation.selections()) specimen.sets[name] = elements;
  measure_specimen(specimen);
  write_specimen(path, specimen);
  if (path.size() < 3 || path.substr(path.size() - 3) != ".h5") return;

  Hdf5File file = Hdf5File::open_for_writing(path);
  const std::size_t elements = model.elements();
  std::vector<double> first(elements), second(elements);
  if (model.has(columns::inverse_mass)) {
    const Hdf5Group mechanics = file.make_group("mechanics");
    for (std::size_t i = 0; i < elements; ++i) {
      first[i] = 1 / model.data(columns::inverse_mass)[i];
      second[i] = 1 / model.data(columns::inverse_inertia)[i];
    }
    mechanics.write("mass", first);
    mechanics.write("inertia", second);
  }
  if (model.has(columns::inverse_heat_capacity)) {
    const Hdf5Group conduction = file.make_group("conduction");
    const std::vector<int> coordination = model.slots().coordination();
    for (std::size_t i = 0; i < elements; ++i) {
      const PlatonicElement element{specimen.radius[i], static_cast<double>(coordination[i])};
      first[i] = platonic_transmission_area(element, element);
      second[i] = 1 / model.data(columns::inverse_heat_capacity)[i];
    }
    conduction.write("transmission_area", first);
    conduction.write("heat_capacity", second);
  }
  file.close();
}

}  // namespace solidem
