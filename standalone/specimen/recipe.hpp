// SPDX-License-Identifier: GPL-2.0-or-later
//
// How a specimen comes to be: read from a file, built as a crystal, or packed into a shape.
#ifndef SOLIDEM_SPECIMEN_RECIPE_HPP
#define SOLIDEM_SPECIMEN_RECIPE_HPP

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/specimen.hpp"
#include "specimen/cut.hpp"

namespace solidem {

/// What a user asks for; lengths in m. Members that the shape does not name are ignored.
struct SpecimenRecipe {
  std::string file;   ///< a specimen file to read; then nothing counts but its body's shape, or
  double volume = 0;  ///< its volume, where the file tells neither, m³
  std::string shape;  ///< box, plate, cylinder, annulus, wedge, sphere, mesh or crystal

  Vector size{};      ///< box: extents along x, y, z; plate: length (x), width (y), thickness (z)
  double length = 0;  ///< round shapes (cylinder, annulus, wedge): along the axis
  double radius = 0;  ///< round shapes: outer radius; sphere
  double inner_radius = 0;  ///< annulus and wedge
  double angle = 0;         ///< wedge, rad, below π: a sector of an annulus, see Domain::angle
  std::string axis = "x";   ///< round shapes: x, y or z

  std::string lattice;                ///< crystal: simple_cubic, bcc, fcc or hcp; neighbours touch
  std::array<int, 3> cells{0, 0, 0};  ///< crystal: unit cells along x, y, z
  double element_radius = 0;          ///< crystal: radius of every sphere

  std::string mesh;      ///< mesh: file of its closed surface
  double mesh_unit = 0;  ///< mesh: length of one unit of the file, m

  std::int64_t elements = 0;     ///< packing: how many spheres; or, when 0, from
  double mean_radius = 0;        ///< packing: the mean radius R_m; exactly one of the two is given
  std::uint64_t seed = 1;        ///< packing: same seed, same specimen, on any number of threads
  double radius_spread = 0.125;  ///< packing: radii uniform in R_m (1 ± spread), 0 ≤ spread ≤ 0.5

  /// Directions without walls, where the body repeats itself. Crystals and packed boxes and plates:
  /// any; round shapes: along the axis only.
  std::array<bool, 3> periodic{false, false, false};
  /// Lower corner of box, plate and crystal; the axis' low end of round shapes; a sphere's centre;
  /// where the origin of a mesh's file is put.
  Vector origin{};
  std::vector<Cut> cuts;  ///< taken out of the body once it is made
};

/// Told how far a long task is: fraction done in [0, 1] and what is being done. May be empty.
using ReportProgress = std::function<void(double fraction, const std::string& doing)>;

/// Makes the specimen a recipe asks for: ordered, with the bonds of elements in contact (tolerance
/// 0) and its report; a file is taken as it is. Throws InputError when the recipe is incomplete or
/// asks for the impossible.
Specimen make_specimen(const SpecimenRecipe& recipe, const ReportProgress& progress = {});

}  // namespace solidem

#endif
