// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/imposed_temperature.hpp"

#include "effects/effect_kind.hpp"
#include "effects/exposed_surface.hpp"
#include "effects/heat_exchange.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heat_places.hpp"
#include "keys/rules.hpp"

namespace solidem {

ImposedTemperature::ImposedTemperature(const ImposedTemperatureParameters& parameters,
                                       std::vector<std::int32_t> elements,
                                       const Conduction& conduction, Model& model)
    : parameters_(parameters), elements_(std::move(elements)), conduction_(conduction) {
  impose(model, model.data(columns::temperature), temperature(0));
}

void ImposedTemperature::impose(const Model& model, double* temperature, double value) {
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    heat_ += conduction_.heat(model, i, temperature[i], value);
    temperature[i] = value;
  }
}

void ImposedTemperature::advance(Model& model, const Step& step) {
  impose(model, model.next(columns::temperature), temperature(step.time + step.time_step));
}

void ImposedTemperature::observe(const Model& /*model*/, Observation& observation) const {
  observation.heat.heat_input += heat_;
  observation.add("temperature." + parameters_.name + ".value", temperature(observation.time));
  observation.add("temperature." + parameters_.name + ".heat", heat_);
}

namespace {

std::vector<Key> temperature_keys(ImposedTemperatureParameters& p, Reading& reading) {
  return {
      must_have("name", name(p.name, reading.taken)).means("names its columns"),
      may_have("region", region(p.region, reading.regions))
          .means("its elements have this temperature; " + std::string(region_of_exposed))
          .without("either this"),
      may_have("wall", wall(p.wall))
          .means("its surface has this temperature, heat flows from it to the elements' centres")
          .without("or this"),
      must_have("value", function(p.temperature, dimension::temperature, not_negative))};
}

void finish_temperature(const Section& section, ImposedTemperatureParameters& p,
                        Reading& /*reading*/) {
  if (p.wall != ExposedSurface::word) section.exactly_one_of({"region", "wall"});
}

std::unique_ptr<Effect> make_held_wall(const ImposedTemperatureParameters& imposed,
                                       Assembly& assembly) {
  return std::make_unique<HeatExchange>(
      imposed, faces_of(assembly, "temperatures", imposed.name, imposed.wall, imposed.region),
      assembly.need<Conduction>());
}

std::unique_ptr<Effect> make_held_elements(const ImposedTemperatureParameters& imposed,
                                           Assembly& assembly) {
  std::vector<std::int32_t> elements =
      select_conducting(assembly, "[[temperatures]] \"" + imposed.name + "\"", imposed.region);
  assembly.selections["temperature." + imposed.name] = elements;
  assembly.claim("[[temperatures]]", imposed.name, elements);
  return std::make_unique<ImposedTemperature>(imposed, std::move(elements),
                                              assembly.need<Conduction>(), assembly.model);
}

void plan_temperatures(const Setup& setup, Plan& plan) {
  // Elements that are held come last: they are set after others have changed them.
  for (const bool of_wall : {true, false})
    for (const ImposedTemperatureParameters& imposed : setup.all<ImposedTemperatureParameters>())
      if (imposed.wall.empty() != of_wall) {
        plan_exposed_surface(imposed.wall, "[[temperatures]]", plan);
        plan.effects.push_back({"temperature " + imposed.name, "[[temperatures]]", "", Phase::heat,
                                [imposed, of_wall](Assembly& assembly) {
                                  return of_wall ? make_held_wall(imposed, assembly)
                                                 : make_held_elements(imposed, assembly);
                                }});
      }
}

}  // namespace

EffectKind temperatures_kind() {
  EffectKind kind =
      list_kind<ImposedTemperatureParameters>("temperatures", temperature_keys, finish_temperature);
  kind.needs = Provides::heat;
  kind.plan = plan_temperatures;
  kind.example =
      "[[temperatures]]\n"
      "name = \"hot\"\n"
      "region = { axis = \"x\", side = \"high\", layers = 1 }\n"
      "value = \"400 K\"\n"
      "\n"
      "[[temperatures]]\n"
      "name = \"cold\"\n"
      "wall = \"x_low\"\n"
      "value = \"280 K\"\n";
  return kind;
}

}  // namespace solidem
