// SPDX-License-Identifier: GPL-2.0-or-later
//
// [specimen] and [bonds].
#include <map>

#include "keys/rules.hpp"
#include "laws/constants.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

constexpr Dimension volume{"a volume", "m^3", "20 mm^3"};

// Elements are numbered with 32 bits.
constexpr std::int64_t most_elements = std::numeric_limits<std::int32_t>::max();

std::vector<Key> packing_keys(SpecimenRecipe& recipe) {
  return {may_have("elements", integer(recipe.elements, 1, most_elements)),
          may_have("mean_radius", quantity(recipe.mean_radius, dimension::length, positive)),
          may_have("seed", integer(recipe.seed, 0)),
          may_have("radius_spread", number(recipe.radius_spread, Range{0, 0.5}))};
}

std::vector<Key> frame_keys(SpecimenRecipe& recipe, const std::string& scene_file) {
  return {
      may_have("periodic", triple("true or false",
                                  [&recipe](const Value& entry, int k) {
                                    flag(recipe.periodic[static_cast<std::size_t>(k)]).read(entry);
                                  })),
      may_have("origin", vector(recipe.origin, dimension::length)),
      may_have("cut", cuts_section(recipe.cuts, scene_file))};
}

std::vector<Key> box_keys(SpecimenRecipe& recipe) {
  return {must_have("size", vector(recipe.size, dimension::length, positive))};
}

std::vector<Key> plate_keys(SpecimenRecipe& recipe) {
  return {must_have("length", quantity(recipe.size.x, dimension::length, positive)),
          must_have("width", quantity(recipe.size.y, dimension::length, positive)),
          must_have("thickness", quantity(recipe.size.z, dimension::length, positive))};
}

Key axis_key(SpecimenRecipe& recipe) {
  return may_have("axis", choice<std::string>(recipe.axis, {{"x", "x"}, {"y", "y"}, {"z", "z"}}));
}

std::vector<Key> cylinder_keys(SpecimenRecipe& recipe) {
  return {must_have("length", quantity(recipe.length, dimension::length, positive)),
          must_have("radius", quantity(recipe.radius, dimension::length, positive)),
          axis_key(recipe)};
}

std::vector<Key> sphere_keys(SpecimenRecipe& recipe) {
  return {must_have("radius", quantity(recipe.radius, dimension::length, positive))};
}

// Files of meshes are found beside the scene.
std::vector<Key> mesh_keys(SpecimenRecipe& recipe, const std::string& scene_file) {
  return {must_have("mesh", path(recipe.mesh, scene_file)),
          must_have("mesh_unit", quantity(recipe.mesh_unit, dimension::length, positive))};
}

std::vector<Key> annulus_keys(SpecimenRecipe& recipe) {
  return {must_have("length", quantity(recipe.length, dimension::length, positive)),
          must_have("inner_radius", quantity(recipe.inner_radius, dimension::length, positive)),
          must_have("outer_radius", quantity(recipe.radius, dimension::length, positive)),
          axis_key(recipe)};
}

std::vector<Key> wedge_keys(SpecimenRecipe& recipe) {
  std::vector<Key> keys = annulus_keys(recipe);
  keys.push_back(
      must_have("angle", quantity(recipe.angle, dimension::angle, Range{0, pi, false, false})));
  return keys;
}

std::vector<Key> crystal_keys(SpecimenRecipe& recipe) {
  return {
      must_have("lattice", choice<std::string>(recipe.lattice, {{"simple_cubic", "simple_cubic"},
                                                                {"bcc", "bcc"},
                                                                {"fcc", "fcc"},
                                                                {"hcp", "hcp"}})),
      must_have("cells", triple("an integer of at least 1",
                                [&recipe](const Value& entry, int k) {
                                  recipe.cells[static_cast<std::size_t>(k)] =
                                      static_cast<int>(read_integer(entry, 1, most_elements));
                                })),
      must_have("element_radius", quantity(recipe.element_radius, dimension::length, positive))};
}

/// Several shapes have a length.
void append_once(std::vector<Key>& keys, const Key& key) {
  for (const Key& known : keys)
    if (known.name == key.name) return;
  keys.push_back(key);
}

/// Whether the elements of a crystal can be numbered; the densest cells hold four.
bool is_too_large(const std::array<int, 3>& cells) {
  double elements = 4;
  for (const int n : cells) elements *= n;
  return elements > static_cast<double>(most_elements);
}

const std::map<std::string, std::vector<Key> (*)(SpecimenRecipe&)>& shape_keys() {
  static const std::map<std::string, std::vector<Key> (*)(SpecimenRecipe&)> keys = {
      {"box", box_keys},         {"plate", plate_keys}, {"cylinder", cylinder_keys},
      {"annulus", annulus_keys}, {"wedge", wedge_keys}, {"sphere", sphere_keys},
      {"crystal", crystal_keys}};
  return keys;
}

