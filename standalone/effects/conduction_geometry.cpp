// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/conduction_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "effects/conduction_parameters.hpp"
#include "laws/platonic_conduction.hpp"
#include "model/error.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

namespace {

ConductionGeometry platonic_geometry(const Specimen& specimen) {
  ConductionGeometry geometry;
  const std::vector<std::int32_t> neighbours = count_bonds(specimen);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const PlatonicElement element{specimen.radius[i], static_cast<double>(neighbours[i])};
    geometry.volume.push_back(platonic_heat_capacity(element, 1, 1));
    geometry.transmission_area.push_back(platonic_transmission_area(element, element));
  }
  geometry.walls = touching_elements(specimen);
  return geometry;
}

void insist_on_bodies_apart(const Specimen& specimen) {
  for (const Body& body : specimen.bodies)
    for (const std::int32_t other : body.bonded_to)
      throw InputError("[conduction] law = \"voronoi\": the cells of [[body]] \"" + body.name +
                       "\" and of \"" + specimen.bodies[static_cast<std::size_t>(other)].name +
                       "\", which it is bonded_to, share no faces that would conduct; expected a "
                       "platonic law, or bodies that are not bonded");
}

Tessellation cells_of(const Specimen& specimen) {
  try {
    return tessellate(specimen);
  } catch (const InputError& error) {
    throw InputError(std::string("[conduction] law = \"voronoi\": ") + error.what());
  }
}

ConductionGeometry voronoi_geometry(const Specimen& specimen) {
  insist_on_bodies_apart(specimen);
  Tessellation cells = cells_of(specimen);
  ConductionGeometry geometry;
  geometry.volume = std::move(cells.volume);
  geometry.faces = std::move(cells.faces);
  for (std::size_t k = 0; k < geometry.faces.size(); ++k)
    geometry.face_paths.push_back({cells.area[k], cells.distance[k]});
  geometry.walls = std::move(cells.walls);
  return geometry;
}

}  // namespace

HeatPath ConductionGeometry::path(const Specimen& specimen, Pair pair) const {
  if (!transmission_area.empty())
    return {std::sqrt(transmission_area[static_cast<std::size_t>(pair.i)] *
                      transmission_area[static_cast<std::size_t>(pair.j)]),
            norm(rest_chord(specimen, pair))};
  const auto found = std::lower_bound(faces.begin(), faces.end(), pair);
  return face_paths[static_cast<std::size_t>(found - faces.begin())];
}

ConductionGeometry conduction_geometry(ConductionParameters::Law law, const Specimen& specimen) {
  return law == ConductionParameters::Law::voronoi ? voronoi_geometry(specimen)
                                                   : platonic_geometry(specimen);
}

namespace {

/// Scales the volumes of some elements so that they sum to another one.
template <class Elements>
void fill(std::vector<double>& volume, const Elements& elements, double whole) {
  double sum = 0;
  for (const auto i : elements) sum += volume[static_cast<std::size_t>(i)];
  for (const auto i : elements) volume[static_cast<std::size_t>(i)] *= whole / sum;
}

}  // namespace

void calibrate(ConductionGeometry& geometry, double area_factor, const Specimen& specimen) {
  geometry.area_factor *= area_factor;
  for (double& area : geometry.transmission_area) area *= area_factor;
  std::vector<std::size_t> all(specimen.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (specimen.bodies.empty()) fill(geometry.volume, all, specimen.domain.volume);
  for (const Body& body : specimen.bodies) fill(geometry.volume, body.elements, body.volume);
}

}  // namespace solidem
