// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SCENE_SCENE_HPP
#define SOLIDEM_SCENE_SCENE_HPP

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/setup.hpp"
#include "engine/calibration.hpp"
#include "keys/record.hpp"
#include "model/error.hpp"
#include "scene/places.hpp"
#include "solve/calibration/orthotropic_calibration.hpp"
#include "specimen/bodies.hpp"

namespace solidem {

/// What a scene is read from: a file, or text in its place, and what holds instead of values in it.
struct SceneSource {
  std::string path;                 ///< of the file: its name in messages, and where relative paths
                                    ///< in it begin, also where the text is given
  std::optional<std::string> text;  ///< TOML; none: that of the file
  std::vector<std::string> set;     ///< "beams.young_modulus=3 TPa", scene/overrides.hpp

  // A path alone is a source: the usual one.
  SceneSource(std::string file = "") : path(std::move(file)) {}  // NOLINT(*-explicit-*)
  SceneSource(const char* file) : path(file) {}                  // NOLINT(*-explicit-*)
};

/// A scene file, read and validated, in SI units.
struct Scene {
  std::string path;              ///< of the scene file
  std::vector<std::string> set;  ///< what held instead of values in it
  std::string title;             ///< the file's, or its name
  SpecimenRecipe specimen;
  std::vector<BodyRecipe> bodies;        ///< instead of the specimen, of a scene with [[body]]
  std::optional<double> bond_tolerance;  ///< t of [bonds]; none: the specimen file's bonds, or 0
  Setup setup;
  std::optional<CalibrationRequest> calibration;              ///< of [calibration]
  std::optional<OrthotropicRequest> orthotropic_calibration;  ///< of [calibration] with a grain
  Record record;                                              ///< of all that was read
  Places places;                                              ///< of its sections and keys

  bool takes_file() const;  ///< whether the specimen, or one of the bodies, comes from a file
};

/// Reads a scene. Strict: an unknown key, a wrong unit, a missing or an impossible value throws
/// InputError with file, line, key, what was found and what is allowed.
Scene read_scene(const SceneSource& source);

/// Calls what works with things that a scene made: refusals get the place in the scene.
template <class Call>
auto at_places_of(const Scene& scene, const Call& call) {
  try {
    return call();
  } catch (const InputError& error) {
    throw InputError(scene.places.located(error.what()));
  }
}

}  // namespace solidem

#endif
