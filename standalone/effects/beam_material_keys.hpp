// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[beams.material]] and [[beams.interface]].
#ifndef SOLIDEM_EFFECTS_BEAM_MATERIAL_KEYS_HPP
#define SOLIDEM_EFFECTS_BEAM_MATERIAL_KEYS_HPP

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "keys/regions.hpp"

namespace solidem {

Rule beam_materials_section(BeamParameters& beams, const NamedRegions& regions);
Rule beam_interfaces_section(BeamParameters& beams);

/// The keys of each, for the pages. `yield_stress`: it stands for a yield strain times E, Pa.
std::vector<Key> beam_material_keys(BeamMaterial& material, std::optional<double>& yield_stress,
                                    std::set<std::string>& taken, const NamedRegions& regions);
std::vector<Key> beam_interface_keys(BeamInterface& interface, std::optional<double>& yield_stress,
                                     std::vector<std::string>& between);

/// Works out what hangs on [beams] as a whole, and refuses what does not go together with it.
void finish_beam_materials(const Section& beams_section, BeamParameters& beams);

/// Throws InputError where one states a limit and no law says what it is a limit of.
void check_limits_of_materials(const BeamParameters& beams, bool has_plasticity, bool has_rupture);

/// What `solidem explain --json` says of them.
void explain_beam_materials(const BeamParameters& beams, nlohmann::ordered_json& json);

}  // namespace solidem

#endif
