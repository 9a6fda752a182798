// SPDX-License-Identifier: GPL-2.0-or-later
//
// Small specimens for tests.
#ifndef SOLIDEM_TESTS_SUPPORT_SPECIMENS_HPP
#define SOLIDEM_TESTS_SUPPORT_SPECIMENS_HPP

#include <stdexcept>
#include <string>

#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "engine/simulation.hpp"
#include "specimen/bonds.hpp"
#include "specimen/ordering.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

/// A crystal of touching spheres of radius 0.1 mm.
inline Specimen crystal(const std::string& lattice, std::array<int, 3> cells,
                        std::array<bool, 3> periodic = {false, false, false}) {
  SpecimenRecipe recipe;
  recipe.shape = "crystal";
  recipe.lattice = lattice;
  recipe.cells = cells;
  recipe.element_radius = 1e-4;
  recipe.periodic = periodic;
  return make_specimen(recipe);
}

/// A crystal whose centres are moved and radii changed a little, the same way every time.
inline Specimen jittered(const std::string& lattice, std::array<int, 3> cells,
                         double fraction = 0.1) {
  Specimen specimen = crystal(lattice, cells);
  std::uint64_t state = 12345;
  const auto random = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state >> 40) / double(1 << 23) - 1;
  };
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    specimen.position[i] += (fraction * 1e-4) * Vector{random(), random(), random()};
    specimen.radius[i] *= 1 + 0.5 * fraction * random();
  }
  return specimen;  // bonds stay those of the crystal
}

/// A material, of all elements unless a region is given.
inline Material material_of(double density, double specific_heat, double conductivity,
                            const Region& region = {}, const std::string& name = "") {
  Material material;
  material.region = region;
  material.density = density;
  material.specific_heat = specific_heat;
  material.conductivity = conductivity;
  material.name = name;
  return material;
}

/// Aluminium, elastic beams.
inline Setup elastic_setup() {
  Setup setup;
  setup.materials.push_back(material_of(2790, 880, 134));
  BeamParameters beams;
  beams.young_modulus = 3.5e12;
  beams.shear_modulus = 1.35e12;
  beams.radius_ratio = 0.27;
  setup.get<BeamParameters>() = beams;
  setup.run.steps = 0;
  return setup;
}

/// Aluminium at 298 K, conduction only.
inline Setup thermal_setup() {
  Setup setup;
  setup.materials.push_back(material_of(2790, 880, 134));
  setup.get<ConductionParameters>() = ConductionParameters{};
  setup.get<ConductionParameters>()->initial_temperature = 298;
  setup.run.steps = 0;
  return setup;
}

/// A layer of elements at one face.
inline Region face(int axis, bool high_side, double layers = 1) {
  Region region;
  region.kind = Region::Kind::face;
  region.axis = axis;
  region.high_side = high_side;
  region.layers = layers;
  return region;
}

/// Value of a history row by its name.
inline double value_of(const HistoryRow& row, const std::string& name) {
  for (const auto& [key, value] : row.values)
    if (key == name) return value;
  throw std::out_of_range(name);
}

}  // namespace solidem

#endif