void check_body(const Section& section, const SpecimenRecipe& recipe) {
  if (recipe.shape.empty() || recipe.shape == "box" || recipe.shape == "plate") return;
  if (recipe.shape == "sphere" || recipe.shape == "mesh") {
    for (const bool periodic : recipe.periodic)
      if (periodic)
        section.refuse("periodic", "a " + recipe.shape + " has walls all round", "no such key");
    return;
  }
  if (recipe.inner_radius > 0 && !(recipe.inner_radius < recipe.radius))
    section.refuse("inner_radius", "the hole is as wide as the body",
                   "a length below outer_radius");
  for (std::size_t k = 0; k < 3; ++k)
    if (recipe.periodic[k] && recipe.axis != std::string(1, "xyz"[k]))
      section.refuse("periodic", "the " + recipe.shape + " has walls across its axis",
                     "true along axis " + recipe.axis + " only");
}

void check_recipe(const Section& section, const SpecimenRecipe& recipe) {
  if (recipe.shape == "crystal") {
    if (is_too_large(recipe.cells)) section.refuse("cells", "too many elements", "fewer than 2^29");
    return;
  }
  section.exactly_one_of({"elements", "mean_radius"});
  check_body(section, recipe);
}

void read_recipe(const Section& section, SpecimenRecipe& recipe, const std::string& scene_file,
                 const std::vector<Key>& more) {
  const Rule shape = choice<std::string>(recipe.shape, {{"box", "box"},
                                                        {"plate", "plate"},
                                                        {"cylinder", "cylinder"},
                                                        {"annulus", "annulus"},
                                                        {"wedge", "wedge"},
                                                        {"sphere", "sphere"},
                                                        {"mesh", "mesh"},
                                                        {"crystal", "crystal"}});
  section.read_one(may_have("shape", shape));

  std::vector<Key> keys = {may_have("shape", shape)};
  if (recipe.shape.empty()) {
    // Misspelt keys come first, "shape" perhaps among them; then the missing shape.
    keys = {may_have("file", text(recipe.file)), must_have("shape", shape, "or file")};
    for (const auto& entry : shape_keys())
      for (const Key& key : entry.second(recipe)) append_once(keys, may_have(key.name, key.rule));
    for (const Key& key : mesh_keys(recipe, scene_file))
      append_once(keys, may_have(key.name, key.rule));
  } else if (recipe.shape == "mesh") {
    for (const Key& key : mesh_keys(recipe, scene_file)) append_once(keys, key);
  } else {
    for (const Key& key : shape_keys().at(recipe.shape)(recipe)) append_once(keys, key);
  }
  if (recipe.shape != "crystal")
    for (const Key& key : packing_keys(recipe)) append_once(keys, key);
  for (const Key& key : frame_keys(recipe, scene_file)) append_once(keys, key);
  keys.insert(keys.end(), more.begin(), more.end());
  section.read(keys, recipe.shape.empty() ? "" : "a specimen of shape " + recipe.shape);
  check_recipe(section, recipe);
}

/// A file, and the body of its spheres where it does not tell that itself.
void read_specimen_file(const Section& section, SpecimenRecipe& recipe,
                        const std::string& scene_file, const std::vector<Key>& more) {
  const Rule shape = choice<std::string>(recipe.shape, {{"box", "box"},
                                                        {"plate", "plate"},
                                                        {"cylinder", "cylinder"},
                                                        {"annulus", "annulus"},
                                                        {"wedge", "wedge"},
                                                        {"sphere", "sphere"}});
  section.read_one(may_have("shape", shape));
  section.at_most_one_of({"volume", "shape"});
  std::vector<Key> keys = {must_have("file", path(recipe.file, scene_file)),
                           may_have("volume", quantity(recipe.volume, volume, positive)),
                           may_have("shape", shape)};
  if (!recipe.shape.empty()) {
    for (const Key& key : shape_keys().at(recipe.shape)(recipe)) append_once(keys, key);
    for (const Key& key : frame_keys(recipe, scene_file)) append_once(keys, key);
  }
  append_once(keys, may_have("cut", cuts_section(recipe.cuts, scene_file)));
  keys.insert(keys.end(), more.begin(), more.end());
  section.read(keys, recipe.shape.empty() ? "a specimen from a file"
                                          : "a specimen from a file, of shape " + recipe.shape);
  check_body(section, recipe);
}

}  // namespace

void read_specimen(const Section& section, SpecimenRecipe& recipe, const std::string& scene_file,
                   const std::vector<Key>& more) {
  if (section.has("file"))
    read_specimen_file(section, recipe, scene_file, more);
  else
    read_recipe(section, recipe, scene_file, more);
}

Rule specimen_section(SpecimenRecipe& recipe, const std::string& scene_file) {
  return table([&recipe, scene_file](const Section& section) {
    read_specimen(section, recipe, scene_file, {});
  });
}

Rule bonds_section(std::optional<double>& tolerance) {
  const double infinity = std::numeric_limits<double>::infinity();
  return table([&tolerance, infinity](const Section& section) {
    section.read({may_have("tolerance", number(tolerance, Range{-1, infinity, false, true}))});
  });
}

}  // namespace solidem
