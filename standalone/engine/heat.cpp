// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/heat.hpp"

#include <algorithm>

#include "effects/heat_exchange.hpp"
#include "effects/heat_flux.hpp"
#include "effects/heat_source.hpp"
#include "engine/heated_model.hpp"
#include "model/error.hpp"
#include "solve/heat_integrator.hpp"
#include "solve/relative_conductivity.hpp"

namespace solidem {

namespace {

/// The faces of a wall. Throws InputError when the body has no such wall or no element is there.
std::vector<WallFace> faces_of(const ConductionGeometry& geometry, const char* section,
                               const std::string& name, const std::string& wall,
                               const Specimen& specimen) {
  const auto found = geometry.walls.find(wall);
  const std::string place =
      std::string("[[") + section + "]] \"" + name + "\": wall = \"" + wall + "\"";
  if (found == geometry.walls.end()) {
    std::string known;
    for (const std::string& other : wall_names(specimen.domain))
      known += (known.empty() ? "" : ", ") + other;
    throw InputError(place + ": the body has no such wall; expected one of " +
                     (known.empty()
                          ? "those of a shape: this body (" + specimen.domain.shape + ") has none"
                          : known));
  }
  if (found->second.empty())
    throw InputError(place +
                     ": no element reaches it; expected a body that fills its bounds, or a region "
                     "in place of the wall");
  return found->second;
}

/// Refuses a source that heats nothing all the time.
void check_source(const HeatSourceParameters& parameters, const HeatSource& source, double duration,
                  const Specimen& specimen) {
  constexpr int looks = 400;
  for (int k = 0; k <= looks; ++k)
    if (source.reaches(duration * k / looks)) return;
  throw InputError("[[heat_sources]] \"" + parameters.name +
                   "\": outside the body at all times of the run; expected a shape that meets the "
                   "body, which lies between " +
                   bounds(specimen));
}

/// The elements of a region. Refuses elements of which none conducts.
std::vector<std::int32_t> select_conducting(Selections& selections, const std::string& name,
                                            const Region& region,
                                            const std::vector<int>& neighbours,
                                            const Specimen& specimen) {
  std::vector<std::int32_t> elements = select_some(selections, name, region, specimen);
  const bool all_alone = std::all_of(elements.begin(), elements.end(), [&](std::int32_t e) {
    return neighbours[static_cast<std::size_t>(e)] == 0;
  });
  if (all_alone)
    throw InputError(name + ": none of the " + std::to_string(elements.size()) +
                     " elements of its region has a neighbour to pass heat to, " +
                     place(specimen, static_cast<std::size_t>(elements[0])) +
                     " for one; expected a larger region, [bonds] tolerance = 0.05, or law = "
                     "\"voronoi\"");
  return elements;
}

}  // namespace

ConductionGeometry scaled_geometry(const ConductionParameters& parameters, const Specimen& specimen,
                                   std::optional<double> area_factor) {
  ConductionGeometry geometry = conduction_geometry(parameters.law, specimen);
  if (parameters.law == ConductionParameters::Law::platonic_calibrated)
    calibrate(geometry, area_factor ? *area_factor : 1 / relative_conductivity(geometry, specimen),
              specimen.domain.volume);
  return geometry;
}

Heat::Heat(const Setup& setup, ConductionGeometry geometry,
           const std::vector<std::size_t>& material, Model& model, Selections& selections)
    : parameters_(*setup.conduction),
      sources_(setup.heat_sources),
      model_(model),
      area_factor_(geometry.area_factor) {
  auto conduction = std::make_unique<Conduction>(
      parameters_, ThermalProperties{setup.materials, material}, geometry, model);
  conduction_ = conduction.get();
  if (setup.rupture)
    conduction_->watch_bonds(
        parameters_.broken_bonds.value_or(ConductionParameters::BrokenBonds::insulate), geometry,
        model);
  effects_.push_back(std::move(conduction));
  const auto add_load = [&](std::unique_ptr<HeatLoad> load) {
    loads_.push_back(load.get());
    effects_.push_back(std::move(load));
  };
  const auto faces = [&](const char* section, const std::string& name, const std::string& wall) {
    return faces_of(geometry, section, name, wall, model.specimen());
  };
  const std::vector<int> neighbours = model.conductors().coordination();
  // What no heat could leave again takes none: it would only grow hotter and hotter.
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (neighbours[i] == 0) geometry.volume[i] = 0;
  for (const HeatSourceParameters& source : setup.heat_sources) {
    std::vector<std::int32_t> elements;
    if (source.region)
      elements = select_conducting(selections, "heat_source." + source.name, *source.region,
                                   neighbours, model.specimen());
    add_load(std::make_unique<HeatSource>(source, elements, geometry.volume, model.specimen()));
  }
  for (const HeatFluxParameters& flux : setup.heat_fluxes)
    add_load(std::make_unique<HeatFlux>(flux, faces("heat_fluxes", flux.name, flux.wall)));
  for (const ConvectionParameters& convection : setup.convections)
    add_load(std::make_unique<HeatExchange>(
        convection, faces("convections", convection.name, convection.wall), *conduction_));
  for (const ImposedTemperatureParameters& imposed : setup.temperatures)
    if (!imposed.wall.empty())
      add_load(std::make_unique<HeatExchange>(
          imposed, faces("temperatures", imposed.name, imposed.wall), *conduction_));
  std::map<std::int32_t, std::string> heated;
  for (const ImposedTemperatureParameters& imposed : setup.temperatures) {
    if (!imposed.wall.empty()) continue;
    std::vector<std::int32_t> elements = select_conducting(
        selections, "temperature." + imposed.name, imposed.region, neighbours, model.specimen());
    claim(heated, elements, "[[temperatures]]", imposed.name, model.specimen());
    auto effect =
        std::make_unique<ImposedTemperature>(imposed, std::move(elements), *conduction_, model);
    imposed_.push_back(effect.get());
    effects_.push_back(std::move(effect));
  }
  const std::vector<ElementValue> exchange = largest_exchange();
  criterion_ = conduction_->time_step_criterion(model, exchange);
  limit_ = conduction_->stable_time_step(model, exchange);
}

Heat::~Heat() = default;

void Heat::start(double duration) {
  for (std::size_t k = 0; k < sources_.size(); ++k)
    check_source(sources_[k], static_cast<const HeatSource&>(*loads_[k]), duration,
                 model_.specimen());
  // Where no property depends on temperature, conduction takes explicit steps in one pass by
  // itself.
  if (takes_explicit_steps() && conduction_->is_linear()) return;
  heated_ = std::make_unique<HeatedModel>(model_, *conduction_, loads_, imposed_, limit_);
  using Integrator = ConductionParameters::Integrator;
  const HeatIntegration choice =
      parameters_.integrator == Integrator::explicit_euler ? HeatIntegration::explicit_euler
      : parameters_.integrator == Integrator::rkl2         ? HeatIntegration::rkl2
      : parameters_.integrator == Integrator::implicit     ? HeatIntegration::implicit
                                                           : HeatIntegration::automatic;
  integrator_ = make_heat_integrator(choice, {parameters_.tolerance.value_or(0)});
}

std::vector<ElementValue> Heat::largest_exchange() const {
  std::vector<ElementValue> exchange;
  for (const HeatLoad* load : loads_) load->largest_conductances(exchange);
  return exchange;
}

void Heat::adopt_conductors(const Step& step) {
  if (integrator_ != nullptr) integrator_->restart();
  const bool must_look = takes_explicit_steps() && step.time_step <= limit_ &&
                         step.time_step > conduction_->surely_stable_step(limit_);
  if (!must_look) return;
  const double limit = conduction_->stable_time_step(model_, largest_exchange());
  if (step.time_step > limit)
    throw RunError("bonds made anew conduct so much heat that the explicit time step, " +
                   text(step.time_step) + " s, is beyond the stable limit, now " + text(limit) +
                   " s (" + text(limit_) + " s at the start), at time " + text(step.time) +
                   " s; take a smaller time_step in [run], or integrator = \"rkl2\" in "
                   "[conduction]");
}

void Heat::advance(const Step& step) {
  if (conduction_->follow_bonds(model_)) adopt_conductors(step);
  if (integrator_ == nullptr) {
    for (const auto& effect : effects_) effect->advance(model_, step);
    model_.swap(columns::temperature);
    return;
  }
  double* temperature = model_.data(columns::temperature);
  const std::vector<double> before(temperature, temperature + model_.elements());
  std::vector<double> heat(heated_->accounts(), 0.0);
  integrator_->advance(*heated_, step.time, step.time_step, temperature, heat.data());
  heated_->count(before, heat);
}

}  // namespace solidem
