// SPDX-License-Identifier: GPL-2.0-or-later
//
// [material].
#include "keys/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

Material read_material(const Section& section, const NamedRegions& named, NamedEffects effects,
                       std::set<std::string>& taken, bool is_one_of_several) {
  Material material;
  TemperatureFunction specific_heat, conductivity, expansion;
  const Rule heat = property(specific_heat, dimension::specific_heat_capacity, positive);
  const Rule conduct = property(conductivity, dimension::conductivity, positive);
  const Rule expand = property(expansion, dimension::expansion);
  const auto thermal = [&effects](const std::string& key, const Rule& rule) {
    return effects.heat ? must_have(key, rule, "needed by [conduction]") : may_have(key, rule);
  };
  const Rule where = region(material.region, named);
  section.read({may_have("name", name(material.name, taken)),
                must_have("density", quantity(material.density, dimension::density, positive)),
                thermal("specific_heat_capacity", heat), thermal("conductivity", conduct),
                effects.expansion
                    ? must_have("expansion_coefficient", expand, "needed by [expansion]")
                    : may_have("expansion_coefficient", expand),
                is_one_of_several ? must_have("region", where, "there are several materials")
                                  : may_have("region", where)});
  if (effects.heat) {  // properties that nothing asks for stay zero
    material.specific_heat = specific_heat;
    material.conductivity = conductivity;
  }
  if (effects.expansion) material.expansion_coefficient = expansion;
  return material;
}

}  // namespace

Rule material_section(std::vector<Material>& materials, const NamedRegions& named,
                      NamedEffects effects) {
  return {"a section [material]", [&materials, &named, effects](const Value& value) {
            std::set<std::string> taken;
            if (value.node().is_table()) {
              materials.push_back(read_material(Section(value), named, effects, taken, false));
              return;
            }
            const toml::array* array = value.node().as_array();
            const bool is_one_of_several = array != nullptr && array->size() > 1;
            tables([&](const Section& section) {
              materials.push_back(read_material(section, named, effects, taken, is_one_of_several));
            }).read(value);
          }};
}

}  // namespace solidem
