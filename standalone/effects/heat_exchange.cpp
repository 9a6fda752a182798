// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_exchange.hpp"

#include "effects/effect_kind.hpp"
#include "effects/exposed_surface.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heat_places.hpp"
#include "keys/rules.hpp"
#include "laws/heat_exchange.hpp"

namespace solidem {

HeatExchange::HeatExchange(const ImposedTemperatureParameters& parameters, HeatedFaces faces,
                           const Conduction& conduction)
    : HeatLoad("temperature." + parameters.name),
      faces_(std::move(faces)),
      outside_(parameters.temperature),
      conduction_(conduction) {}

HeatExchange::HeatExchange(const ConvectionParameters& parameters, HeatedFaces faces,
                           const Conduction& conduction)
    : HeatLoad("convection." + parameters.name),
      faces_(std::move(faces)),
      outside_(parameters.temperature),
      coefficient_(parameters.coefficient),
      conduction_(conduction) {}

double HeatExchange::conductance(const WallFace& face, double conductivity,
                                 double coefficient) const {
  const double path = path_conductance(conductivity, face.area, face.distance);
  return coefficient_ ? series_conductance(path, coefficient * face.area) : path;
}

void HeatExchange::powers(double time, const double* temperature,
                          std::vector<ElementValue>& powers) const {
  const std::size_t first = powers.size();
  conductances(time, temperature, powers);
  const double outside = outside_(time);
  for (std::size_t k = first; k < powers.size(); ++k)
    powers[k].value *= outside - temperature[powers[k].element];
}

void HeatExchange::conductances(double time, const double* temperature,
                                std::vector<ElementValue>& conductances) const {
  const double h = coefficient(time);
  for (const WallFace& face : *faces_.now) {
    const auto i = static_cast<std::size_t>(face.element);
    conductances.push_back(
        {face.element, conductance(face, conduction_.conductivity(i, temperature[i]), h)});
  }
}

void HeatExchange::largest_conductances(std::vector<ElementValue>& conductances) const {
  const double h = coefficient_ ? coefficient_->largest() : 0;
  for (const WallFace& face : faces_.largest) {
    const auto i = static_cast<std::size_t>(face.element);
    conductances.push_back(
        {face.element, conductance(face, conduction_.largest_conductivity(i), h)});
  }
}

void HeatExchange::observe(const Model& model, Observation& observation) const {
  observation.add(column() + ".value", outside_(observation.time));
  HeatLoad::observe(model, observation);
}

namespace {

std::vector<Key> convection_keys(ConvectionParameters& p, Reading& reading) {
  return {must_have("name", name(p.name, reading.taken)).means("names its columns"),
          must_have("wall", wall(p.wall)),
          may_have("region", region(p.region, reading.regions))
              .means(region_of_exposed)
              .without("all of it"),
          must_have("coefficient", function(p.coefficient, dimension::heat_transfer, not_negative)),
          must_have("temperature", function(p.temperature, dimension::temperature, not_negative))
              .means("of the fluid")};
}

void finish_convection(const Section& section, ConvectionParameters& p, Reading& /*reading*/) {
  check_exposed_region(section, p.wall);
}

void plan_convections(const Setup& setup, Plan& plan) {
  for (const ConvectionParameters& convection : setup.all<ConvectionParameters>()) {
    plan_exposed_surface(convection.wall, "[[convections]]", plan);
    plan.effects.push_back({"convection " + convection.name, "[[convections]]", "", Phase::heat,
                            [convection](Assembly& assembly) {
                              return std::make_unique<HeatExchange>(
                                  convection,
                                  faces_of(assembly, "convections", convection.name,
                                           convection.wall, convection.region),
                                  assembly.need<Conduction>());
                            }});
  }
}

}  // namespace

EffectKind convections_kind() {
  EffectKind kind =
      list_kind<ConvectionParameters>("convections", convection_keys, finish_convection);
  kind.needs = Provides::heat;
  kind.plan = plan_convections;
  kind.example =
      "[[convections]]\n"
      "name = \"air\"\n"
      "wall = \"z_high\"\n"
      "coefficient = \"1000 W/(m^2 K)\"\n"
      "temperature = \"350 K\"\n";
  return kind;
}

}  // namespace solidem
