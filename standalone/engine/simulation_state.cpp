// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a checkpoint keeps of a simulation.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "effects/rupture.hpp"
#include "engine/heat.hpp"
#include "engine/simulation.hpp"
#include "model/error.hpp"
#include "solve/heat/heat_integrator.hpp"

namespace solidem {

namespace {

/// Whether an array holds what no run can go on from.
bool has_nan(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); });
}

}  // namespace

bool Simulation::changes(const Column& column) const {
  // Where bonds break and form, whatever belongs to a slot may change, and elements may be removed.
  return column.dynamic || (find<Rupture>() != nullptr && column.site != Site::conductor);
}

std::map<std::string, std::vector<double>> Simulation::save() const {
  std::map<std::string, std::vector<double>> saved;
  for (const PlannedColumn& planned : plan_.columns) {
    if (!changes(*planned.column)) continue;
    const double* data = model_.data(*planned.column);
    std::vector<double>& values = saved[std::string("column.") + planned.column->name];
    values.assign(data, data + model_.size(*planned.column));
    if (has_nan(values))
      throw RunError("the run diverged: " + std::string(planned.column->name) +
                     " is not a number at step " + std::to_string(step_) +
                     "; an earlier checkpoint stays");
  }
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    Archive archive;
    effects_[k]->state(archive);
    if (!archive.values().empty()) saved["effect." + plan_.effects[k].name] = archive.values();
  }
  saved["initial_energy"] = {initial_energy_, initially_stored_, initial_swing_};
  saved["largest_work"] = {guard_.largest()};
  saved["time_step"] = {time_step_.value};
  saved["clock"] = {time_, last_length_, static_cast<double>(origin_step_), origin_time_};
  if (heat_ != nullptr && heat_->integrator() != nullptr)
    saved["integrator"] = heat_->integrator()->save();
  saved["specimen"] = specimen_marks_;
  return saved;
}

void Simulation::restore(std::int64_t step,
                         const std::map<std::string, std::vector<double>>& saved) {
  const auto kept = [&](const std::string& name) -> const std::vector<double>& {
    const auto found = saved.find(name);
    if (found == saved.end())
      throw InputError("the checkpoint has no " + name + ": it is of another scene");
    return found->second;
  };
  const auto number = [&](const std::string& name) {
    if (kept(name).size() != 1 || !std::isfinite(kept(name)[0]))
      throw InputError("the checkpoint's " + name + " is no number");
    return kept(name)[0];
  };
  if (step < 0) throw InputError("the checkpoint's step " + std::to_string(step) + " is below 0");
  if (kept("specimen") != specimen_marks_)
    throw InputError(
        "the checkpoint was made of another specimen; resume with the one it began with");
  if (step_follows_duration()) time_step_.value = number("time_step");
  if (number("time_step") != time_step_.value)
    throw InputError("the checkpoint was made with a time step of " + text(number("time_step")) +
                     " s, the scene asks for " + text(time_step_.value) +
                     " s; resume with the same");
  for (const PlannedColumn& planned : plan_.columns) {
    if (!changes(*planned.column)) continue;
    const std::vector<double>& values = kept(std::string("column.") + planned.column->name);
    if (values.size() != model_.size(*planned.column))
      throw InputError(std::string("the checkpoint's column ") + planned.column->name + " has " +
                       std::to_string(values.size()) + " values, this specimen needs " +
                       std::to_string(model_.size(*planned.column)));
    if (has_nan(values))
      throw InputError(std::string("the checkpoint's column ") + planned.column->name +
                       " holds what is not a number");
    std::copy(values.begin(), values.end(), model_.data(*planned.column));
  }
  const auto restore_as = [](const std::string& name, const auto& restore_it) {
    try {
      restore_it();
    } catch (const std::out_of_range& error) {
      throw InputError("the checkpoint's " + name + " does not fit: " + error.what());
    }
  };
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    Archive now;
    effects_[k]->state(now);
    if (now.values().empty()) continue;
    const std::string name = "effect." + plan_.effects[k].name;
    Archive then(kept(name), model_.elements());
    restore_as(name, [&] {
      effects_[k]->state(then);
      if (!then.is_at_end()) throw std::out_of_range("there are more numbers than expected");
    });
  }
  if (heat_ != nullptr && heat_->integrator() != nullptr)
    restore_as("integrator", [&] { heat_->integrator()->restore(kept("integrator")); });
  const std::vector<double>& energies = kept("initial_energy");
  if (energies.size() != 3 || has_nan(energies))
    throw InputError("the checkpoint's initial_energy does not fit");
  initial_energy_ = energies[0];
  initially_stored_ = energies[1];
  initial_swing_ = energies[2];
  guard_.start(initially_stored_);
  guard_.restore(number("largest_work"));
  const std::vector<double>& clock = kept("clock");
  if (clock.size() != 4 || has_nan(clock)) throw InputError("the checkpoint's clock does not fit");
  restore_as("clock", [&] {
    Archive then(clock, model_.elements());
    then(time_, last_length_, origin_step_, origin_time_);
    if (origin_step_ < 0 || origin_step_ > step)
      throw std::out_of_range("steps are counted from " + std::to_string(origin_step_) +
                              " on, of " + std::to_string(step));
  });
  step_ = step;
}

}  // namespace solidem
