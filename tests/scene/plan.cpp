// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene does not name does not exist: the exact effects, columns and kernels of every scene
// in the tree.
#include "effects/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "scene/body.hpp"

namespace solidem::plan_test {

using Names = std::set<std::string>;

struct Expected {
  Names effects, kernels, columns;
};

const Names motion = {"pose",         "velocity",        "angular_velocity",
                      "inverse_mass", "inverse_inertia", "rest_direction",
                      "rest_length"};
Names united(Names names, const Names& more) {
  names.insert(more.begin(), more.end());
  return names;
}

const Names flowing_motion = {
    "pose",           "velocity",       "angular_velocity",   "inverse_mass",  "inverse_inertia",
    "rest_length",    "section_normal", "far_section_normal", "plastic_twist", "plastic_extension",
    "plastic_strain", "limit_strain",   "plastic_work",       "last_pose"};
const Names pulled = {"beams", "grip left", "grip right"};
const Names torn = united(pulled, {"rupture"});

const Names attracted_anywhere = {"velocity", "inverse_mass", "rest_length", "listed_position",
                                  "listed_margin"};
const Names attracted = united(attracted_anywhere, {"position"});
const Names dissipated = united(attracted_anywhere, {"position_and_velocity", "dissipated_energy"});
const Names pulled_apart = {"central forces", "grip left", "grip right"};

const Names heat = {"temperature", "inverse_heat_capacity", "conductance"};
const Names hot_and_cold = {"conduction", "temperature cold", "temperature hot"};

/// By the scene's path in the tree. Of a scene that is not listed, effects have their sections.
const std::map<std::string, Expected> expected = {
    {"benchmarks/speed/beams.toml", {{"beams", "grip left", "grip right"}, {"move_beams"}, motion}},
    {"benchmarks/speed/central_changing.toml",
     {pulled_apart, {"move_by_central_forces, piecewise, dissipation"}, dissipated}},
    {"benchmarks/speed/central_crystal.toml",
     {pulled_apart, {"move_by_central_forces, mie"}, attracted}},
    {"benchmarks/speed/central_fixed.toml",
     {pulled_apart,
      {"move_by_central_forces, piecewise"},
      {"position", "velocity", "inverse_mass", "rest_length"}}},
    {"benchmarks/speed/conduction.toml", {{"conduction", "temperature hot"}, {"conduct"}, heat}},
    {"compare/scenes/annulus.toml", {hot_and_cold, {"conduct"}, heat}},
    {"compare/scenes/cantilever.toml", {{"beams", "grip wall"}, {"move_beams"}, motion}},
    {"compare/scenes/central_cycles.toml",
     {pulled_apart, {"move_by_central_forces, piecewise, dissipation"}, dissipated}},
    {"compare/scenes/central_tension.toml",
     {united(pulled_apart, {"damage"}),
      {"find_crack_faces", "move_by_central_forces, piecewise, dissipation, cracks"},
      united(dissipated, {"barycentre"})}},
    {"compare/scenes/central_threshold.toml",
     {pulled_apart, {"move_by_central_forces, threshold"}, attracted}},
    {"compare/scenes/constant_strain.toml",
     {pulled, {"move_beams, radial return"}, flowing_motion}},
    {"compare/scenes/cyclic_force.toml", {torn, {"move_beams, radial return"}, flowing_motion}},
    {"compare/scenes/cylinder.toml", {{"conduction", "temperature hot"}, {"conduct"}, heat}},
    {"compare/scenes/elastic_cycle.toml",
     {{"beams", "grip left", "grip right"}, {"move_beams"}, motion}},
    {"compare/scenes/hanging_bar.toml",
     {{"beams", "gravity", "damping", "grip left"},
      {"move_beams"},
      united(motion, {"local_damping", "velocity_before", "angular_velocity_before"})}},
    {"compare/scenes/lattice_tension.toml",
     {pulled_apart, {"move_by_central_forces, mie"}, attracted}},
    {"compare/scenes/plate.toml", {{"conduction", "heat source disc"}, {"conduct"}, heat}},
    {"compare/scenes/rearranging_bar.toml",
     {pulled_apart, {"move_by_central_forces, piecewise"}, attracted}},
    {"compare/scenes/reversed_tension.toml",
     {pulled, {"move_beams, radial return"}, flowing_motion}},
    {"compare/scenes/simple_cubic.toml", {{"conduction", "temperature hot"}, {"conduct"}, heat}},
    {"compare/scenes/tension_bar.toml",
     {{"beams", "grip left", "grip right"}, {"move_beams"}, motion}},
    {"compare/scenes/tension_to_rupture.toml",
     {torn, {"move_beams, radial return"}, flowing_motion}},
    {"compare/scenes/three_point_bending.toml",
     {united(pulled, {"grip middle"}), {"move_beams, radial return"}, flowing_motion}},
    {"compare/scenes/torn_bar.toml", {torn, {"move_beams, radial return"}, flowing_motion}},
    {"compare/scenes/two_elements.toml",
     {pulled_apart, {"move_by_central_forces, piecewise"}, attracted}},
    {"compare/scenes/two_materials.toml", {hot_and_cold, {"conduct"}, heat}},
    {"compare/scenes/vibrating_bar.toml", {{"beams"}, {"move_beams"}, motion}},
    {"compare/scenes/wedge.toml", {hot_and_cold, {"conduct"}, heat}},
    {"docs/examples/calibration.toml", {{"beams"}, {"move_beams"}, motion}},
    {"docs/examples/calibration_5000.toml", {{"beams"}, {"move_beams"}, motion}},
    {"docs/examples/calibration_curve.toml", {{"beams"}, {"move_beams"}, motion}},
    {"docs/examples/central_forces.toml",
     {united(pulled_apart, {"damage"}),
      {"find_crack_faces", "move_by_central_forces, piecewise, dissipation, cracks"},
      united(dissipated, {"barycentre"})}},
    {"docs/examples/conduction.toml", {{"conduction", "temperature hot"}, {"conduct"}, heat}},
    {"docs/examples/loose_grains.toml",
     {{"free motion", "contact", "contact at the new poses"},
      {},
      {"pose", "velocity", "angular_velocity", "inverse_mass", "inverse_inertia"}}},
    {"docs/examples/moving_source.toml",
     {{"conduction", "heat source disc", "convection air"},
      {"conducted_power, conductivity from the temperature"},
      {"temperature", "inverse_heat_capacity", "conductivity", "conduction_length"}}},
    {"docs/examples/rupture.toml",
     {united(torn, {"contact", "contact at the new poses"}),
      {"move_beams, radial return"},
      flowing_motion}},
    {"docs/examples/simple_cubic.toml",
     {{"conduction", "temperature cold", "temperature hot"}, {"conduct"}, heat}},
    {"docs/examples/tension.toml", {{"beams", "grip left", "grip right"}, {"move_beams"}, motion}},
    {"docs/examples/two_materials.toml",
     {{"conduction", "temperature cold", "temperature warm"}, {"conduct"}, heat}},
    {"docs/examples/vibrating_bar.toml", {{"beams"}, {"move_beams"}, motion}},
    {"docs/examples/wood.toml",
     {{"beams"},
      {"move_beams, a rigidity for each bond, periodic"},
      united(motion, {"bond_rigidity", "image_shift"})}},
};

std::vector<std::filesystem::path> scenes_in_the_tree() {
  std::vector<std::filesystem::path> scenes;
  for (const char* folder : {"docs/examples", "compare/scenes", "benchmarks"}) {
    const std::filesystem::path root = std::filesystem::path(SOLIDEM_SOURCE_DIR) / folder;
    if (!std::filesystem::exists(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
      // Studies of accuracy and cost are no scenes, and theirs are filled in by the harness.
      if (entry.path().extension() == ".toml" &&
          entry.path().generic_string().find("/accuracy_cost/") == std::string::npos)
        scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// Each effect is one that a section of the scene asks for.
void expect_sections(const std::filesystem::path& scene, const Plan& plan) {
  std::ifstream file(scene);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_FALSE(plan.effects.empty()) << scene;
  for (const PlannedEffect& effect : plan.effects) {
    EXPECT_EQ(effect.reason.front(), '[') << effect.reason;
    std::istringstream sections(effect.reason);
    for (std::string section; sections >> section;)
      EXPECT_NE(text.find(section), std::string::npos) << scene << ": " << section;
  }
}

TEST(Plan, of_every_scene_in_the_tree_is_exactly_what_the_scene_names) {
  std::size_t seen = 0;
  for (const auto& path : scenes_in_the_tree()) {
    const std::string name = std::filesystem::relative(path, SOLIDEM_SOURCE_DIR).generic_string();
    const auto found = expected.find(name);
    const Scene scene = read_scene(path.string());
    const auto& periodic = scene.specimen.periodic;
    const Plan plan = make_plan(scene.setup, periodic[0] || periodic[1] || periodic[2]);
    if (found == expected.end()) {
      expect_sections(path, plan);
      continue;
    }
    ++seen;
    Names effects, kernels, columns;
    for (const PlannedEffect& effect : plan.effects) {
      effects.insert(effect.name);
      if (!effect.kernel.empty()) kernels.insert(effect.kernel);
    }
    for (const PlannedColumn& planned : plan.columns) columns.insert(planned.column->name);
    EXPECT_EQ(effects, found->second.effects) << name;
    EXPECT_EQ(kernels, found->second.kernels) << name;
    EXPECT_EQ(columns, found->second.columns) << name;
  }
  EXPECT_EQ(seen, expected.size()) << "a scene listed in this test is gone";
}

TEST(Plan, is_all_that_a_simulation_allocates) {
  Scene scene = read_scene(std::string(SOLIDEM_SOURCE_DIR) + "/docs/examples/simple_cubic.toml");
  const Simulation simulation(scene.setup, make_body(scene));
  Names columns;
  for (const Column* column : simulation.model().columns()) columns.insert(column->name);
  EXPECT_EQ(columns, heat);
}

}  // namespace solidem::plan_test
