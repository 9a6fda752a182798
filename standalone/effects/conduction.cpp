// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/conduction.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "effects/conduction_parameters.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/pseudo_random.hpp"
#include "laws/heat_exchange.hpp"

namespace solidem {

namespace {

// Threads pay from this many blocks of elements on.
constexpr std::size_t least_blocks_of_conductors = 640;

/// Contact conductance between two materials, W/(m² K); infinite when they touch perfectly.
double contact_conductance(const std::vector<Contact>& contacts, const Material& a,
                           const Material& b) {
  for (const Contact& contact : contacts)
    if ((contact.first == a.name && contact.second == b.name) ||
        (contact.first == b.name && contact.second == a.name))
      return contact.conductance;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

bool conductivity_varies(const std::vector<Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& m) { return !m.conductivity.is_constant(); });
}

bool capacity_varies(const std::vector<Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& m) { return !m.specific_heat.is_constant(); });
}

std::vector<const Column*> Conduction::columns(const ConductionParameters& parameters,
                                               const std::vector<Material>& materials) {
  if (!conductivity_varies(materials))
    return {&columns::temperature, &columns::inverse_heat_capacity, &columns::conductance};
  std::vector<const Column*> asked = {&columns::temperature, &columns::inverse_heat_capacity,
                                      &columns::conductivity, &columns::conduction_length};
  if (!parameters.contacts.empty()) asked.push_back(&columns::contact_resistance);
  return asked;
}

Conduction::Conduction(const ConductionParameters& parameters, ThermalProperties properties,
                       const ConductionGeometry& geometry, Model& model)
    : initial_temperature_(parameters.initial_temperature),
      properties_(std::move(properties)),
      conductivity_varies_(solidem::conductivity_varies(properties_.materials)),
      capacity_varies_(solidem::capacity_varies(properties_.materials)),
      contacts_(parameters.contacts) {
  double* temperature = model.data(columns::temperature);
  double* inverse_capacity = model.data(columns::inverse_heat_capacity);
  for (std::size_t i = 0; i < model.elements(); ++i) {
    temperature[i] = initial_temperature_;
    inverse_capacity[i] = 1 / (properties_.of(i).specific_heat(initial_temperature_) *
                               properties_.of(i).density * geometry.volume[i]);
  }
  // The elements that fill the last block up must not make numbers out of 0/0.
  if (conductivity_varies_)
    std::fill_n(model.data(columns::conductivity), model.conductors().padded_elements(), 1.0);

  model.conductors().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const Pair pair{std::min(i, j), std::max(i, j)};
    set_path(model, pair, {row, lane}, geometry.path(model.specimen(), pair));
  });
  assert(is_symmetric(model));
}

void Conduction::set_path(Model& model, Pair pair, Slots::Place place, const HeatPath& path) const {
  const auto [area, distance] = path;
  const Material& a = properties_.of(static_cast<std::size_t>(pair.i));
  const Material& b = properties_.of(static_cast<std::size_t>(pair.j));
  const double contact = contact_conductance(contacts_, a, b);
  const std::size_t at = place.index();
  if (conductivity_varies_) {
    model.data(columns::conduction_length)[at] = area / distance;
    if (model.has(columns::contact_resistance))
      model.data(columns::contact_resistance)[at] = area > 0 ? 1 / (contact * area) : 0;
    return;
  }
  const double at_a = a.conductivity(0), at_b = b.conductivity(0);
  const double lambda = at_a == at_b ? at_a : series_conductivity(at_a, at_b);
  const double conductance = path_conductance(lambda, area, distance);
  model.data(columns::conductance)[at] = contact < std::numeric_limits<double>::infinity()
                                             ? series_conductance(conductance, contact * area)
                                             : conductance;
}

bool Conduction::is_symmetric(const Model& model) const {
  const Slots& slots = model.conductors();
  bool symmetric = slots.is_symmetric();
  for (const Column* column :
       {&columns::conductance, &columns::conduction_length, &columns::contact_resistance}) {
    if (!model.has(*column)) continue;
    const double* value = model.data(*column);
    slots.for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
      symmetric =
          symmetric && value[Slots::Place{row, lane}.index()] == value[slots.find(j, i)->index()];
    });
  }
  return symmetric;
}

void Conduction::watch_bonds(ConductionParameters::BrokenBonds broken_bonds,
                             ConductionGeometry geometry, Model& model) {
  if (model.shares_conductors())
    throw std::logic_error("conductors that are the bonds cannot outlast them");
  changing_ = std::make_unique<ChangingConductors>(broken_bonds, std::move(geometry), model);
  changing_model_ = &model;
}

