// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SCENE_SCENE_HPP
#define SOLIDEM_SCENE_SCENE_HPP

#include <string>

#include "effects/setup.hpp"
#include "engine/calibration.hpp"
#include "keys/record.hpp"
#include "solve/calibration/orthotropic_calibration.hpp"
#include "specimen/bodies.hpp"

namespace solidem {

/// A scene file, read and validated, in SI units.
struct Scene {
  std::string path;   ///< of the scene file
  std::string title;  ///< the file's, or its name
  SpecimenRecipe specimen;
  std::vector<BodyRecipe> bodies;        ///< instead of the specimen, of a scene with [[body]]
  std::optional<double> bond_tolerance;  ///< t of [bonds]; none: the specimen file's bonds, or 0
  Setup setup;
  std::optional<CalibrationRequest> calibration;              ///< of [calibration]
  std::optional<OrthotropicRequest> orthotropic_calibration;  ///< of [calibration] with a grain
  Record record;                                              ///< of all that was read

  bool takes_file() const;  ///< whether the specimen, or one of the bodies, comes from a file
};

/// Reads a scene file. Strict: an unknown key, a wrong unit, a missing or an impossible value
/// throws InputError with file, line, key, what was found and what is allowed.
Scene read_scene(const std::string& path);

}  // namespace solidem

#endif
