// SPDX-License-Identifier: GPL-2.0-or-later
//
// [central_forces]: keys, plan, making. Names and keys of the laws come from their table.
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/central_forces.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"
#include "laws/central_interaction.hpp"

namespace solidem {

namespace {

using Forces = CentralForceParameters;

template <class Law>
Rule parameter_rule(Law& law, const LawParameter<Law>& parameter) {
  double& target = law.*parameter.place;
  switch (parameter.quantity) {
    case LawQuantity::energy:
      return quantity(target, dimension::energy, positive);
    case LawQuantity::force:
      return quantity(target, dimension::force, positive);
    case LawQuantity::stiffness:
      return quantity(target, dimension::stiffness, positive);
    case LawQuantity::ratio:
      return number(target, positive);
    case LawQuantity::exponent:
      return integer(target, 1, 100);
  }
  return {};
}

/// The keys that read the parameters of a law.
template <class Law>
std::vector<Key> law_keys(Law& law) {
  std::vector<Key> keys;
  for (const auto& parameter : Law::parameters())
    keys.push_back(
        must_have(parameter.name, parameter_rule(law, parameter),
                  std::string("the law ") + Law::name + " needs it: " + parameter.meaning));
  return keys;
}

Key law_key(std::string& name) {
  std::vector<std::pair<std::string, std::string>> names;
  CentralLaws::for_each([&names](const auto& law) { names.emplace_back(law.name, law.name); });
  return must_have("law", choice<std::string>(name, names)).means("as `solidem law list` shows");
}

/// The keys that are the same for every law.
std::vector<Key> common_keys(Forces& p) {
  return {
      must_have("range", number(p.range, Range{1, 100, false, true}))
          .means("α: elements nearer than α (R_i + R_j) act on each other"),
      may_have("equilibrium", choice<Forces::Equilibrium>(
                                  p.equilibrium, {{"initial", Forces::Equilibrium::initial},
                                                  {"radii", Forces::Equilibrium::radii}}))
          .means("initial: pairs that were neighbours at the start ([bonds] `tolerance`) keep the "
                 "distance they had then as that of equilibrium, also when they part and meet "
                 "again, all others have R_i + R_j; radii: R_i + R_j for all"),
      may_have("neighbours",
               choice<Forces::Neighbours>(p.neighbours, {{"changing", Forces::Neighbours::changing},
                                                         {"fixed", Forces::Neighbours::fixed}}))
          .means("whoever is within range, or those of the start while within range"),
      may_have("interpenetration", number(p.interpenetration, Range{0, 1, false, false}))
          .means(
              "the deepest overlap, as a fraction of the equilibrium distance, that the time step "
              "allows for, short of the pole of the law if it has one; deeper, the law goes on "
              "along its tangent, and the run tells"),
      may_have("dissipation", quantity(p.dissipation, dimension::drag, positive))
          .means("drag on the velocity at which two elements approach or part, within the range")
          .without("none"),
      may_have("skin", number(p.skin, Range{0, 10, false, true}))
          .means("mean radii: how much more than the range lists of neighbours hold; it changes "
                 "the time that a run takes, not one bit of its result")
          .without("chosen as elements move")};
}

void check(const Section& section, const Forces& p) {
  std::visit(
      [&](const auto& law) {
        if (const char* complaint = law.complaint())
          section.refuse("law", complaint, "parameters that go together");
        if (!repels_down_to(law, p.interpenetration))
          section.refuse("interpenetration", "the law has its pole before so deep an overlap",
                         "a smaller one, or other parameters of the law");
      },
      p.law);
  if (section.has("skin") && p.neighbours == Forces::Neighbours::fixed)
    section.refuse("skin", "neighbours are fixed, none are sought",
                   "no skin, or neighbours = \"changing\"");
}

void read_central_forces(const Value& value, Reading& reading) {
  table([&](const Section& section) {
    Forces p;
    std::string name;
    section.read_one(law_key(name));
    CentralLaws::for_each([&](auto law) {
      if (name != law.name) return;
      std::vector<Key> keys = common_keys(p), of_law = law_keys(law);
      keys.insert(keys.begin(), law_key(name));
      keys.insert(keys.end(), of_law.begin(), of_law.end());
      section.read(keys, std::string("the law ") + law.name);
      p.law = law;
    });
    check(section, p);
    p.bond_tolerance = reading.bond_tolerance.value_or(p.range - 1);
    reading.setup.get<Forces>() = p;
  }).read(value);
}

std::string central_kernel(const Setup& setup, bool periodic) {
  const Forces& forces = *setup.get<Forces>();
  const auto& damage = setup.get<DamageParameters>();
  std::string kernel = "move_by_central_forces, ";
  kernel += std::visit([](const auto& law) { return law.name; }, forces.law);
  if (forces.dissipation) kernel += ", dissipation";
  if (damage && damage->crack_threshold) kernel += ", cracks";
  if (periodic) kernel += ", periodic";
  return kernel;
}

void plan_central_forces(const Setup& setup, Plan& plan) {
  const auto& forces = setup.get<Forces>();
  if (!forces) return;
  const auto& damage = setup.get<DamageParameters>();
  const bool cracks = damage && damage->crack_threshold;
  plan.effects.push_back(
      {"central forces", "[central_forces]", central_kernel(setup, plan.periodic), Phase::move,
       [forces = *forces](Assembly& assembly) {
         return std::make_unique<CentralForces>(forces, assembly.mass, assembly.model);
       }});
  plan.ask("central forces", CentralForces::columns(*forces, cracks, plan.periodic));
}

void explain_central_forces(const Setup& setup, const Specimen& /*specimen*/,
                            nlohmann::ordered_json& values) {
  Forces forces = *setup.get<Forces>();
  std::visit(
      [&values](const auto& law) {
        values["law"] = law.name;
        for (const auto& parameter : law.parameters())
          values["parameters"][parameter.name] = law.*parameter.place;
      },
      forces.law);
  add_values(common_keys(forces), values);
  values["bond_tolerance"] = forces.bond_tolerance;
}

void visit_central_force_keys(const VisitKeys& visit) {
  Forces forces;
  std::string law;
  std::vector<Key> keys = common_keys(forces);
  keys.insert(keys.begin(), law_key(law));
  visit("central_forces", keys);
}

}  // namespace

EffectKind central_forces_kind() {
  EffectKind kind;
  kind.section = "central_forces";
  kind.provides = Provides::motion;
  kind.conflicts = {
      {"beams", "beams act between the same elements", "either [beams] or [central_forces]"}};
  kind.is_named = [](const Setup& setup) { return setup.get<Forces>().has_value(); };
  kind.read = read_central_forces;
  kind.visit_keys = visit_central_force_keys;
  kind.plan = plan_central_forces;
  kind.example =
      "[central_forces]\nlaw = \"piecewise\"\nstiffness = \"1500 kN/m\"\nattraction = \"25 N\"\n"
      "range = 1.2\ndissipation = \"0.02 N s/m\"\n";
  kind.explain = explain_central_forces;
  return kind;
}

}  // namespace solidem
