// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/body.hpp"

#include <algorithm>

#include "effects/beam_parameters.hpp"
#include "effects/beams.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/central_forces.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "effects/tools.hpp"
#include "engine/heat.hpp"
#include "laws/rigid_sphere.hpp"
#include "output/hdf5.hpp"
#include "specimen/bonds.hpp"
#include "specimen/ordering.hpp"
#include "specimen/report.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem {

namespace {

Specimen body_of(const Scene& scene, const ReportProgress& progress) {
  Specimen specimen = scene.bodies.empty() ? make_specimen(scene.specimen, progress)
                                           : make_bodies(scene.bodies, progress);
  const bool from_file = scene.takes_file();
  if (const auto& forces = scene.setup.get<CentralForceParameters>()) {
    if (!specimen.bodies.empty()) check_apart(specimen, forces->range);
    // The neighbours at the start; in a small cell there may be several images of one.
    make_bonds(specimen, scene.setup.get<CentralForceParameters>()->bond_tolerance,
               BondImages::several);
    // There are more of them than contacts, and blocks are full where numbers of them are alike.
    if (!from_file) sort_elements(specimen);
  } else if (scene.bond_tolerance) {
    if (specimen.bond_tolerance != *scene.bond_tolerance)
      make_bonds(specimen, *scene.bond_tolerance);
  } else if (!from_file || specimen.bonds.empty()) {
    make_bonds(specimen, 0);
  }
  const auto& beams = scene.setup.get<BeamParameters>();
  if (beams && beams->fibres) {
    add_fibres(specimen, beams->fibres->rule);
    measure_specimen(specimen);
  }
  return specimen;
}

}  // namespace

Specimen make_body(const Scene& scene, const ReportProgress& progress) {
  return at_places_of(scene, [&] { return body_of(scene, progress); });
}

