// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/friction_heat.hpp"

#include <algorithm>

#include "effects/assembly.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/contact.hpp"
#include "effects/delivered_heat.hpp"
#include "effects/effect_kind.hpp"
#include "effects/tools.hpp"
#include "keys/rules.hpp"

namespace solidem {

FrictionHeat::FrictionHeat(const FrictionHeatParameters& parameters, std::vector<double> effusivity,
                           const Conduction& conduction, ElementContacts* contacts,
                           const std::vector<Tool*>& tools)
    : heat_(parameters.fraction, parameters.damping_fraction, std::move(effusivity)),
      conduction_(conduction) {
  if (contacts != nullptr) contacts->warm(heat_);
  for (Tool* tool : tools) tool->warm(heat_);
}

void FrictionHeat::deliver(Model& model, const Step& /*step*/) {
  deliver_heat(model, conduction_, 1, columns::friction_heat, columns::given_friction_heat);
}

void FrictionHeat::observe(const Model& model, Observation& observation) const {
  const double given = sum_of(model, columns::given_friction_heat);
  observation.heat.heat_input += given;
  observation.add("friction_heat", heat_.of(observation.energies.of("friction"),
                                            observation.energies.of("contact_damping")));
  observe_waiting_heat(observation, sum_of(model, columns::friction_heat) - given);
}

namespace {

std::vector<Key> friction_heat_keys(FrictionHeatParameters& p, Reading& /*reading*/) {
  return {may_have("fraction", number(p.fraction, Range{0, 1, true, true}))
              .means("of the work of friction in contacts that becomes heat of both sides"),
          may_have("damping_fraction", number(p.damping_fraction, Range{0, 1, true, true}))
              .means("of what the dashpots of contacts take, the same")};
}

/// Of each element, W s^½/(m² K), at the temperature at which it begins.
std::vector<double> effusivities(const Assembly& assembly) {
  const double temperature = assembly.setup.get<ConductionParameters>()->initial_temperature;
  std::vector<double> of_material, of_element;
  for (const Material& material : assembly.setup.materials)
    of_material.push_back(effusivity_of(material.conductivity(temperature), material.density,
                                        material.specific_heat(temperature)));
  for (std::size_t i = 0; i < assembly.specimen().size(); ++i)
    of_element.push_back(of_material[assembly.material.empty() ? 0 : assembly.material[i]]);
  return of_element;
}

void plan_friction_heat(const Setup& setup, Plan& plan) {
  const auto& parameters = setup.get<FrictionHeatParameters>();
  if (!parameters) return;
  plan.effects.push_back({"friction heat", "[friction_heat]", "", Phase::heat,
                          [parameters = *parameters](Assembly& assembly) {
                            return std::make_unique<FrictionHeat>(
                                parameters, effusivities(assembly), assembly.need<Conduction>(),
                                assembly.find<ElementContacts>(), assembly.all<Tool>());
                          }});
  plan.ask("friction heat", FrictionHeat::columns());
}

}  // namespace

EffectKind friction_heat_kind() {
  EffectKind kind = single_kind<FrictionHeatParameters>("friction_heat", friction_heat_keys,
                                                        as_read<FrictionHeatParameters>);
  kind.needs = Provides::heat;
  kind.beside = {"tools", "contact"};
  kind.problem_alone = "nothing rubs";
  kind.plan = plan_friction_heat;
  kind.example =
      "[friction_heat]\n"
      "damping_fraction = 0.5\n";
  return kind;
}

}  // namespace solidem
