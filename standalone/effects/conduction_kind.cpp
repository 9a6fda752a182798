// SPDX-License-Identifier: GPL-2.0-or-later
//
// [conduction] and [[thermal_contacts]], surfaces between two materials: keys, plan, making.
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/bond_temperature.hpp"
#include "effects/conduction.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/effect_kind.hpp"
#include "effects/friction_heat.hpp"
#include "effects/heat_clock.hpp"
#include "effects/plastic_heat.hpp"
#include "effects/temperature_function_json.hpp"
#include "keys/rules.hpp"

namespace solidem {

namespace {

using Law = ConductionParameters::Law;
using Integrator = ConductionParameters::Integrator;
using BrokenBonds = ConductionParameters::BrokenBonds;

std::vector<Key> conduction_keys(ConductionParameters& p, Reading& /*reading*/) {
  return {
      may_have("law", choice<Law>(p.law, {{"platonic", Law::platonic},
                                          {"platonic-calibrated", Law::platonic_calibrated},
                                          {"voronoi", Law::voronoi}})),
      must_have("initial_temperature",
                quantity(p.initial_temperature, dimension::temperature, not_negative)),
      may_have("area_factor", number(p.area_factor, positive))
          .means("of `platonic-calibrated`: scales the areas")
          .without("found by a steady bar test"),
      may_have("integrator",
               choice<Integrator>(p.integrator, {{"explicit", Integrator::explicit_euler},
                                                 {"rkl2", Integrator::rkl2},
                                                 {"implicit", Integrator::implicit},
                                                 {"auto", Integrator::automatic}})),
      may_have("tolerance", quantity(p.tolerance, dimension::temperature_difference, positive))
          .means("error allowed in a step; not with `explicit`, needed by `auto`")
          .without("none: the steps of `[run]`"),
      may_have("broken_bonds", choice<std::optional<BrokenBonds>>(
                                   p.broken_bonds, {{"insulate", BrokenBonds::insulate},
                                                    {"conduct", BrokenBonds::conduct}}))
          .means("a pair whose bond broke conducts no heat any more, or goes on as before; with "
                 "`[rupture]`")
          .without("`\"insulate\"`"),
      may_have("every", integer(p.every, 1))
          .means("steps of the motion from one step of heat to the next, which is as long as all "
                 "of them"),
      may_have("largest_change",
               quantity(p.largest_change, dimension::temperature_difference, positive))
          .means("in place of `every`: heat waits as long as is stable and no temperature changes "
                 "by more from one of its steps to the next")
          .without("as `every` says")};
}

void finish_conduction(const Section& section, ConductionParameters& p, Reading& reading) {
  if (p.area_factor && p.law != Law::platonic_calibrated)
    section.refuse("area_factor", "the law has no such factor",
                   "law = \"platonic-calibrated\" beside it");
  if (p.tolerance && p.integrator == Integrator::explicit_euler)
    section.refuse("tolerance", "explicit Euler takes the steps of [run]",
                   "integrator = \"rkl2\", \"implicit\" or \"auto\" beside it");
  if (!p.tolerance && p.integrator == Integrator::automatic)
    section.refuse("integrator", "nothing says how accurate",
                   "tolerance beside it, such as \"0.1 K\"");
  if (p.broken_bonds && !reading.setup.get<RuptureParameters>())
    section.refuse("broken_bonds", "no bond ever breaks",
                   "a section [rupture] beside it, or no broken_bonds");
  section.at_most_one_of({"every", "largest_change"});
  for (const char* key : {"every", "largest_change"})
    if (section.has(key) && !provides(reading.setup, Provides::motion))
      section.refuse(key, "nothing moves, so heat has the steps of [run] for itself",
                     sections_that_provide({Provides::motion}));
}

/// The hot loop of conduction: a whole explicit step where it can be, else the power alone.
std::string heat_kernel(const Setup& setup, const ConductionParameters& conduction) {
  const bool conductivity = conductivity_varies(setup.materials);
  const bool is_fused = !conductivity && !capacity_varies(setup.materials) &&
                        conduction.integrator == Integrator::explicit_euler;
  std::string kernel = is_fused ? "conduct" : "conducted_power";
  if (conductivity) kernel += ", conductivity from the temperature";
  if (conductivity && !conduction.contacts.empty()) kernel += ", contacts";
  return kernel;
}

std::unique_ptr<Effect> make_conduction(const ConductionParameters& parameters,
                                        Assembly& assembly) {
  auto conduction = std::make_unique<Conduction>(
      parameters, ThermalProperties{assembly.setup.materials, assembly.material}, assembly.geometry,
      assembly.model);
  if (assembly.setup.get<RuptureParameters>())
    conduction->watch_bonds(parameters.broken_bonds.value_or(BrokenBonds::insulate),
                            assembly.geometry, assembly.model);
  return conduction;
}

/// What a user might expect of heat and motion together, and would not get.
void note_what_stays_apart(const Setup& setup, Plan& plan) {
  std::vector<std::string> apart;
  if (!setup.get<PlasticHeatParameters>() && !setup.get<FrictionHeatParameters>())
    apart.emplace_back("no work warms elements");
  if (!setup.get<ExpansionParameters>())
    apart.emplace_back("temperature does not change their size (no thermal expansion)");
  if (!setup.get<SofteningParameters>())
    apart.emplace_back("temperature does not change how stiff the forces between them are");
  if (!apart.empty()) plan.notes.push_back(join(apart));
}

void plan_conduction(const Setup& setup, Plan& plan) {
  const auto& conduction = setup.get<ConductionParameters>();
  if (!conduction) return;
  plan.effects.push_back({"conduction", "[conduction]", heat_kernel(setup, *conduction),
                          Phase::heat, [conduction = *conduction](Assembly& assembly) {
                            return make_conduction(conduction, assembly);
                          }});
  plan.ask("conduction", Conduction::columns(*conduction, setup.materials));
  if (conduction->every > 1 || conduction->largest_change)
    plan.effects.push_back(
        {"heat clock", "[conduction]", "", Phase::heat, [conduction = *conduction](Assembly&) {
           return std::make_unique<HeatClock>(conduction);
         }});
  if (provides(setup, Provides::motion)) note_what_stays_apart(setup, plan);
}

/// The entry of a table of surfaces between materials, as it is read.
std::vector<Key> contact_keys(Contact& p, Reading& reading) {
  std::vector<std::pair<std::string, std::string>> known;
  for (const Material& material : reading.setup.materials)
    if (!material.name.empty()) known.emplace_back(material.name, material.name);
  const std::string expected = "the names of two materials";
  const Rule between = {expected, [&p, known, expected](const Value& value) {
                          const std::vector<Value> names = value.entries(2, expected);
                          choice<std::string>(p.first, known).read(names[0]);
                          choice<std::string>(p.second, known).read(names[1]);
                          if (p.first == p.second) value.refuse("twice the same", expected);
                        }};
  return {must_have("between", between),
          must_have("conductance", quantity(p.conductance, dimension::heat_transfer, positive))
              .means("materials without one touch perfectly")};
}

}  // namespace

EffectKind conduction_kind() {
  EffectKind kind =
      single_kind<ConductionParameters>("conduction", conduction_keys, finish_conduction);
  kind.provides = Provides::heat;
  kind.example =
      "[conduction]\n"
      "law = \"platonic\"\n"
      "initial_temperature = \"298 K\"\n";
  kind.plan = plan_conduction;
  kind.explain = [values = kind.explain](const Setup& setup, const Specimen& specimen,
                                         nlohmann::ordered_json& json) {
    values(setup, specimen, json);
    json["conductivity"] = to_json(setup.materials[0].conductivity);
    json["specific_heat_capacity"] = to_json(setup.materials[0].specific_heat);
  };
  return kind;
}

EffectKind thermal_contacts_kind() {
  EffectKind kind = list_kind<Contact>("thermal_contacts", contact_keys, as_read<Contact>);
  kind.example =
      "[[thermal_contacts]]\n"
      "between = [\"left\", \"right\"]\n"
      "conductance = \"1e5 W/(m^2 K)\"\n";
  kind.needs = Provides::heat;
  kind.is_named = [](const Setup& setup) {
    const auto& conduction = setup.get<ConductionParameters>();
    return conduction && !conduction->contacts.empty();
  };
  kind.read = [read = kind.read](const Value& value, Reading& reading) {
    read(value, reading);
    auto& conduction = reading.setup.get<ConductionParameters>();
    if (conduction) conduction->contacts = reading.setup.all<Contact>();
  };
  return kind;
}

}  // namespace solidem
