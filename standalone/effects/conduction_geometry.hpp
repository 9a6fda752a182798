// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CONDUCTION_GEOMETRY_HPP
#define SOLIDEM_EFFECTS_CONDUCTION_GEOMETRY_HPP

#include <map>
#include <string>
#include <vector>

#include "effects/conduction_parameters.hpp"
#include "specimen/tessellation.hpp"

namespace solidem {

/// Where the heat of a pair passes.
struct HeatPath {
  double area;      ///< of transmission, m²
  double distance;  ///< of the centres, m
};

/// What a transmission law makes of a specimen: all that conduction needs to know of it.
struct ConductionGeometry {
  std::vector<double> volume;  ///< that each element stands for, m³
  /// Platonic laws: S_i, m²; bonded elements conduct, through S_ij = sqrt(S_i S_j).
  std::vector<double> transmission_area;
  /// Voronoi: the pairs that share a face, sorted, and its path.
  std::vector<Pair> faces;
  std::vector<HeatPath> face_paths;
  std::map<std::string, std::vector<WallFace>> walls;  ///< faces of the elements on each wall
  double area_factor = 1;  ///< by which the areas of the platonic law were scaled

  HeatPath path(const Specimen& specimen, Pair pair) const;
};

/// The geometry of a law; that of platonic_calibrated is not scaled yet. Throws InputError where
/// the specimen cannot be tessellated.
ConductionGeometry conduction_geometry(ConductionParameters::Law law, const Specimen& specimen);

/// Scales areas by a factor and volumes to those of the bodies.
void calibrate(ConductionGeometry& geometry, double area_factor, const Specimen& specimen);

}  // namespace solidem

#endif
