// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/plastic_heat.hpp"

#include "effects/assembly.hpp"
#include "effects/delivered_heat.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"

namespace solidem {

void PlasticHeat::deliver(Model& model, const Step& /*step*/) {
  deliver_heat(model, conduction_, parameters_.fraction, columns::plastic_work,
               columns::plastic_heat);
}

void PlasticHeat::observe(const Model& model, Observation& observation) const {
  const double given = sum_of(model, columns::plastic_heat);
  const double whole = parameters_.fraction * observation.energies.of("plastic_work");
  observation.heat.heat_input += given;
  observation.add("plastic_heat", whole);
  observe_waiting_heat(observation, whole - given);
}

namespace {

std::vector<Key> plastic_heat_keys(PlasticHeatParameters& p, Reading& /*reading*/) {
  return {
      may_have("fraction", number(p.fraction, Range{0, 1, true, true}))
          .means("β of Taylor and Quinney: of the plastic work of bonds that becomes heat, half "
                 "of it in either end")};
}

void plan_plastic_heat(const Setup& setup, Plan& plan) {
  const auto& parameters = setup.get<PlasticHeatParameters>();
  if (!parameters) return;
  plan.effects.push_back({"plastic heat", "[plastic_heat]", "", Phase::heat,
                          [parameters = *parameters](Assembly& assembly) {
                            return std::make_unique<PlasticHeat>(parameters,
                                                                 assembly.need<Conduction>());
                          }});
  plan.ask("plastic heat", PlasticHeat::columns());
}

}  // namespace

EffectKind plastic_heat_kind() {
  EffectKind kind = single_kind<PlasticHeatParameters>("plastic_heat", plastic_heat_keys,
                                                       as_read<PlasticHeatParameters>);
  kind.needs = Provides::heat;
  kind.beside = {"plasticity"};
  kind.problem_alone = "no bond flows";
  kind.plan = plan_plastic_heat;
  kind.example =
      "[plastic_heat]\n"
      "fraction = 0.9\n";
  return kind;
}

}  // namespace solidem
