// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beam_material_keys.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "keys/rules.hpp"

namespace solidem {

namespace {

using Law = BeamParameters::Law;
using Json = nlohmann::ordered_json;

std::vector<Key> elasticity_keys(BeamElasticity& p) {
  return {must_have("young_modulus", quantity(p.young_modulus, dimension::modulus, positive))
              .means("E of these beams"),
          may_have("poisson_ratio", number(p.poisson_ratio, Range{-1, 0.5, false, true}))
              .means("ν of these beams; not for springs")
              .without("either this"),
          may_have("shear_modulus", quantity(p.shear_modulus, dimension::modulus, positive))
              .means("G of these beams; not for springs")
              .without("or this"),
          may_have("radius_ratio", number(p.radius_ratio, positive))
              .means("radius of these beams as a multiple of what `radius_from` says")};
}

/// The shear modulus, by either key, and the radius of [beams] where none is given.
void finish(const Section& section, Law law, double radius_ratio, BeamElasticity& p) {
  if (!section.has("radius_ratio")) p.radius_ratio = radius_ratio;
  if (law == Law::spring) {
    for (const char* key : {"poisson_ratio", "shear_modulus"})
      if (section.has(key))
        section.refuse(key, "a spring has no shear modulus", "no such key beside law = \"spring\"");
    return;
  }
  section.exactly_one_of({"poisson_ratio", "shear_modulus"});
  if (p.poisson_ratio) p.shear_modulus = p.young_modulus / (2 * (1 + *p.poisson_ratio));
}

Rule two_names(std::vector<std::string>& target) {
  const std::string expected = "two names of [[beams.material]], or \"rest\"";
  return {expected, [&target, expected](const Value& value) {
            for (const Value& entry : value.entries(2, expected))
              target.push_back(read_text(entry, expected));
          }};
}

Json to_json(const BeamElasticity& p) {
  return {{"young_modulus", p.young_modulus},
          {"shear_modulus", p.shear_modulus},
          {"radius_ratio", p.radius_ratio}};
}

}  // namespace

std::vector<Key> beam_material_keys(BeamMaterial& material, std::set<std::string>& taken,
                                    const NamedRegions& regions) {
  std::vector<Key> keys{must_have("name", name(material.name, taken)).means("not `rest`"),
                        must_have("region", region(material.region, regions))
                            .means("beams between two elements of it are of this material")};
  for (const Key& key : elasticity_keys(material)) keys.push_back(key);
  keys.back() = keys.back().without("that of `[beams]`");
  return keys;
}

std::vector<Key> beam_interface_keys(BeamInterface& interface, std::vector<std::string>& between) {
  std::vector<Key> keys{must_have("between", two_names(between))
                            .means("the two materials; `rest` is what `[beams]` says")};
  for (const Key& key : elasticity_keys(interface)) keys.push_back(key);
  keys.back() = keys.back().without("the mean of the two materials'");
  return keys;
}

Rule beam_materials_section(BeamParameters& beams, const NamedRegions& regions) {
  return tables([&beams, &regions](const Section& section) {
    std::set<std::string> taken;
    for (const BeamMaterial& material : beams.materials) taken.insert(material.name);
    BeamMaterial material;
    section.read(beam_material_keys(material, taken, regions));
    if (material.name == rest_of_beams)
      section.refuse("name", "that is what [beams] itself is called", "another name");
    finish(section, beams.law, beams.radius_ratio, material);
    beams.materials.push_back(std::move(material));
  });
}

Rule beam_interfaces_section(BeamParameters& beams) {
  return tables([&beams](const Section& section) {
    BeamInterface interface;
    std::vector<std::string> between;
    section.read(beam_interface_keys(interface, between));
    std::vector<std::string> known{rest_of_beams};
    for (const BeamMaterial& material : beams.materials) known.push_back(material.name);
    std::vector<double> ratio;
    for (const std::string& one : between) {
      const auto found = std::find(known.begin(), known.end(), one);
      if (found == known.end())
        section.refuse("between", "no such material" + did_you_mean(one, known),
                       "two of " + join(known));
      ratio.push_back(
          found == known.begin()
              ? beams.radius_ratio
              : beams.materials[static_cast<std::size_t>(found - known.begin()) - 1].radius_ratio);
    }
    interface.first = between[0];
    interface.second = between[1];
    if (interface.first == interface.second)
      section.refuse("between", "one material has no interface with itself",
                     "two different materials");
    for (const BeamInterface& other : beams.interfaces)
      if ((other.first == interface.first && other.second == interface.second) ||
          (other.first == interface.second && other.second == interface.first))
        section.refuse("between", "this interface is there twice", "each interface once");
    finish(section, beams.law, 0.5 * (ratio[0] + ratio[1]), interface);
    beams.interfaces.push_back(std::move(interface));
  });
}

void finish_beam_materials(const Section& section, BeamParameters& beams) {
  if (beams.materials.empty()) {
    if (!beams.interfaces.empty())
      section.refuse("interface", "there is one material", "several, in [[beams.material]]");
    return;
  }
  for (const char* key : {"anisotropy", "fibres"})
    if (section.has(key))
      section.refuse(key, "there are several materials of beams, and they have no grain",
                     "one of " + std::string(key) + " and [[beams.material]]");
}

void explain_beam_materials(const BeamParameters& beams, Json& json) {
  if (beams.materials.empty()) return;
  for (const BeamMaterial& material : beams.materials) {
    Json entry = to_json(material);
    entry["name"] = material.name;
    json["materials"].push_back(std::move(entry));
  }
  json["interfaces"] = Json::array();
  for (const BeamInterface& interface : beams.interfaces) {
    Json entry = to_json(interface);
    entry["between"] = {interface.first, interface.second};
    json["interfaces"].push_back(std::move(entry));
  }
}

}  // namespace solidem
