// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/heat.hpp"

#include "engine/heated_model.hpp"
#include "model/error.hpp"
#include "solve/heat_integrator.hpp"
#include "solve/relative_conductivity.hpp"

namespace solidem {

ConductionGeometry scaled_geometry(const ConductionParameters& parameters, const Specimen& specimen,
                                   std::optional<double> area_factor) {
  ConductionGeometry geometry = conduction_geometry(parameters.law, specimen);
  if (parameters.law == ConductionParameters::Law::platonic_calibrated)
    calibrate(geometry, area_factor ? *area_factor : 1 / relative_conductivity(geometry, specimen),
              specimen.domain.volume);
  return geometry;
}

Heat::Heat(const ConductionParameters& parameters, double area_factor, std::vector<Effect*> effects,
           Model& model)
    : parameters_(parameters),
      model_(model),
      area_factor_(area_factor),
      effects_(std::move(effects)) {
  std::vector<ElementValue> exchange;
  for (Effect* effect : effects_) {
    if (auto* conduction = dynamic_cast<Conduction*>(effect)) conduction_ = conduction;
    if (auto* load = dynamic_cast<HeatLoad*>(effect)) loads_.push_back(load);
    if (auto* imposed = dynamic_cast<ImposedTemperature*>(effect)) imposed_.push_back(imposed);
  }
  for (const HeatLoad* load : loads_) load->largest_conductances(exchange);
  criterion_ = conduction_->time_step_criterion(model, exchange);
  limit_ = conduction_->stable_time_step(model, exchange);
}

Heat::~Heat() = default;

void Heat::start() {
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

void Heat::advance(const Step& step) {
  if (integrator_ == nullptr) {
    for (Effect* effect : effects_) effect->advance(model_, step);
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
