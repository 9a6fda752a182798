// SPDX-License-Identifier: GPL-2.0-or-later
//
// Keys of the laws of bonds, made from their tables: laws/yield_laws.hpp, laws/rupture_laws.hpp.
#ifndef SOLIDEM_EFFECTS_BOND_LAW_KEYS_HPP
#define SOLIDEM_EFFECTS_BOND_LAW_KEYS_HPP

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "effects/beam_parameters.hpp"
#include "keys/rules.hpp"

namespace solidem {

/// The key that names a law of a table; `name` holds the default.
template <class Table>
Key law_name_key(const char* key, std::string& name) {
  std::vector<std::pair<std::string, std::string>> names;
  Table::for_each([&names](const auto& law) { names.emplace_back(law.name, law.name); });
  name = names.front().first;
  return may_have(key, choice<std::string>(name, names));
}

/// The rule of a parameter that is not given as a stress.
template <class Law>
Rule rule_of(const BondLawParameter<Law>& parameter, double& target) {
  const Range& range = parameter.bound == LawBound::above_zero ? positive : not_negative;
  if (parameter.unit == LawUnit::temperature)
    return quantity(target, dimension::temperature, range);
  if (parameter.unit == LawUnit::rate) return quantity(target, dimension::rate, range);
  return number(target, range);
}

/// Keys of the parameters of a law of bonds: as numbers, and as stresses that stand for them times
/// Young's modulus; `stresses` takes these until read_stresses().
template <class Law>
std::vector<Key> bond_law_keys(Law& law, std::map<std::string, double>& stresses) {
  std::vector<Key> keys;
  for (const auto& parameter : Law::parameters()) {
    const Range& range = parameter.bound == LawBound::above_zero ? positive : not_negative;
    keys.push_back(may_have(parameter.name, rule_of(parameter, law.*parameter.member)));
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
  std::string name;
  const Key law_key = law_name_key<Table>(key, name);
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

/// A table of names as the rule of a key takes it.
template <class Choice, std::size_t count>
std::vector<std::pair<std::string, Choice>> choices_of(const NamedChoice<Choice> (&table)[count]) {
  std::vector<std::pair<std::string, Choice>> choices;
  for (const auto& named : table) choices.emplace_back(named.name, named.choice);
  return choices;
}

/// The key that says where along a beam its bending is judged.
inline Key section_key(JudgedSection& section) {
  return may_have("section", choice<JudgedSection>(section, choices_of(judged_sections)))
      .means(
          "where along a beam its bending counts: at mid-length, where a beam that is sheared with "
          "its rotations held has none; at the end that is bent more; wherever it is largest");
}

/// What a page says of a parameter that may be given as a number or as a stress.
template <class Law>
std::string without_parameter(const BondLawParameter<Law>& parameter) {
  if (!parameter.is_required) return "none";
  return parameter.stress_name == nullptr ? "needed by it" : "this or the other is needed by it";
}

/// Shows the keys of every law of a table after those that they share.
template <class Table>
void visit_law_keys(const std::string& section, const char* key, std::vector<Key> keys,
                    const std::function<void(const std::string&, const std::vector<Key>&)>& visit) {
  std::string name;
  keys.push_back(law_name_key<Table>(key, name));
  std::map<std::string, double> stresses;
  Table::for_each([&](auto law) {
    for (const auto& parameter : law.parameters()) {
      const std::string meaning = std::string("of `") + law.name + "`: " + parameter.meaning;
      const Range& range = parameter.bound == LawBound::above_zero ? positive : not_negative;
      double ignored = 0;
      keys.push_back(may_have(parameter.name, rule_of(parameter, ignored))
                         .means(meaning + (parameter.stress_name != nullptr ? ", over E" : ""))
                         .without(without_parameter(parameter)));
      if (parameter.stress_name != nullptr)
        keys.push_back(may_have(parameter.stress_name, quantity(ignored, dimension::modulus, range))
                           .means(meaning)
                           .without(without_parameter(parameter)));
    }
  });
  visit(section, keys);
}

/// Adds the parameters of a law of bonds; one that is without limit is null.
template <class AnyLaw>
void add_parameters(nlohmann::ordered_json& json, const AnyLaw& any) {
  std::visit(
      [&](const auto& law) {
        for (const auto& parameter : law.parameters()) {
          const double value = law.*parameter.member;
          json[parameter.name] = std::isfinite(value) ? nlohmann::ordered_json(value)
                                                      : nlohmann::ordered_json(nullptr);
        }
      },
      any);
}

}  // namespace solidem

#endif
