// SPDX-License-Identifier: GPL-2.0-or-later
//
// The sections of a scene file: one rule each. What they mean is written in docs/scene.md.
#ifndef SOLIDEM_SCENE_SECTIONS_HPP
#define SOLIDEM_SCENE_SECTIONS_HPP

#include <optional>
#include <string>
#include <vector>

#include "engine/calibration.hpp"
#include "engine/setup.hpp"
#include "scene/regions.hpp"
#include "scene/section.hpp"
#include "solve/orthotropic_calibration.hpp"
#include "specimen/recipe.hpp"

namespace solidem {

/// What a scene simulates; some keys make sense with one effect only.
struct NamedEffects {
  bool conduction = false;
  bool beams = false;
  bool central_forces = false;
  bool motion() const { return beams || central_forces; }
};

// read_specimen.cpp
Rule specimen_section(SpecimenRecipe& recipe, const std::string& scene_file);
Rule bonds_section(std::optional<double>& tolerance);

// read_effects.cpp
Rule material_section(std::vector<Material>& materials, const NamedRegions& named,
                      NamedEffects effects);
Rule conduction_section(std::optional<ConductionParameters>& conduction);
Rule contacts_section(std::optional<ConductionParameters>& conduction,
                      const std::vector<Material>& materials);

// read_beams.cpp
Rule beams_section(std::optional<BeamParameters>& beams);
Rule plasticity_section(std::optional<PlasticityParameters>& plasticity,
                        const std::optional<BeamParameters>& beams);
Rule rupture_section(std::optional<RuptureParameters>& rupture,
                     const std::optional<BeamParameters>& beams);
Rule contact_section(std::optional<ContactParameters>& contact);

// read_central_forces.cpp
Rule central_forces_section(std::optional<CentralForceParameters>& forces,
                            const std::optional<double>& bond_tolerance);
Rule damage_section(std::optional<DamageParameters>& damage);

// read_anisotropy.cpp: parts of [beams]
Rule anisotropy_section(BeamParameters& beams);
Rule fibres_section(BeamParameters& beams);

// read_calibration.cpp
Rule calibration_section(std::optional<CalibrationRequest>& calibration,
                         std::optional<OrthotropicRequest>& orthotropic,
                         const std::optional<BeamParameters>& beams);

// read_orthotropic_calibration.cpp: [calibration] of beams that have a grain
bool asks_for_orthotropic_calibration(const Section& section);
OrthotropicRequest read_orthotropic_calibration(const Section& section,
                                                const std::optional<BeamParameters>& beams);

// read_loads.cpp
Rule grips_section(std::vector<GripParameters>& grips, const NamedRegions& named);
Rule initial_velocities_section(std::vector<InitialVelocity>& velocities,
                                const NamedRegions& named);

// read_heat_loads.cpp
Rule temperatures_section(std::vector<ImposedTemperatureParameters>& temperatures,
                          const NamedRegions& named);
Rule heat_fluxes_section(std::vector<HeatFluxParameters>& fluxes);
Rule convections_section(std::vector<ConvectionParameters>& convections);
Rule heat_sources_section(std::vector<HeatSourceParameters>& sources, const NamedRegions& named);

// read_run.cpp
Rule sensors_section(std::vector<Sensor>& sensors, NamedEffects effects);
Rule gauge_section(std::optional<Gauge>& gauge);
Rule run_section(RunControl& run);
Rule output_section(OutputControl& output);

}  // namespace solidem

#endif
