// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/rupture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/contact.hpp"

namespace solidem {

Rupture::Rupture(const RuptureParameters& parameters, const Beams& beams, Model& model)
    : parameters_(parameters),
      beams_(beams),
      model_(model),
      first_time_(std::numeric_limits<double>::quiet_NaN()) {}

void Rupture::advance(Model& /*model*/, const Step& step) {
  if (beams_.breaking().empty()) return;
  std::vector<Pair> pairs;
  for (const std::uint32_t index : beams_.breaking()) {
    const Slots::Place place = Slots::place_of(index);
    const std::int32_t i = model_.slots().element_of(place), j = model_.slots().neighbour_of(place);
    pairs.push_back({std::min(i, j), std::max(i, j)});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (std::isnan(first_time_)) first_time_ = step.time;
  const std::size_t before = broken_.size();
  for (const Pair& pair : pairs) break_bond(pair);
  if (parameters_.minimal_bonds == 0) return;
  // Removing an element may leave its neighbours with too few.
  for (std::size_t k = before; k < broken_.size(); ++k)
    for (const std::int32_t element : {broken_[k].pair.i, broken_[k].pair.j})
      if (!is_removed(element) && model_.slots().coordination(element) < parameters_.minimal_bonds)
        remove(element);
}

void Rupture::break_bond(Pair pair) {
  const Slots& slots = model_.slots();
  const Slots::Place here = *slots.find(pair.i, pair.j), there = *slots.find(pair.j, pair.i);
  const Beams::Bond bond = beams_.bond(model_, pair.i, pair.j, here.row, here.lane);
  fracture_energy_ += bond.energy();
  const BeamRigidity<double>& rigidity = bond.rigidity();
  const std::vector<double>& radius = model_.specimen().radius;
  const double radii =
      radius[static_cast<std::size_t>(pair.i)] + radius[static_cast<std::size_t>(pair.j)];
  broken_.push_back({pair,
                     contact_distance(bond.rest_length(), bond.response.history.extension, radii),
                     rigidity.axial / bond.rest_length(), bond.section()});
  model_.break_bond(pair, bond.rest_length());
  Beams::release(model_, here.row, here.lane);
  Beams::release(model_, there.row, there.lane);
}

void Rupture::remove(std::int32_t element) {
  const auto i = static_cast<std::size_t>(element);
  removed_.insert(std::upper_bound(removed_.begin(), removed_.end(), element), element);
  const Slots& slots = model_.slots();
  const std::size_t block = i / lanes;
  for (std::size_t row = slots.first_row()[block]; row < slots.first_row()[block + 1]; ++row) {
    const std::int32_t neighbour = slots.neighbour_of({row, element % lanes});
    if (neighbour != element)
      break_bond({std::min(element, neighbour), std::max(element, neighbour)});
  }
  double* inverse_mass = model_.data(columns::inverse_mass);
  double* velocity = model_.data(columns::velocity);
  double speed2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double& v = velocity[Model::at(columns::velocity, i, axis)];
    speed2 += v * v;
    v = 0;
  }
  fracture_energy_ += 0.5 * speed2 / inverse_mass[i];
  inverse_mass[i] = 0;
  if (model_.has(columns::angular_velocity)) {
    double* inverse_inertia = model_.data(columns::inverse_inertia);
    double spin2 = 0;
    for (int axis = 0; axis < 3; ++axis) {
      double& w =
          model_.data(columns::angular_velocity)[Model::at(columns::angular_velocity, i, axis)];
      spin2 += w * w;
      w = 0;
    }
    fracture_energy_ += 0.5 * spin2 / inverse_inertia[i];
    inverse_inertia[i] = 0;
  }
  // It stands where this step found it.
  std::copy_n(model_.data(columns::pose) + 8 * i, 8, model_.next(columns::pose) + 8 * i);
}

bool Rupture::is_removed(std::int32_t element) const {
  return std::binary_search(removed_.begin(), removed_.end(), element);
}

void Rupture::observe(const Model& /*model*/, Observation& observation) const {
  observation.motion.fracture_energy = fracture_energy_;
  observation.add("broken_bonds", static_cast<double>(broken_.size()));
  if (parameters_.minimal_bonds > 0)
    observation.add("removed_elements", static_cast<double>(removed_.size()));
}

std::vector<double> Rupture::save() const {
  std::vector<double> saved{fracture_energy_, first_time_, static_cast<double>(broken_.size()),
                            static_cast<double>(removed_.size())};
  for (const BrokenBond& bond : broken_)
    saved.insert(saved.end(), {static_cast<double>(bond.pair.i), static_cast<double>(bond.pair.j),
                               bond.contact_distance, bond.axial_stiffness, bond.section});
  for (const std::int32_t element : removed_) saved.push_back(element);
  const std::int32_t* neighbours = model_.slots().neighbours();
  saved.insert(saved.end(), neighbours, neighbours + model_.slots().rows() * lanes);
  return saved;
}

void Rupture::restore(const std::vector<double>& saved) {
  std::size_t at = 0;
  const auto next = [&] { return saved.at(at++); };
  fracture_energy_ = next();
  first_time_ = next();
  broken_.resize(static_cast<std::size_t>(next()));
  removed_.resize(static_cast<std::size_t>(next()));
  for (BrokenBond& bond : broken_) {
    bond.pair.i = static_cast<std::int32_t>(next());
    bond.pair.j = static_cast<std::int32_t>(next());
    bond.contact_distance = next();
    bond.axial_stiffness = next();
    bond.section = next();
  }
  for (std::int32_t& element : removed_) element = static_cast<std::int32_t>(next());
  for (std::size_t k = 0; k < model_.slots().rows() * lanes; ++k)
    model_.slots().set_neighbour(Slots::place_of(k), static_cast<std::int32_t>(next()));
}

}  // namespace solidem
