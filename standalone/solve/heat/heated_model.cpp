// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/heated_model.hpp"

#include <algorithm>

namespace solidem {

HeatedModel::HeatedModel(Model& model, const Conduction& conduction, std::vector<HeatLoad*> loads,
                         std::vector<ImposedTemperature*> imposed, double stable_step)
    : model_(model),
      conduction_(conduction),
      loads_(std::move(loads)),
      imposed_(std::move(imposed)),
      stable_step_(stable_step),
      power_(model.conductors().padded_elements()) {
  for (const ImposedTemperature* effect : imposed_)
    imposed_elements_.insert(imposed_elements_.end(), effect->elements().begin(),
                             effect->elements().end());
}

bool HeatedModel::is_linear() const {
  return conduction_.is_linear() &&
         std::all_of(loads_.begin(), loads_.end(),
                     [](const HeatLoad* load) { return load->is_linear(); });
}

void HeatedModel::powers(double time, const double* temperature, double* power, double* account) {
  // The kernel reads whole packs of aligned columns; the one that no integrator but the fused step
  // writes is free.
  double* aligned = model_.next(columns::temperature);
  std::copy(temperature, temperature + elements(), aligned);
  conduction_.powers(model_, aligned, power_.data());
  for (std::size_t k = 0; k < loads_.size(); ++k) {
    values_.clear();
    loads_[k]->powers(time, temperature, values_);
    account[k] = 0;
    for (const ElementValue& value : values_) {
      power_[static_cast<std::size_t>(value.element)] += value.value;
      account[k] += value.value;
    }
  }
  std::copy(power_.data(), power_.data() + elements(), power);
  for (std::size_t k = 0; k < imposed_.size(); ++k) {
    double sum = 0;
    for (const std::int32_t e : imposed_[k]->elements()) sum += power[e];
    account[loads_.size() + k] = -sum;
  }
}

void HeatedModel::impose(double time, double* temperature) const {
  for (const ImposedTemperature* effect : imposed_) {
    const double value = effect->temperature(time);
    for (const std::int32_t e : effect->elements()) temperature[e] = value;
  }
}

double HeatedModel::enthalpy(std::size_t i, double temperature) const {
  return conduction_.enthalpy(model_, i, temperature);
}

double HeatedModel::temperature(std::size_t i, double enthalpy) const {
  return conduction_.temperature(model_, i, enthalpy);
}

double HeatedModel::capacity(std::size_t i, double temperature) const {
  return conduction_.capacity(model_, i, temperature);
}

Eigen::SparseMatrix<double> HeatedModel::conductance_matrix(double time,
                                                            const double* temperature) const {
  const auto size = static_cast<Eigen::Index>(elements());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(4 * model_.conductors().bonds());
  conduction_.for_each_conductance(model_, temperature,
                                   [&](std::int32_t i, std::int32_t j, double conductance) {
                                     entries.emplace_back(i, i, conductance);
                                     entries.emplace_back(j, j, conductance);
                                     entries.emplace_back(i, j, -conductance);
                                     entries.emplace_back(j, i, -conductance);
                                   });
  std::vector<ElementValue> exchange;
  for (const HeatLoad* load : loads_) load->conductances(time, temperature, exchange);
  for (const ElementValue& e : exchange) entries.emplace_back(e.element, e.element, e.value);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void HeatedModel::count(const std::vector<double>& before, const std::vector<double>& accounts) {
  const double* temperature = model_.data(columns::temperature);
  for (std::size_t k = 0; k < loads_.size(); ++k) loads_[k]->count(accounts[k]);
  for (std::size_t k = 0; k < imposed_.size(); ++k) {
    double heat = accounts[loads_.size() + k];
    for (const std::int32_t e : imposed_[k]->elements()) {
      const auto i = static_cast<std::size_t>(e);
      heat += conduction_.heat(model_, i, before[i], temperature[i]);
    }
    imposed_[k]->count(heat);
  }
}

}  // namespace solidem
