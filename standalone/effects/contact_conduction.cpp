// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/contact_conduction.hpp"

#include "effects/assembly.hpp"
#include "effects/contact.hpp"
#include "effects/effect_kind.hpp"
#include "effects/tools.hpp"
#include "keys/rules.hpp"
#include "laws/contact_exchange.hpp"

namespace solidem {

namespace {

/// Whether heat passes between two elements without a contact.
bool conduct_already(const Model& model, const Pair& pair) {
  const auto place = model.conductors().find(pair.i, pair.j);
  if (!place) return false;
  const Column& column =
      model.has(columns::conductance) ? columns::conductance : columns::conduction_length;
  return model.data(column)[place->index()] > 0;
}

}  // namespace

ContactConduction::ContactConduction(const ContactConductionParameters& parameters,
                                     const Conduction& conduction, const ElementContacts* contacts,
                                     const std::vector<Tool*>& tools)
    : parameters_(parameters), conduction_(conduction), contacts_(contacts) {
  for (const Tool* tool : tools)
    if (tool->temperature()) tools_.push_back(tool);
  of_tools_.assign(tools_.size(), 0.0);
}

double ContactConduction::conductance(double curvature, double other_curvature,
                                      double overlap) const {
  if (parameters_.conductance) return *parameters_.conductance;
  return *parameters_.coefficient * overlap_area(curvature, other_curvature, overlap);
}

void ContactConduction::list_ways(const Model& model) {
  const std::vector<double>& radius = model.specimen().radius;
  const auto curvature = [&](std::int32_t element) {
    return 1 / radius[static_cast<std::size_t>(element)];
  };
  ways_.clear();
  if (contacts_ != nullptr)
    contacts_->for_each_acting([&](const Pair& pair, double overlap) {
      if (!conduct_already(model, pair))
        ways_.push_back(
            {pair.i, pair.j, conductance(curvature(pair.i), curvature(pair.j), overlap)});
    });
  for (std::size_t k = 0; k < tools_.size(); ++k)
    tools_[k]->for_each_touch([&](std::int32_t element, double overlap) {
      ways_.push_back({element, -1 - static_cast<std::int32_t>(k),
                       conductance(curvature(element), 0, overlap)});
    });
}

void ContactConduction::exchange(Model& model, const Way& way, const Step& part) {
  double* temperature = model.data(columns::temperature);
  const auto i = static_cast<std::size_t>(way.element);
  const double before = temperature[i];
  const double inverse = 1 / conduction_.capacity(model, i, before);
  if (way.other < 0) {
    const auto k = static_cast<std::size_t>(-1 - way.other);
    const double outside = (*tools_[k]->temperature())(part.time + 0.5 * part.time_step);
    temperature[i] = conduction_.heated(
        model, i, before,
        exchanged_heat(way.conductance, inverse, outside - before, part.time_step));
    of_tools_[k] += conduction_.heat(model, i, before, temperature[i]);
    return;
  }
  const auto j = static_cast<std::size_t>(way.other);
  const double other = temperature[j];
  const double heat =
      exchanged_heat(way.conductance, inverse + 1 / conduction_.capacity(model, j, other),
                     other - before, part.time_step);
  temperature[i] = conduction_.heated(model, i, before, heat);
  temperature[j] = conduction_.heated(model, j, other, -heat);
}

void ContactConduction::deliver(Model& model, const Step& step) {
  list_ways(model);
  const double half = 0.5 * step.time_step;
  for (const Way& way : ways_) exchange(model, way, {step.time, half, half});
  for (auto way = ways_.rbegin(); way != ways_.rend(); ++way)
    exchange(model, *way, {step.time + half, half, half});
}

void ContactConduction::observe(const Model& /*model*/, Observation& observation) const {
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    observation.heat.heat_input += of_tools_[k];
    observation.add("tool." + tools_[k]->name() + ".conducted_heat", of_tools_[k]);
  }
}

namespace {

constexpr Dimension thermal_conductance{"a thermal conductance", "W/K", "0.01 W/K"};

std::vector<Key> contact_conduction_keys(ContactConductionParameters& p, Reading& /*reading*/) {
  return {may_have("coefficient", quantity(p.coefficient, dimension::heat_transfer, positive))
              .means("of the circle in which two overlap, so that pressure makes more of it")
              .without("either this"),
          may_have("conductance", quantity(p.conductance, thermal_conductance, positive))
              .means("of each contact, however hard it is pressed")
              .without("or this")};
}

void finish_contact_conduction(const Section& section, ContactConductionParameters& /*p*/,
                               Reading& /*reading*/) {
  section.exactly_one_of({"coefficient", "conductance"});
}

void plan_contact_conduction(const Setup& setup, Plan& plan) {
  const auto& parameters = setup.get<ContactConductionParameters>();
  if (!parameters) return;
  plan.effects.push_back({"contact conduction", "[contact_conduction]", "", Phase::heat,
                          [parameters = *parameters](Assembly& assembly) {
                            return std::make_unique<ContactConduction>(
                                parameters, assembly.need<Conduction>(),
                                assembly.find<ElementContacts>(), assembly.all<Tool>());
                          }});
}

}  // namespace

EffectKind contact_conduction_kind() {
  EffectKind kind = single_kind<ContactConductionParameters>(
      "contact_conduction", contact_conduction_keys, finish_contact_conduction);
  kind.needs = Provides::heat;
  kind.beside = {"contact", "tools"};
  kind.problem_alone = "nothing touches";
  kind.plan = plan_contact_conduction;
  kind.example =
      "[contact_conduction]\n"
      "coefficient = \"1e6 W/(m^2 K)\"\n";
  return kind;
}

}  // namespace solidem
