// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/scene.hpp"

#include <algorithm>
#include <filesystem>

#include "effects/beam_parameters.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/read_file.hpp"
#include "scene/overrides.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

std::string scene_text(const std::string& path) {
  if (!is_there(path)) throw InputError(path + ": no such file; expected a scene file (TOML)");
  if (is_folder(path)) throw InputError(path + ": a folder; expected a scene file (TOML)");
  constexpr std::size_t most_bytes = std::size_t{1} << 26;
  try {
    return read_file(path, most_bytes);
  } catch (const InputError& reason) {
    throw InputError(std::string(reason.what()) +
                     "; expected a scene file (TOML) with read permission");
  }
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

bool names_what_provides(const Section& root, Provides what) {
  const std::vector<EffectKind>& kinds = effect_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const EffectKind& kind) {
    return kind.provides == what && root.has(kind.section);
  });
}

std::string problem_without(Provides what) {
  return what == Provides::motion ? "nothing moves" : "nothing conducts heat";
}

void check_kind(const Section& root, const EffectKind& kind) {
  for (const Conflict& conflict : kind.conflicts)
    if (root.has(conflict.section)) root.refuse(kind.section, conflict.problem, conflict.expected);
  if (kind.needs != Provides::nothing && !names_what_provides(root, kind.needs))
    root.refuse(kind.section, problem_without(kind.needs), sections_that_provide({kind.needs}));
  if (!kind.beside.empty() && std::none_of(kind.beside.begin(), kind.beside.end(),
                                           [&](const auto& name) { return root.has(name); }))
    root.refuse(kind.section, kind.problem_alone, any_section(kind.beside));
}

/// A scene without effects is a recipe for a specimen and no more.
void check_effects(const Section& root) {
  const bool moves = names_what_provides(root, Provides::motion);
  std::vector<std::string> without_effect{"material",    "sensors", "gauge",
                                          "calibration", "run",     "output"};
  for (const EffectKind& kind : effect_kinds()) without_effect.push_back(kind.section);
  if (!moves && !names_what_provides(root, Provides::heat))
    for (const std::string& section : without_effect)
      if (root.has(section))
        root.refuse(section, "the scene has no effect",
                    sections_that_provide({Provides::motion, Provides::heat}));
  for (const EffectKind& kind : effect_kinds())
    if (root.has(kind.section)) check_kind(root, kind);
  if (root.has("gauge") && !moves)
    root.refuse("gauge", problem_without(Provides::motion),
                sections_that_provide({Provides::motion}));
  if (root.has("calibration") && !root.has("beams"))
    root.refuse("calibration", "there are no beams", "a section [beams]");
}

/// One key for each kind of effect, which reads its section into the setup.
std::vector<Key> effect_keys(Setup& setup, const NamedRegions& named,
                             const std::optional<double>& bond_tolerance) {
  std::vector<Key> keys;
  for (const EffectKind& kind : effect_kinds())
    keys.push_back(may_have(kind.section, {"", [&](const Value& value) {
                                             Reading reading{setup, named, bond_tolerance, {}};
                                             kind.read(value, reading);
                                           }}));
  return keys;
}

}  // namespace

bool Scene::takes_file() const {
  return !specimen.file.empty() ||
         std::any_of(bodies.begin(), bodies.end(),
                     [](const BodyRecipe& body) { return !body.recipe.file.empty(); });
}

Scene read_scene(const SceneSource& source) {
  const std::string& path = source.path;
  toml::table file = parse(source.text ? *source.text : scene_text(path), path);
  for (const std::string& assignment : source.set) override_value(file, assignment);
  if (file.empty())
    throw InputError(path +
                     ": empty; expected a scene: [specimen], [material], [beams], "
                     "[central_forces] or [conduction], [run]");
  const auto record = std::make_shared<Record>();
  const Section root(Value(file, path, "", record));

  Scene scene;
  scene.path = path;
  scene.set = source.set;
  scene.title = std::filesystem::path(path).stem().string();
  Setup& setup = scene.setup;
  const NamedEffects effects{names_what_provides(root, Provides::motion),
                             names_what_provides(root, Provides::heat), root.has("expansion")};
  NamedRegions named;
  const auto with_effects = [&effects](const std::string& key, const Rule& rule) {
    return effects.motion || effects.heat ? must_have(key, rule) : may_have(key, rule);
  };
  const Rule specimen = specimen_section(scene.specimen, path);
  const Rule bodies = bodies_section(scene.bodies, path);
  const Rule one_body{specimen.expected, [&](const Value& value) {
                        specimen.read(value);
                        named.specimen_is_file = scene.takes_file();
                      }};
  const Rule several_bodies{bodies.expected, [&](const Value& value) {
                              bodies.read(value);
                              named.specimen_is_file = scene.takes_file();
                              for (const BodyRecipe& body : scene.bodies)
                                named.bodies.push_back(body.name);
                            }};
  if (root.has("body")) root.at_most_one_of({"specimen", "body"});
  std::vector<Key> keys{
      may_have("title", text(scene.title)),
      root.has("body") ? may_have("specimen", one_body)
                       : must_have("specimen", one_body, "or several [[body]]"),
      may_have("body", several_bodies),
      may_have("bonds", bonds_section(scene.bond_tolerance)),
      may_have("sets", sets_section(named)),
      with_effects("material", material_section(setup.materials, named, effects))};
  for (const Key& key : effect_keys(setup, named, scene.bond_tolerance)) keys.push_back(key);
  const std::vector<Key> others{
      may_have("calibration", calibration_section(scene.calibration, scene.orthotropic_calibration,
                                                  setup.get<BeamParameters>())),
      may_have("sensors", sensors_section(setup.sensors, effects)),
      may_have("gauge", gauge_section(setup.gauge)),
      // A calibration pulls bars of its own.
      root.has("calibration") ? may_have("run", run_section(setup.run))
                              : with_effects("run", run_section(setup.run)),
      may_have("output", output_section(setup.output))};
  keys.insert(keys.end(), others.begin(), others.end());
  root.read(keys);
  if (root.has("calibration") && root.has("body"))
    root.refuse("calibration", "there are several bodies", "one body, in a section [specimen]");
  check_effects(root);
  scene.record = std::move(*record);
  scene.places = Places(file, path);
  return scene;
}

}  // namespace solidem