bool Conduction::follow_bonds(Model& model) {
  if (changing_ == nullptr) return false;
  const ChangingConductors::Change change = changing_->follow(model);
  if (change.is_nothing()) return false;
  if (change.new_pairs) {
    lay_out(model);
  } else {
    for (const Pair& pair : change.switched) {
      const HeatPath path = changing_->path(model.specimen(), pair);
      set_path(model, pair, *model.conductors().find(pair.i, pair.j), path);
      set_path(model, pair, *model.conductors().find(pair.j, pair.i), path);
    }
    model.touch_conductors();
  }
  added_rate_ = added_rate(model);
  assert(is_symmetric(model));
  return true;
}

void Conduction::lay_out(Model& model) {
  model.replace_conductors(changing_->pairs());
  model.conductors().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const Pair pair{std::min(i, j), std::max(i, j)};
    set_path(model, pair, {row, lane}, changing_->path(model.specimen(), pair));
  });
}

double Conduction::added_rate(const Model& model) const {
  double rate = 0;
  std::map<std::int32_t, double> sum;
  for (const auto& [pair, length] : changing_->made_anew()) {
    const auto [area, distance] = changing_->path(model.specimen(), pair);
    const double conductance = path_conductance(
        series_conductivity(largest_conductivity(static_cast<std::size_t>(pair.i)),
                            largest_conductivity(static_cast<std::size_t>(pair.j))),
        area, distance);
    for (const std::int32_t element : {pair.i, pair.j}) {
      const double all = sum[element] += conductance;
      rate = std::max(rate, all * worst_inverse_capacity(model, static_cast<std::size_t>(element)));
    }
  }
  return rate;
}

double Conduction::surely_stable_step(double at_start) const {
  return added_rate_ > 0 ? 1 / (1 / at_start + added_rate_) : at_start;
}

void Conduction::state(Archive& archive) {
  if (changing_ == nullptr) return;
  changing_->state(archive, *changing_model_);
  if (!archive.is_reading()) return;
  lay_out(*changing_model_);
  added_rate_ = added_rate(*changing_model_);
  assert(is_symmetric(*changing_model_));
}

double Conduction::enthalpy(const Model& model, std::size_t i, double temperature) const {
  const double inverse_capacity = model.data(columns::inverse_heat_capacity)[i];
  if (!capacity_varies_) return (temperature - initial_temperature_) / inverse_capacity;
  const TemperatureFunction& c = properties_.of(i).specific_heat;
  return (c.integral(temperature) - c.integral(initial_temperature_)) /
         (c(initial_temperature_) * inverse_capacity);
}

double Conduction::temperature(const Model& model, std::size_t i, double enthalpy) const {
  const double inverse_capacity = model.data(columns::inverse_heat_capacity)[i];
  if (!capacity_varies_) return initial_temperature_ + enthalpy * inverse_capacity;
  const TemperatureFunction& c = properties_.of(i).specific_heat;
  return c.inverse_integral(c.integral(initial_temperature_) +
                            enthalpy * c(initial_temperature_) * inverse_capacity);
}

double Conduction::capacity(const Model& model, std::size_t i, double temperature) const {
  const TemperatureFunction& c = properties_.of(i).specific_heat;
  return c(temperature) / (c(initial_temperature_) * model.data(columns::inverse_heat_capacity)[i]);
}

double Conduction::heated(const Model& model, std::size_t i, double temperature,
                          double heat) const {
  if (!capacity_varies_) return temperature + heat * model.data(columns::inverse_heat_capacity)[i];
  return this->temperature(model, i, enthalpy(model, i, temperature) + heat);
}

double Conduction::heat(const Model& model, std::size_t i, double from, double to) const {
  // The difference of temperatures first: two enthalpies would cancel.
  if (!capacity_varies_) return (to - from) / model.data(columns::inverse_heat_capacity)[i];
  return enthalpy(model, i, to) - enthalpy(model, i, from);
}

double Conduction::worst_inverse_capacity(const Model& model, std::size_t i) const {
  const TemperatureFunction& c = properties_.of(i).specific_heat;
  return model.data(columns::inverse_heat_capacity)[i] * (c(initial_temperature_) / c.least());
}

void Conduction::for_each_conductance(
    const Model& model, const double* temperature,
    const std::function<void(std::int32_t, std::int32_t, double)>& visit) const {
  const double* stored = conductivity_varies_ ? nullptr : model.data(columns::conductance);
  const double* length = conductivity_varies_ ? model.data(columns::conduction_length) : nullptr;
  const double* contact =
      model.has(columns::contact_resistance) ? model.data(columns::contact_resistance) : nullptr;
  model.conductors().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i > j) return;
    const std::size_t at = Model::at_slot(columns::conductance, row, lane);
    if (!conductivity_varies_) return visit(i, j, stored[at]);
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const double path = length[at] * series_conductivity(conductivity(a, temperature[a]),
                                                         conductivity(b, temperature[b]));
    visit(i, j, contact == nullptr ? path : path / (1 + path * contact[at]));
  });
}

