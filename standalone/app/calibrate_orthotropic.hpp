// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_CALIBRATE_ORTHOTROPIC_HPP
#define SOLIDEM_APP_CALIBRATE_ORTHOTROPIC_HPP

#include <string>
#include <vector>

#include "app/say.hpp"
#include "output/results_folder.hpp"
#include "scene/scene.hpp"

namespace solidem {

/// `solidem calibrate` for a scene with orthotropic targets: prints every trial and what is reached
/// beside each target, writes calibrated.toml and calibration.json. The exit status; throws
/// RunError when a target is missed, after all is written.
int calibrate_orthotropic_scene(const Scene& scene, const std::vector<Specimen>& specimens,
                                const std::string& directory, const ResultsFolder& folder,
                                const Voice& tell);

}  // namespace solidem

#endif
