// SPDX-License-Identifier: GPL-2.0-or-later
//
// [material], [conduction] and [beams].
#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

Material read_material(const Section& section, const NamedRegions& named, NamedEffects effects,
                       bool is_one_of_several) {
  Material material;
  double specific_heat = 0, conductivity = 0;
  const Rule heat = quantity(specific_heat, dimension::specific_heat_capacity, positive);
  const Rule conduct = quantity(conductivity, dimension::conductivity, positive);
  const auto thermal = [&effects](const std::string& key, const Rule& rule) {
    return effects.conduction ? must_have(key, rule, "needed by [conduction]")
                              : may_have(key, rule);
  };
  const Rule where = region(material.region, named);
  section.read({must_have("density", quantity(material.density, dimension::density, positive)),
                thermal("specific_heat_capacity", heat), thermal("conductivity", conduct),
                is_one_of_several ? must_have("region", where, "there are several materials")
                                  : may_have("region", where)});
  if (effects.conduction) {  // properties that nothing asks for stay zero
    material.specific_heat = specific_heat;
    material.conductivity = conductivity;
  }
  return material;
}

}  // namespace

Rule material_section(std::vector<Material>& materials, const NamedRegions& named,
                      NamedEffects effects) {
  return {"a section [material]", [&materials, &named, effects](const Value& value) {
            if (value.node().is_table()) {
              materials.push_back(read_material(Section(value), named, effects, false));
              return;
            }
            const toml::array* array = value.node().as_array();
            const bool is_one_of_several = array != nullptr && array->size() > 1;
            tables([&](const Section& section) {
              materials.push_back(read_material(section, named, effects, is_one_of_several));
            }).read(value);
          }};
}

Rule conduction_section(std::optional<ConductionParameters>& conduction) {
  return table([&conduction](const Section& section) {
    ConductionParameters parameters;
    using Law = ConductionParameters::Law;
    section.read(
        {may_have("law", choice<Law>(parameters.law, {{"platonic", Law::platonic}})),
         must_have("initial_temperature", quantity(parameters.initial_temperature,
                                                   dimension::temperature, not_negative))});
    conduction = parameters;
  });
}

Rule beams_section(std::optional<BeamParameters>& beams) {
  return table([&beams](const Section& section) {
    BeamParameters parameters;
    double poisson_ratio = 0;
    using RadiusFrom = BeamParameters::RadiusFrom;
    section.read({must_have("young_modulus",
                            quantity(parameters.young_modulus, dimension::modulus, positive)),
                  may_have("poisson_ratio", number(poisson_ratio, Range{-1, 0.5, false, true})),
                  may_have("shear_modulus",
                           quantity(parameters.shear_modulus, dimension::modulus, positive)),
                  must_have("radius_ratio", number(parameters.radius_ratio, positive)),
                  may_have("radius_from", choice<RadiusFrom>(parameters.radius_from,
                                                             {{"mean", RadiusFrom::mean},
                                                              {"pair", RadiusFrom::pair}}))});
    section.exactly_one_of({"poisson_ratio", "shear_modulus"});
    if (section.has("poisson_ratio"))
      parameters.shear_modulus = parameters.young_modulus / (2 * (1 + poisson_ratio));
    beams = parameters;
  });
}

}  // namespace solidem
