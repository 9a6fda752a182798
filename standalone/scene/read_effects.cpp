// SPDX-License-Identifier: GPL-2.0-or-later
//
// [material], [conduction] and [[contacts]].
#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

Material read_material(const Section& section, const NamedRegions& named, NamedEffects effects,
                       std::set<std::string>& taken, bool is_one_of_several) {
  Material material;
  TemperatureFunction specific_heat, conductivity;
  const Rule heat = property(specific_heat, dimension::specific_heat_capacity, positive);
  const Rule conduct = property(conductivity, dimension::conductivity, positive);
  const auto thermal = [&effects](const std::string& key, const Rule& rule) {
    return effects.conduction ? must_have(key, rule, "needed by [conduction]")
                              : may_have(key, rule);
  };
  const Rule where = region(material.region, named);
  section.read({may_have("name", name(material.name, taken)),
                must_have("density", quantity(material.density, dimension::density, positive)),
                thermal("specific_heat_capacity", heat), thermal("conductivity", conduct),
                is_one_of_several ? must_have("region", where, "there are several materials")
                                  : may_have("region", where)});
  if (effects.conduction) {  // properties that nothing asks for stay zero
    material.specific_heat = specific_heat;
    material.conductivity = conductivity;
  }
  return material;
}

using Law = ConductionParameters::Law;
using Integrator = ConductionParameters::Integrator;
using BrokenBonds = ConductionParameters::BrokenBonds;

void check_conduction(const Section& section, const ConductionParameters& conduction) {
  if (conduction.area_factor && conduction.law != Law::platonic_calibrated)
    section.refuse("area_factor", "the law has no such factor",
                   "law = \"platonic-calibrated\" beside it");
  if (conduction.tolerance && conduction.integrator == Integrator::explicit_euler)
    section.refuse("tolerance", "explicit Euler takes the steps of [run]",
                   "integrator = \"rkl2\", \"implicit\" or \"auto\" beside it");
  if (!conduction.tolerance && conduction.integrator == Integrator::automatic)
    section.refuse("integrator", "nothing says how accurate",
                   "tolerance beside it, such as \"0.1 K\"");
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

Rule conduction_section(std::optional<ConductionParameters>& conduction) {
  return table([&conduction](const Section& section) {
    ConductionParameters parameters;
    section.read(
        {may_have("law",
                  choice<Law>(parameters.law, {{"platonic", Law::platonic},
                                               {"platonic-calibrated", Law::platonic_calibrated},
                                               {"voronoi", Law::voronoi}})),
         must_have("initial_temperature",
                   quantity(parameters.initial_temperature, dimension::temperature, not_negative)),
         may_have("area_factor", number(parameters.area_factor, positive)),
         may_have("integrator", choice<Integrator>(parameters.integrator,
                                                   {{"explicit", Integrator::explicit_euler},
                                                    {"rkl2", Integrator::rkl2},
                                                    {"implicit", Integrator::implicit},
                                                    {"auto", Integrator::automatic}})),
         may_have("tolerance",
                  quantity(parameters.tolerance, dimension::temperature_difference, positive)),
         may_have("broken_bonds",
                  choice<std::optional<BrokenBonds>>(
                      parameters.broken_bonds,
                      {{"insulate", BrokenBonds::insulate}, {"conduct", BrokenBonds::conduct}}))});
    check_conduction(section, parameters);
    conduction = parameters;
  });
}

Rule contacts_section(std::optional<ConductionParameters>& conduction,
                      const std::vector<Material>& materials) {
  return tables([&conduction, &materials](const Section& section) {
    Contact contact;
    std::vector<std::pair<std::string, std::string>> known;
    for (const Material& material : materials)
      if (!material.name.empty()) known.emplace_back(material.name, material.name);
    const std::string expected = "the names of two materials";
    const Rule between = {expected, [&](const Value& value) {
                            const std::vector<Value> names = value.entries(2, expected);
                            choice<std::string>(contact.first, known).read(names[0]);
                            choice<std::string>(contact.second, known).read(names[1]);
                            if (contact.first == contact.second)
                              value.refuse("twice the same", expected);
                          }};
    section.read({must_have("between", between),
                  must_have("conductance",
                            quantity(contact.conductance, dimension::heat_transfer, positive))});
    if (conduction) conduction->contacts.push_back(contact);
  });
}

}  // namespace solidem
