// SPDX-License-Identifier: GPL-2.0-or-later
//
// [central_forces] and [damage]. Names and keys of the laws come from their table.
#include "laws/central_interaction.hpp"
#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

template <class Law>
Rule parameter_rule(Law& law, const LawParameter<Law>& parameter) {
  double& place = law.*parameter.place;
  switch (parameter.quantity) {
    case LawQuantity::energy:
      return quantity(place, dimension::energy, positive);
    case LawQuantity::force:
      return quantity(place, dimension::force, positive);
    case LawQuantity::stiffness:
      return quantity(place, dimension::stiffness, positive);
    case LawQuantity::ratio:
      return number(place, positive);
    case LawQuantity::exponent:
      return integer(place, 1, 100);
  }
  return {};
}

/// The law of this name with the parameters of the section, and the keys that read them.
template <class Law>
std::vector<Key> law_keys(Law& law) {
  std::vector<Key> keys;
  for (const auto& parameter : Law::parameters())
    keys.push_back(
        must_have(parameter.name, parameter_rule(law, parameter),
                  std::string("the law ") + Law::name + " needs it: " + parameter.meaning));
  return keys;
}

}  // namespace

Rule central_forces_section(std::optional<CentralForceParameters>& forces,
                            const std::optional<double>& bond_tolerance) {
  return table([&forces, &bond_tolerance](const Section& section) {
    using Forces = CentralForceParameters;
    CentralForceParameters parameters;
    std::string name;
    std::vector<std::pair<std::string, std::string>> names;
    CentralLaws::for_each([&names](const auto& law) { names.emplace_back(law.name, law.name); });
    section.read_one(must_have("law", choice<std::string>(name, names)));
    CentralLaws::for_each([&](auto law) {
      if (name != law.name) return;
      std::vector<Key> keys = law_keys(law);
      const std::vector<Key> others = {
          must_have("law", choice<std::string>(name, names)),
          must_have("range", number(parameters.range, Range{1, 100, false, true})),
          may_have("equilibrium",
                   choice<Forces::Equilibrium>(parameters.equilibrium,
                                               {{"initial", Forces::Equilibrium::initial},
                                                {"radii", Forces::Equilibrium::radii}})),
          may_have("neighbours",
                   choice<Forces::Neighbours>(parameters.neighbours,
                                              {{"changing", Forces::Neighbours::changing},
                                               {"fixed", Forces::Neighbours::fixed}})),
          may_have("interpenetration",
                   number(parameters.interpenetration, Range{0, 1, false, false})),
          may_have("dissipation", quantity(parameters.dissipation, dimension::drag, positive)),
          may_have("skin", number(parameters.skin, Range{0, 10, false, true}))};
      keys.insert(keys.begin(), others.begin(), others.end());
      section.read(keys, std::string("the law ") + law.name);
      if (const char* complaint = law.complaint())
        section.refuse("law", complaint, "parameters that go together");
      if (!repels_down_to(law, parameters.interpenetration))
        section.refuse("interpenetration", "the law has its pole before so deep an overlap",
                       "a smaller one, or other parameters of the law");
      parameters.law = law;
    });
    if (section.has("skin") && parameters.neighbours == Forces::Neighbours::fixed)
      section.refuse("skin", "neighbours are fixed, none are sought",
                     "no skin, or neighbours = \"changing\"");
    parameters.bond_tolerance = bond_tolerance.value_or(parameters.range - 1);
    forces = parameters;
  });
}

Rule damage_section(std::optional<DamageParameters>& damage) {
  return table([&damage](const Section& section) {
    DamageParameters parameters;
    section.read({may_have("lip", number(parameters.lip, positive)),
                  may_have("every", integer(parameters.every, 1)),
                  may_have("minimal_neighbours", integer(parameters.minimal_neighbours, 1, 1000)),
                  may_have("removal_every", integer(parameters.removal_every, 1))});
    if (!section.has("lip") && !section.has("minimal_neighbours"))
      section.refuse("nothing says what is damaged", "lip or minimal_neighbours, or both");
    if (section.has("every") && !section.has("lip"))
      section.refuse("every", "no lips are looked for", "a lip beside it");
    if (section.has("removal_every") && !section.has("minimal_neighbours"))
      section.refuse("removal_every", "no element is removed", "minimal_neighbours beside it");
    damage = parameters;
  });
}

}  // namespace solidem
