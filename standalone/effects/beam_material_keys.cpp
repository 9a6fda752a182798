// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beam_material_keys.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "effects/beam_parameters.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"

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

/// Where these beams flow and break. `stress` takes the yield stress until finish().
std::vector<Key> limit_keys(BeamLimits& p, std::optional<double>& stress, const char* otherwise) {
  return {may_have("yield_strain", number(p.yield_strain, positive))
              .means("at which these beams first flow; the whole yield curve is scaled so, see "
                     "below; with `[plasticity]`")
              .without(otherwise),
          may_have("yield_stress", quantity(stress, dimension::modulus, positive))
              .means("the same as a stress, over E of these beams")
              .without(otherwise),
          may_have("plastic_strain_ratio", number(p.plastic_strain_ratio, positive))
              .means("plastic strains of these beams over those of `[plasticity]` at which the "
                     "yield stress has grown as much")
              .without(otherwise),
          may_have("rupture_ratio", number(p.rupture_ratio, positive))
              .means("strains at which these beams break over those of `[rupture]`, all alike; "
                     "strengths are over E of these beams")
              .without(otherwise)};
}

/// The yield strain, the shear modulus, each by either key, and the radius of [beams] where none is
/// given.
void finish(const Section& section, Law law, double radius_ratio,
            const std::optional<double>& yield_stress, BeamElasticity& p) {
  section.at_most_one_of({"yield_strain", "yield_stress"});
  if (yield_stress) p.limits.yield_strain = *yield_stress / p.young_modulus;
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
  Json json{{"young_modulus", p.young_modulus},
            {"shear_modulus", p.shear_modulus},
            {"radius_ratio", p.radius_ratio}};
  const auto add = [&json](const char* name, const std::optional<double>& value) {
    if (value) json[name] = *value;
  };
  add("yield_strain", p.limits.yield_strain);
  add("plastic_strain_ratio", p.limits.plastic_strain_ratio);
  add("rupture_ratio", p.limits.rupture_ratio);
  return json;
}

/// Says of each kind of limit who has none of it to share.
void require_laws(const std::string& whose, const BeamLimits& limits, bool has_plasticity,
                  bool has_rupture) {
  const auto require = [&](bool is_stated, const char* key, bool has_law, const char* law) {
    if (is_stated && !has_law)
      throw InputError(whose + " " + key + ": there is no section " + law +
                       " whose law it shares; leave the key out, or say " + law);
  };
  require(limits.yield_strain.has_value(), "yield_strain or yield_stress", has_plasticity,
          "[plasticity]");
  require(limits.plastic_strain_ratio.has_value(), "plastic_strain_ratio", has_plasticity,
          "[plasticity]");
  require(limits.rupture_ratio.has_value(), "rupture_ratio", has_rupture, "[rupture]");
}

}  // namespace

std::vector<Key> beam_material_keys(BeamMaterial& material, std::optional<double>& yield_stress,
                                    std::set<std::string>& taken, const NamedRegions& regions) {
  std::vector<Key> keys{must_have("name", name(material.name, taken)).means("not `rest`"),
                        must_have("region", region(material.region, regions))
                            .means("beams between two elements of it are of this material")};
  for (const Key& key : elasticity_keys(material)) keys.push_back(key);
  keys.back() = keys.back().without("that of `[beams]`");
  for (const Key& key : limit_keys(material.limits, yield_stress, "the strains of the law"))
    keys.push_back(key);
  return keys;
}

std::vector<Key> beam_interface_keys(BeamInterface& interface, std::optional<double>& yield_stress,
                                     std::vector<std::string>& between) {
  std::vector<Key> keys{must_have("between", two_names(between))
                            .means("the two materials; `rest` is what `[beams]` says")};
  for (const Key& key : elasticity_keys(interface)) keys.push_back(key);
  keys.back() = keys.back().without("the mean of the two materials'");
  for (const Key& key :
       limit_keys(interface.limits, yield_stress, "of the side that bears less stress"))
    keys.push_back(key);
  return keys;
}

Rule beam_materials_section(BeamParameters& beams, const NamedRegions& regions) {
  return tables([&beams, &regions](const Section& section) {
    std::set<std::string> taken;
    for (const BeamMaterial& material : beams.materials) taken.insert(material.name);
    BeamMaterial material;
    std::optional<double> yield_stress;
    section.read(beam_material_keys(material, yield_stress, taken, regions));
    if (material.name == rest_of_beams)
      section.refuse("name", "that is what [beams] itself is called", "another name");
    finish(section, beams.law, beams.radius_ratio, yield_stress, material);
    beams.materials.push_back(std::move(material));
  });
}

Rule beam_interfaces_section(BeamParameters& beams) {
  return tables([&beams](const Section& section) {
    BeamInterface interface;
    std::vector<std::string> between;
    std::optional<double> yield_stress;
    section.read(beam_interface_keys(interface, yield_stress, between));
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
    finish(section, beams.law, 0.5 * (ratio[0] + ratio[1]), yield_stress, interface);
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

void check_limits_of_materials(const BeamParameters& beams, bool has_plasticity, bool has_rupture) {
  for (const BeamMaterial& material : beams.materials)
    require_laws("[[beams.material]] \"" + material.name + "\"", material.limits, has_plasticity,
                 has_rupture);
  for (const BeamInterface& interface : beams.interfaces)
    require_laws("[[beams.interface]] between " + interface.first + " and " + interface.second,
                 interface.limits, has_plasticity, has_rupture);
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