namespace {

/// Velocities that elements start with, where some do.
void write_velocities(const Hdf5Group& mechanics, const Model& model) {
  std::vector<double> velocity;
  for (std::size_t i = 0; i < model.elements(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      velocity.push_back(model.data(columns::velocity)[Model::at(columns::velocity, i, axis)]);
  mechanics.write("velocity", velocity.data(), {model.elements(), 3});
}

/// Masses and moments of inertia of all elements, and velocities at the start; rigidity, radius and
/// G / E of all beams, in the order of the bonds.
void write_mechanics(const Hdf5File& file, const Simulation& simulation) {
  const Model& model = simulation.model();
  const Hdf5Group mechanics = file.make_group("mechanics");
  const std::vector<double>& radius = model.specimen().radius;
  std::vector<double> mass, inertia;
  for (std::size_t i = 0; i < model.elements(); ++i) {
    mass.push_back(1 / model.data(columns::inverse_mass)[i]);
    inertia.push_back(sphere_inertia(mass[i], radius[i]));
  }
  mechanics.write("mass", mass);
  if (!simulation.setup().all<InitialVelocity>().empty()) write_velocities(mechanics, model);
  if (simulation.find<CentralForces>() != nullptr) return;
  mechanics.write("inertia", inertia);
  if (simulation.find<Beams>() == nullptr) return;

  const BeamProperties& properties = simulation.find<Beams>()->properties();
  std::vector<double> rigidity, beam_radius, shear_ratio;
  const std::vector<Pair> pairs = model.slots().pairs();
  for (const Pair& pair : pairs) {
    const BeamSection<double> section = properties.section(model.specimen(), pair);
    const BeamRigidity<double> stiffness =
        properties.rigidity(section, norm(rest_chord(model.specimen(), pair)));
    rigidity.insert(rigidity.end(),
                    {stiffness.axial, stiffness.bending, stiffness.shear, stiffness.torsion});
    beam_radius.push_back(section.radius);
    shear_ratio.push_back(section.shear_modulus / section.young_modulus);
  }
  mechanics.write("rigidity", rigidity.data(), {pairs.size(), 4});
  mechanics.write("radius", beam_radius);
  mechanics.write("shear_ratio", shear_ratio);
}

std::vector<double> of_all(const std::vector<ElementValue>& values,
                           std::vector<std::int32_t>& elements) {
  std::vector<double> result;
  elements.clear();
  for (const ElementValue& value : values) {
    elements.push_back(value.element);
    result.push_back(value.value);
  }
  return result;
}

/// What conducts and heats, for codes that do not compute it themselves: in the order of the pairs
/// that conduct.
void write_conduction(const Hdf5File& file, const Simulation& simulation) {
  const Model& model = simulation.model();
  const Heat& heat = *simulation.heat();
  const std::vector<Pair> pairs = model.conductors().pairs();
  Specimen conducting = model.specimen();
  conducting.bonds = pairs;
  const ConductionGeometry geometry = scaled_geometry(
      *simulation.setup().get<ConductionParameters>(), conducting, heat.area_factor());
  const double* temperature = model.data(columns::temperature);
  std::vector<double> area, distance, conductance(pairs.size());
  std::vector<std::int32_t> numbers;
  for (const Pair& pair : pairs) {
    const HeatPath path = geometry.path(model.specimen(), pair);
    area.push_back(path.area);
    distance.push_back(path.distance);
    numbers.insert(numbers.end(), {pair.i, pair.j});
  }
  heat.conduction().for_each_conductance(
      model, temperature, [&](std::int32_t i, std::int32_t j, double value) {
        const auto at = std::lower_bound(pairs.begin(), pairs.end(), Pair{i, j}) - pairs.begin();
        conductance[static_cast<std::size_t>(at)] = value;
      });
  std::vector<double> capacity;
  for (std::size_t i = 0; i < model.elements(); ++i)
    capacity.push_back(1 / model.data(columns::inverse_heat_capacity)[i]);

  const Hdf5Group group = file.make_group("conduction");
  group.set_attribute("law", name_of(simulation.setup().get<ConductionParameters>()->law));
  group.set_attribute("area_factor", geometry.area_factor);
  group.write("pairs", numbers.data(), {pairs.size(), 2});
  group.write("area", area);
  group.write("distance", distance);
  group.write("conductance", conductance);
  group.write("heat_capacity", capacity);
  group.write("volume", geometry.volume);
  if (!geometry.transmission_area.empty())
    group.write("transmission_area", geometry.transmission_area);
  const Hdf5Group exchanges = group.make_group("exchanges"), powers = group.make_group("powers");
  for (const HeatLoad* load : heat.loads()) {
    std::vector<ElementValue> values;
    load->conductances(0, temperature, values);
    const bool exchanged = !values.empty();
    if (!exchanged) load->powers(0, temperature, values);
    std::vector<std::int32_t> elements;
    const std::vector<double> figures = of_all(values, elements);
    const Hdf5Group own = (exchanged ? exchanges : powers).make_group(load->column());
    own.write("elements", elements);
    own.write(exchanged ? "conductance" : "power", figures);
  }
}

/// Surfaces of tools at the start.
void write_tools(const Hdf5File& file, const Simulation& simulation) {
  if (simulation.find<Tool>() == nullptr) return;
  const Hdf5Group group = file.make_group("tools");
  for (const auto& effect : simulation.effects()) {
    const auto* tool = dynamic_cast<const Tool*>(effect.get());
    if (tool == nullptr) continue;
    const TriangleMesh mesh = tool->surface(simulation.model());
    std::vector<double> vertices;
    for (const Vector& v : mesh.vertices) vertices.insert(vertices.end(), {v.x, v.y, v.z});
    std::vector<std::int32_t> facets;
    for (const auto& facet : mesh.facets) facets.insert(facets.end(), facet.begin(), facet.end());
    const Hdf5Group own = group.make_group(tool->name());
    own.write("vertices", vertices.data(), {mesh.vertices.size(), 3});
    own.write("facets", facets.data(), {mesh.facets.size(), 3});
  }
}

}  // namespace

void write_prepared(const std::string& path, const Simulation& simulation) {
  const Model& model = simulation.model();
  Specimen specimen = model.specimen();
  specimen.bonds = simulation.pairs();
  for (const auto& [name, elements] : simulation.selections()) specimen.sets[name] = elements;
  measure_specimen(specimen);
  if (path.size() < 3 || path.substr(path.size() - 3) != ".h5")
    return write_specimen(path, specimen);
  check_specimen(specimen, "specimen for " + path);
  replace_hdf5_file(
      path,
      [&](const Hdf5File& file) {
        put_specimen(file, specimen);
        if (model.has(columns::inverse_mass)) write_mechanics(file, simulation);
        write_tools(file, simulation);
        if (model.has(columns::inverse_heat_capacity)) write_conduction(file, simulation);
      },
      Seal::present);
}

}  // namespace solidem