void Conduction::assume_worst(Model& model) const {
  if (!conductivity_varies_) return;
  double* conductivities = model.data(columns::conductivity);
  for (std::size_t i = 0; i < model.elements(); ++i) conductivities[i] = largest_conductivity(i);
}

TimeStepCriterion Conduction::time_step_criterion(const Model& model,
                                                  const std::vector<ElementValue>& exchange) const {
  std::vector<double> sum(model.elements(), 0.0);
  for (const ElementValue& e : exchange) sum[static_cast<std::size_t>(e.element)] += e.value;
  const double* stored = conductivity_varies_ ? nullptr : model.data(columns::conductance);
  const double* length = conductivity_varies_ ? model.data(columns::conduction_length) : nullptr;
  model.conductors().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    const std::size_t at = Model::at_slot(columns::conductance, row, lane);
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    sum[a] += conductivity_varies_ ? length[at] * series_conductivity(largest_conductivity(a),
                                                                      largest_conductivity(b))
                                   : stored[at];
  });
  double rate = 0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    rate = std::max(rate, sum[i] * worst_inverse_capacity(model, i));
  return {"sum of an element's conductances",
          rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity()};
}

double Conduction::stable_time_step(Model& model, const std::vector<ElementValue>& exchange) const {
  constexpr int iterations = 60;
  const double scale = time_step_criterion(model, exchange).value;
  if (!std::isfinite(scale)) return scale;
  const std::size_t elements = model.elements();
  double* temperature = model.data(columns::temperature);
  double* power = model.next(columns::temperature);
  const std::vector<double> saved(temperature, temperature + elements);
  for (std::size_t i = 0; i < elements; ++i) temperature[i] = pseudo_random(i);
  assume_worst(model);
  double decay = 0;
  for (int n = 0; n < iterations; ++n) {
    conduct(model, temperature, power);
    for (const ElementValue& e : exchange) {
      const auto i = static_cast<std::size_t>(e.element);
      power[i] -= e.value * temperature[i];
    }
    double product = 0, square = 0, largest = 0;
    for (std::size_t i = 0; i < elements; ++i) {
      const double inverse_capacity = worst_inverse_capacity(model, i);
      const double change = -scale * inverse_capacity * power[i];
      product += change * temperature[i] / inverse_capacity;
      square += temperature[i] * temperature[i] / inverse_capacity;
      largest = std::max(largest, std::fabs(change));
      temperature[i] = change;
    }
    decay = product / square;
    if (!(largest > 0)) break;
    for (std::size_t i = 0; i < elements; ++i) temperature[i] /= largest;
  }
  std::copy(saved.begin(), saved.end(), temperature);
  return decay > 0 ? 2 * scale / decay : std::numeric_limits<double>::infinity();
}

void Conduction::advance(Model& model, const Step& step) {
  const HeatFlow flow{model.conductors().first_row(),
                      model.conductors().neighbours(),
                      model.data(columns::temperature),
                      model.next(columns::temperature),
                      model.data(columns::inverse_heat_capacity),
                      model.data(columns::conductance),
                      step.time_step};
  const auto conduct = kernels().conduct;
  for_blocks(model.conductors().blocks(), least_blocks_of_conductors,
             [&](std::size_t first, std::size_t last) { conduct(flow, first, last); });
}

void Conduction::powers(Model& model, const double* temperature, double* power) const {
  if (conductivity_varies_) {
    double* conductivities = model.data(columns::conductivity);
    for (std::size_t i = 0; i < model.elements(); ++i)
      conductivities[i] = conductivity(i, temperature[i]);
  }
  conduct(model, temperature, power);
}

void Conduction::conduct(Model& model, const double* temperature, double* power) const {
  const auto where_present = [&](const Column& column) {
    return model.has(column) ? model.data(column) : nullptr;
  };
  const HeatPower h{model.conductors().first_row(),
                    model.conductors().neighbours(),
                    temperature,
                    power,
                    where_present(columns::conductance),
                    where_present(columns::conductivity),
                    where_present(columns::conduction_length),
                    where_present(columns::contact_resistance)};
  const auto conducted_power = kernels().conducted_power;
  for_blocks(model.conductors().blocks(), least_blocks_of_conductors,
             [&](std::size_t first, std::size_t last) { conducted_power(h, first, last); });
}

void Conduction::observe(const Model& model, Observation& observation) const {
  const double* temperature = model.data(columns::temperature);
  long double energy = 0;
  for (std::size_t i = 0; i < model.elements(); ++i)
    energy += static_cast<long double>(enthalpy(model, i, temperature[i]));
  observation.heat.thermal_energy = static_cast<double>(energy);
}

}  // namespace solidem
