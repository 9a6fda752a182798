// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/heat.hpp"

#include <algorithm>
#include <cmath>

#include "effects/conduction_parameters.hpp"
#include "effects/selections.hpp"
#include "model/error.hpp"
#include "solve/calibration/relative_conductivity.hpp"
#include "solve/heat/heat_integrator.hpp"
#include "solve/heat/heated_model.hpp"

namespace solidem {

ConductionGeometry scaled_geometry(const ConductionParameters& parameters, const Specimen& specimen,
                                   std::optional<double> area_factor) {
  ConductionGeometry geometry = conduction_geometry(parameters.law, specimen);
  if (parameters.law == ConductionParameters::Law::platonic_calibrated)
    calibrate(geometry, area_factor ? *area_factor : 1 / relative_conductivity(geometry, specimen),
              specimen);
  return geometry;
}

Heat::Heat(const ConductionParameters& parameters, double area_factor, std::vector<Effect*> effects,
           Model& model)
    : parameters_(parameters),
      model_(model),
      area_factor_(area_factor),
      effects_(std::move(effects)) {
  for (Effect* effect : effects_) {
    if (auto* conduction = dynamic_cast<Conduction*>(effect)) conduction_ = conduction;
    if (auto* load = dynamic_cast<HeatLoad*>(effect)) loads_.push_back(load);
    if (auto* imposed = dynamic_cast<ImposedTemperature*>(effect)) imposed_.push_back(imposed);
    if (auto* heating = dynamic_cast<HeatOfMotion*>(effect)) of_motion_.push_back(heating);
    if (auto* following = dynamic_cast<FollowsTemperature*>(effect))
      following_.push_back(following);
    if (auto* surface = dynamic_cast<ExposedSurface*>(effect)) surface_ = surface;
    if (auto* clock = dynamic_cast<HeatClock*>(effect)) clock_ = clock;
  }
  const std::vector<ElementValue> exchange = largest_exchange();
  criterion_ = conduction_->time_step_criterion(model, exchange);
  limit_ = conduction_->stable_time_step(model, exchange);
}

Heat::~Heat() = default;

void Heat::start(double duration) {
  // Where stability does not say how often heat must step, as often as a history has rows.
  constexpr double least_steps = 200;
  if (clock_ != nullptr)
    clock_->bound(takes_explicit_steps() ? criterion_.value : duration / least_steps);
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

void Heat::adopt_conductors(double time, double time_step) {
  if (integrator_ != nullptr) integrator_->restart();
  const bool must_look = takes_explicit_steps() && time_step <= limit_ &&
                         time_step > conduction_->surely_stable_step(limit_);
  if (!must_look) return;
  const double limit = conduction_->stable_time_step(model_, largest_exchange());
  if (time_step > limit)
    throw RunError("bonds made anew conduct so much heat that the explicit time step, " +
                   text(time_step) + " s, is beyond the stable limit, now " + text(limit) + " s (" +
                   text(limit_) + " s at the start), at time " + text(time) +
                   " s; take a smaller time_step in [run], or integrator = \"rkl2\" in "
                   "[conduction]");
}

void Heat::take_heat_of_motion(const Step& step) {
  for (HeatOfMotion* heating : of_motion_) heating->deliver(model_, step);
  if (of_motion_.empty()) return;
  for (ImposedTemperature* imposed : imposed_) imposed->hold(model_, step.time);
}

bool Heat::follow_bonds() {
  const bool conducts_otherwise = conduction_->follow_bonds(model_);
  if (surface_ == nullptr || !surface_->follow_bonds()) return conducts_otherwise;
  model_.touch_conductors();
  return true;
}

void Heat::advance(const Step& motion) {
  if (follow_bonds())
    adopt_conductors(motion.time, clock_ != nullptr ? clock_->length(motion) : motion.time_step);
  const std::optional<Step> step = clock_ != nullptr ? clock_->pass(motion) : motion;
  if (!step) return;
  std::vector<double> before;
  if (clock_ != nullptr && clock_->is_automatic()) {
    const double* temperature = model_.data(columns::temperature);
    before.assign(temperature, temperature + model_.elements());
  }
  take_heat_of_motion(*step);
  carry(*step);
  for (FollowsTemperature* following : following_) following->follow(model_, motion.time_step);
  if (before.empty()) return;
  double change = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    change = std::max(change, std::fabs(model_.data(columns::temperature)[i] - before[i]));
  clock_->adapt(change, motion);
}

void Heat::carry(const Step& step) {
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

void Heat::check(std::int64_t step, double time) const {
  const double* temperature = model_.data(columns::temperature);
  for (std::size_t i = 0; i < model_.elements(); ++i)
    if (!(temperature[i] >= 0))
      throw RunError("the temperature of " + place(model_.specimen(), i) + " is " +
                     text(temperature[i]) + " K at step " + std::to_string(step) + " (time " +
                     text(time) +
                     " s), below absolute zero; look for a heat load that takes more than there "
                     "is, or take a smaller time step");
}

}  // namespace solidem
