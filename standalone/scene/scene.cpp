// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/scene.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "model/error.hpp"
#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

std::string read_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw InputError(path + ": no such file; expected a scene file (TOML)");
  if (std::filesystem::is_directory(path, error))
    throw InputError(path + ": a folder; expected a scene file (TOML)");
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  if (stream) content << stream.rdbuf();
  if (!stream || (content.str().empty() && stream.bad()))
    throw InputError(path + ": cannot be read; expected a scene file (TOML) with read permission");
  return content.str();
}

toml::table parse(const std::string& content, const std::string& path) {
  try {
    return toml::parse(content, path);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw InputError(path + ":" + std::to_string(at.line) + ": column " +
                     std::to_string(at.column) + ": not TOML: " + std::string(error.description()));
  }
}

/// A scene without effects is a recipe for a specimen and no more.
void check_effects(const Section& root, NamedEffects effects) {
  const auto refuse_all = [&root](const std::vector<std::string>& keys, const std::string& problem,
                                  const std::string& expected) {
    for (const std::string& key : keys)
      if (root.has(key)) root.refuse(key, problem, expected);
  };
  if (!effects.motion() && !effects.conduction)
    refuse_all({"material", "plasticity", "rupture", "contact", "damage", "contacts", "grips",
                "temperatures", "heat_fluxes", "convections", "heat_sources", "initial_velocities",
                "sensors", "gauge", "calibration", "run", "output"},
               "the scene has no effect", "a section [beams], [central_forces] or [conduction]");
  if (effects.beams && effects.central_forces)
    root.refuse("central_forces", "beams act between the same elements",
                "either [beams] or [central_forces]");
  if (!effects.motion())
    refuse_all({"grips", "initial_velocities", "gauge"}, "nothing moves",
               "a section [beams] or [central_forces]");
  if (!effects.beams)
    refuse_all({"plasticity", "rupture", "contact", "calibration"}, "there are no beams",
               "a section [beams]");
  if (!effects.central_forces)
    refuse_all({"damage"}, "there are no central forces", "a section [central_forces]");
  if (root.has("contact") && !root.has("rupture"))
    root.refuse("contact", "no bond ever breaks", "a section [rupture] beside it");
  if (!effects.conduction)
    refuse_all({"contacts", "temperatures", "heat_fluxes", "convections", "heat_sources"},
               "nothing conducts heat", "a section [conduction]");
}

}  // namespace

Scene read_scene(const std::string& path) {
  const std::string content = read_file(path);
  const toml::table file = parse(content, path);
  if (file.empty())
    throw InputError(path +
                     ": empty; expected a scene: [specimen], [material], [beams], "
                     "[central_forces] or [conduction], [run]");
  const auto record = std::make_shared<Record>();
  const Section root(Value(file, path, "", record));

  Scene scene;
  scene.path = path;
  scene.title = std::filesystem::path(path).stem().string();
  Setup& setup = scene.setup;
  const NamedEffects effects{root.has("conduction"), root.has("beams"), root.has("central_forces")};
  NamedRegions named;
  const auto with_effects = [&effects](const std::string& key, const Rule& rule) {
    return effects.motion() || effects.conduction ? must_have(key, rule) : may_have(key, rule);
  };
  const Rule specimen = specimen_section(scene.specimen, path);
  root.read({
      may_have("title", text(scene.title)),
      must_have("specimen", {specimen.expected,
                             [&](const Value& value) {
                               specimen.read(value);
                               named.specimen_is_file = !scene.specimen.file.empty();
                             }}),
      may_have("bonds", bonds_section(scene.bond_tolerance)),
      may_have("sets", sets_section(named)),
      with_effects("material", material_section(setup.materials, named, effects)),
      may_have("conduction", conduction_section(setup.conduction)),
      may_have("contacts", contacts_section(setup.conduction, setup.materials)),
      may_have("beams", beams_section(setup.beams)),
      may_have("plasticity", plasticity_section(setup.plasticity, setup.beams)),
      may_have("rupture", rupture_section(setup.rupture, setup.beams)),
      may_have("contact", contact_section(setup.contact)),
      may_have("central_forces",
               central_forces_section(setup.central_forces, scene.bond_tolerance)),
      may_have("damage", damage_section(setup.damage)),
      may_have("calibration",
               calibration_section(scene.calibration, scene.orthotropic_calibration, setup.beams)),
      may_have("grips", grips_section(setup.grips, named)),
      may_have("temperatures", temperatures_section(setup.temperatures, named)),
      may_have("heat_fluxes", heat_fluxes_section(setup.heat_fluxes)),
      may_have("convections", convections_section(setup.convections)),
      may_have("heat_sources", heat_sources_section(setup.heat_sources, named)),
      may_have("initial_velocities", initial_velocities_section(setup.initial_velocities, named)),
      may_have("sensors", sensors_section(setup.sensors, effects)),
      may_have("gauge", gauge_section(setup.gauge)),
      // A calibration pulls bars of its own.
      root.has("calibration") ? may_have("run", run_section(setup.run))
                              : with_effects("run", run_section(setup.run)),
      may_have("output", output_section(setup.output)),
  });
  check_effects(root, effects);
  if (setup.conduction && setup.conduction->broken_bonds && !setup.rupture)
    root.refuse("conduction", "broken_bonds: no bond ever breaks",
                "a section [rupture] beside it, or no broken_bonds");
  if (setup.beams && setup.beams->precision == BeamParameters::Precision::mixed)
    for (const char* section : {"plasticity", "rupture"})
      if (root.has(section))
        root.refuse(section, "beams in mixed precision are elastic",
                    "precision = \"double\" in [beams]");
  if (setup.contact && setup.contact->rebonding_pressure && setup.plasticity &&
      setup.plasticity->law == PlasticityParameters::Law::scaled_offset)
    root.refuse("contact", "bonds by the law scaled-offset cannot be made anew",
                "law = \"radial-return\" in [plasticity], or no rebonding_pressure");
  scene.record = std::move(*record);
  return scene;
}

}  // namespace solidem
