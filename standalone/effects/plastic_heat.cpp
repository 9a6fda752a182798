// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/plastic_heat.hpp"

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"
#include "model/blocks.hpp"

namespace solidem {

void PlasticHeat::deliver(Model& model) {
  const double* work = model.data(columns::plastic_work);
  double* given = model.data(columns::plastic_heat);
  double* temperature = model.data(columns::temperature);
  const std::size_t elements = model.elements();
  for_blocks(elements, 1 << 14, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double heat = parameters_.fraction * work[i] - given[i];
      if (heat == 0) continue;
      const double before = temperature[i];
      temperature[i] = conduction_.heated(model, i, before, heat);
      given[i] += conduction_.heat(model, i, before, temperature[i]);
    }
  });
}

void PlasticHeat::observe(const Model& model, Observation& observation) const {
  const double* given = model.data(columns::plastic_heat);
  long double delivered = 0;
  for (std::size_t i = 0; i < model.elements(); ++i) delivered += given[i];
  const auto heat = static_cast<double>(delivered);
  const double whole = parameters_.fraction * observation.energies.of("plastic_work");
  observation.heat.heat_input += heat;
  observation.add("plastic_heat", whole);
  observation.add("waiting_heat", whole - heat);
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
