// SPDX-License-Identifier: GPL-2.0-or-later
//
// [beams], [plasticity], [rupture] and [contact].
#include <map>

#include "effects/beam_properties.hpp"
#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

Rule beams_section(std::optional<BeamParameters>& beams) {
  return table([&beams](const Section& section) {
    using Law = BeamParameters::Law;
    using RadiusFrom = BeamParameters::RadiusFrom;
    using Precision = BeamParameters::Precision;
    BeamParameters parameters;
    double poisson_ratio = 0;
    section.read(
        {may_have("law", choice<Law>(parameters.law, {{"euler-bernoulli", Law::euler_bernoulli},
                                                      {"timoshenko", Law::timoshenko},
                                                      {"spring", Law::spring}})),
         must_have("young_modulus",
                   quantity(parameters.young_modulus, dimension::modulus, positive)),
         may_have("poisson_ratio", number(poisson_ratio, Range{-1, 0.5, false, true})),
         may_have("shear_modulus",
                  quantity(parameters.shear_modulus, dimension::modulus, positive)),
         may_have("shear_coefficient",
                  number(parameters.shear_coefficient, Range{0, 1, false, true})),
         must_have("radius_ratio", number(parameters.radius_ratio, positive)),
         may_have("radius_from",
                  choice<RadiusFrom>(parameters.radius_from,
                                     {{"mean", RadiusFrom::mean}, {"pair", RadiusFrom::pair}})),
         may_have("precision",
                  choice<Precision>(parameters.precision,
                                    {{"double", Precision::whole}, {"mixed", Precision::mixed}})),
         may_have("anisotropy", anisotropy_section(parameters)),
         may_have("fibres", fibres_section(parameters))});
    if (section.has("shear_coefficient") && parameters.law != Law::timoshenko)
      section.refuse("shear_coefficient", "only Timoshenko beams shear",
                     "law = \"timoshenko\" beside it");
    if (parameters.precision == Precision::mixed &&
        (parameters.law != Law::euler_bernoulli || !beams_are_alike(parameters)))
      section.refuse("precision", "only Euler-Bernoulli beams that are all alike",
                     "precision = \"double\", or radius_from = \"mean\" and no grain or fibres");
    if (parameters.law == Law::spring) {
      for (const char* key : {"poisson_ratio", "shear_modulus"})
        if (section.has(key))
          section.refuse(key, "a spring has no shear modulus",
                         "no such key beside law = \"spring\"");
    } else {
      section.exactly_one_of({"poisson_ratio", "shear_modulus"});
      if (section.has("poisson_ratio"))
        parameters.shear_modulus = parameters.young_modulus / (2 * (1 + poisson_ratio));
    }
    beams = parameters;
  });
}

namespace {

/// Keys of the parameters of a law of bonds: as numbers, and as stresses that stand for them times
/// Young's modulus; `stresses` takes these until read_stresses().
template <class Law>
std::vector<Key> bond_law_keys(Law& law, std::map<std::string, double>& stresses) {
  std::vector<Key> keys;
  for (const auto& parameter : Law::parameters()) {
    const Range& range = parameter.bound == LawBound::positive ? positive : not_negative;
    keys.push_back(may_have(parameter.name, number(law.*parameter.member, range)));
    if (parameter.stress_name != nullptr)
      keys.push_back(may_have(parameter.stress_name, quantity(stresses[parameter.stress_name],
                                                              dimension::modulus, range)));
  }
  return keys;
}

/// Each parameter once, as a number or as a stress; and those that the law needs.
template <class Law>
void require_parameters(const Section& section) {
  for (const auto& parameter : Law::parameters()) {
    std::vector<std::string> names{parameter.name};
    if (parameter.stress_name != nullptr) names.insert(names.begin(), parameter.stress_name);
    parameter.is_required ? section.exactly_one_of(names) : section.at_most_one_of(names);
  }
}

template <class Law>
void read_stresses(const Section& section, const std::map<std::string, double>& stresses,
                   double young_modulus, Law& law) {
  for (const auto& parameter : Law::parameters())
    if (parameter.stress_name != nullptr && section.has(parameter.stress_name))
      law.*parameter.member = stresses.at(parameter.stress_name) / young_modulus;
}

/// Names of the parameters that say what a law does when all of them may be left out.
template <class Law>
std::string parameter_names() {
  std::string names;
  for (const auto& parameter : Law::parameters())
    names += (names.empty() ? "" : " or ") +
             std::string(parameter.stress_name != nullptr ? parameter.stress_name : parameter.name);
  return names;
}

/// Reads the law of a table that a key names, with the keys it shares with all others.
template <class Table>
void read_bond_law(const Section& section, const char* key, const std::vector<Key>& others,
                   const std::optional<BeamParameters>& beams, typename Table::Any& result) {
  std::vector<std::pair<std::string, std::string>> names;
  Table::for_each([&names](const auto& law) { names.emplace_back(law.name, law.name); });
  std::string name = names.front().first;
  const Key law_key = may_have(key, choice<std::string>(name, names));
  section.read_one(law_key);
  Table::for_each([&](auto law) {
    using Law = decltype(law);
    if (name != law.name) return;
    std::map<std::string, double> stresses;
    std::vector<Key> keys = bond_law_keys(law, stresses);
    keys.push_back(law_key);
    keys.insert(keys.end(), others.begin(), others.end());
    section.read(keys);
    require_parameters<Law>(section);
    if (beams) read_stresses(section, stresses, beams->young_modulus, law);
    if (const char* complaint = law.complaint(); complaint != nullptr && beams)
      section.refuse(complaint, parameter_names<Law>());
    result = law;
  });
}

}  // namespace

Rule plasticity_section(std::optional<PlasticityParameters>& plasticity,
                        const std::optional<BeamParameters>& beams) {
  return table([&plasticity, &beams](const Section& section) {
    using Law = PlasticityParameters::Law;
    PlasticityParameters parameters;
    const Key rule =
        may_have("law", choice<Law>(parameters.law, {{"radial-return", Law::radial_return},
                                                     {"scaled-offset", Law::scaled_offset}}));
    read_bond_law<YieldLaws>(section, "hardening", {rule}, beams, parameters.hardening);
    if (beams) plasticity = parameters;  // else refused as a whole
  });
}

Rule rupture_section(std::optional<RuptureParameters>& rupture,
                     const std::optional<BeamParameters>& beams) {
  return table([&rupture, &beams](const Section& section) {
    RuptureParameters parameters;
    const Key minimal_bonds = may_have("minimal_bonds", integer(parameters.minimal_bonds, 0));
    read_bond_law<RuptureLaws>(section, "law", {minimal_bonds}, beams, parameters.law);
    if (beams) rupture = parameters;
  });
}

Rule contact_section(std::optional<ContactParameters>& contact) {
  return table([&contact](const Section& section) {
    ContactParameters parameters;
    section.read({may_have("stiffness_ratio", number(parameters.stiffness_ratio, positive)),
                  may_have("rebonding_pressure",
                           quantity(parameters.rebonding_pressure, dimension::modulus, positive))});
    contact = parameters;
  });
}

}  // namespace solidem
