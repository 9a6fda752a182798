// SPDX-License-Identifier: GPL-2.0-or-later
//
// The sections of a scene file: one rule each. What they mean is written in docs/scene.md.
#ifndef SOLIDEM_SCENE_SECTIONS_HPP
#define SOLIDEM_SCENE_SECTIONS_HPP

#include <optional>
#include <string>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "effects/setup.hpp"
#include "engine/calibration.hpp"
#include "keys/regions.hpp"
#include "keys/section.hpp"
#include "solve/calibration/orthotropic_calibration.hpp"
#include "specimen/bodies.hpp"

namespace solidem {

/// What a scene simulates; some keys make sense with one effect only.
struct NamedEffects {
  bool motion = false;
  bool heat = false;
  bool expansion = false;
};

// read_specimen.cpp
Rule specimen_section(SpecimenRecipe& recipe, const std::string& scene_file);
/// The same keys and some more.
void read_specimen(const Section& section, SpecimenRecipe& recipe, const std::string& scene_file,
                   const std::vector<Key>& more);
Rule bonds_section(std::optional<double>& tolerance);

// read_bodies.cpp
Rule bodies_section(std::vector<BodyRecipe>& bodies, const std::string& scene_file);

// read_cuts.cpp
Rule cuts_section(std::vector<Cut>& cuts, const std::string& scene_file);

// read_material.cpp
Rule material_section(std::vector<Material>& materials, const NamedRegions& named,
                      NamedEffects effects);

// read_calibration.cpp
Rule calibration_section(std::optional<CalibrationRequest>& calibration,
                         std::optional<OrthotropicRequest>& orthotropic,
                         const std::optional<BeamParameters>& beams);

// read_curve.cpp: [calibration.curve]
Rule curve_section(std::optional<CurveTarget>& target, const double& young_modulus);

// read_orthotropic_calibration.cpp: [calibration] of beams that have a grain
bool asks_for_orthotropic_calibration(const Section& section);
OrthotropicRequest read_orthotropic_calibration(const Section& section,
                                                const std::optional<BeamParameters>& beams);

// read_run.cpp
Rule sensors_section(std::vector<Sensor>& sensors, NamedEffects effects);
Rule gauge_section(std::optional<Gauge>& gauge);
Rule run_section(RunControl& run);
Rule output_section(OutputControl& output);

}  // namespace solidem

#endif
