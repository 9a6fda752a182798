// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/rupture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/bond_law_keys.hpp"
#include "effects/effect_kind.hpp"
#include "laws/contact.hpp"

namespace solidem {

Rupture::Rupture(const RuptureParameters& parameters, const Beams& beams, Model& model)
    : parameters_(parameters),
      beams_(beams),
      model_(model),
      first_time_(std::numeric_limits<double>::quiet_NaN()) {}

double BrokenBond::contact_distance(double stiffness) const {
  return solidem::contact_distance(free_distance, length, push, stiffness);
}

namespace {

/// How far an orientation has turned between two poses, as a rotation vector.
Vector turned(const double* before, const double* after) {
  const Quaternion<double> q{before[4], {before[5], before[6], before[7]}};
  const Quaternion<double> now{after[4], {after[5], after[6], after[7]}};
  return 2 * (now * conjugate(q)).v;
}

Vector moved(const double* before, const double* after) {
  return {after[0] - before[0], after[1] - before[1], after[2] - before[2]};
}

}  // namespace

void Rupture::lose(Pair pair, double energy, const BeamLoad<double>& load) {
  fracture_energy_ += energy;
  LastAct act{pair, load, {}, {}};
  std::copy_n(model_.data(columns::pose) + std::ptrdiff_t{8} * pair.i, 8, act.pose_i.begin());
  std::copy_n(model_.data(columns::pose) + std::ptrdiff_t{8} * pair.j, 8, act.pose_j.begin());
  last_acts_.push_back(act);
}

double Rupture::work_of_last_acts() const {
  double work = 0;
  for (const LastAct& act : last_acts_) {
    const double* now_i = model_.data(columns::pose) + std::ptrdiff_t{8} * act.pair.i;
    const double* now_j = model_.data(columns::pose) + std::ptrdiff_t{8} * act.pair.j;
    const double *then_i = act.pose_i.data(), *then_j = act.pose_j.data();
    work += 0.5 * (dot(act.load.force, moved(then_i, now_i) - moved(then_j, now_j)) +
                   dot(act.load.moment_i, turned(then_i, now_i)) +
                   dot(act.load.moment_j, turned(then_j, now_j)));
  }
  return work;
}

void Rupture::advance(Model& /*model*/, const Step& step) {
  if (!last_acts_.empty()) {
    fracture_energy_ -= work_of_last_acts();
    last_acts_.clear();
  }
  if (beams_.breaking().empty()) return;
  std::vector<Pair> pairs;
  for (const std::uint32_t index : beams_.breaking()) {
    const Slots::Place place = Slots::place_of(index);
    const std::int32_t i = model_.slots().element_of(place), j = model_.slots().neighbour_of(place);
    pairs.push_back({std::min(i, j), std::max(i, j)});
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  break_bonds(pairs, step);
}

void Rupture::break_bonds(const std::vector<Pair>& pairs, const Step& step) {
  if (pairs.empty()) return;
  if (std::isnan(first_time_)) first_time_ = step.time;
  const std::size_t before = broken_.size();
  for (const Pair& pair : pairs) break_bond(pair);
  if (parameters_.minimal_bonds == 0) return;
  // Removing an element may leave its neighbours with too few.
  for (std::size_t k = before; k < broken_.size(); ++k)
    for (const std::int32_t element : {broken_[k].pair.i, broken_[k].pair.j})
      if (!is_removed(element) && model_.slots().coordination(element) < parameters_.minimal_bonds)
        remove(element, step.time_step);
}

void Rupture::remove_elements(const std::vector<std::int32_t>& elements, const Step& step) {
  for (const std::int32_t element : elements)
    if (!is_removed(element)) remove(element, step.time_step);
}

void Rupture::break_bond(Pair pair) {
  const Slots& slots = model_.slots();
  const Slots::Place here = *slots.find(pair.i, pair.j), there = *slots.find(pair.j, pair.i);
  const Beams::Bond bond = beams_.bond(model_, pair.i, pair.j, here.row, here.lane);
  lose(pair, bond.energy(), bond.load());
  const BeamRigidity<double>& rigidity = bond.rigidity();
  const std::vector<double>& radius = model_.specimen().radius;
  const double radii =
      radius[static_cast<std::size_t>(pair.i)] + radius[static_cast<std::size_t>(pair.j)];
  const double length = norm(bond.chord);
  broken_.push_back({pair,
                     contact_distance(bond.rest_length(), bond.response.history.extension, radii),
                     length, std::max(0.0, -dot(bond.load().force, bond.chord) / length),
                     rigidity.axial / bond.rest_length(), bond.section()});
  model_.break_bond(pair, bond.rest_length());
  Beams::release(model_, here.row, here.lane);
  Beams::release(model_, there.row, there.lane);
}

void Rupture::remove(std::int32_t element, double time_step) {
  const auto i = static_cast<std::size_t>(element);
  removed_.insert(std::upper_bound(removed_.begin(), removed_.end(), element), element);
  const Slots& slots = model_.slots();
  const std::size_t block = i / lanes;
  for (std::size_t row = slots.first_row()[block]; row < slots.first_row()[block + 1]; ++row) {
    const std::int32_t neighbour = slots.neighbour_of({row, element % lanes});
    if (neighbour != element)
      break_bond({std::min(element, neighbour), std::max(element, neighbour)});
  }
  // Its bonds, which act for the last time, have moved it on by half a step too far for the pose in
  // which it is stopped.
  Vector force{}, moment{};
  for (const LastAct& act : last_acts_) {
    if (act.pair.i == element) {
      force += act.load.force;
      moment += act.load.moment_i;
    } else if (act.pair.j == element) {
      force += -act.load.force;
      moment += act.load.moment_j;
    }
  }
  fracture_energy_ += stop(columns::velocity, columns::inverse_mass, i, (0.5 * time_step) * force);
  if (model_.has(columns::angular_velocity))
    fracture_energy_ +=
        stop(columns::angular_velocity, columns::inverse_inertia, i, (0.5 * time_step) * moment);
  // It stands where this step found it.
  std::copy_n(model_.data(columns::pose) + 8 * i, 8, model_.next(columns::pose) + 8 * i);
}

double Rupture::stop(const Column& velocity, const Column& inverse, std::size_t element,
                     const Vector& impulse) {
  double& weight = model_.data(inverse)[element];
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double& v = model_.data(velocity)[Model::at(velocity, element, axis)];
    const double then = v - weight * component(impulse, axis);
    square += then * then;
    v = 0;
  }
  const double energy = 0.5 * square / weight;
  weight = 0;
  return energy;
}

bool Rupture::is_removed(std::int32_t element) const {
  return std::binary_search(removed_.begin(), removed_.end(), element);
}

void Rupture::observe(const Model& /*model*/, Observation& observation) const {
  observation.energies.add(EnergyLedger::Kind::dissipated, "fracture_energy",
                           fracture_energy_ - work_of_last_acts());
  observation.add("broken_bonds", static_cast<double>(broken_.size()));
  if (parameters_.minimal_bonds > 0)
    observation.add("removed_elements", static_cast<double>(removed_.size()));
}

void Rupture::summarise(const Model& /*model*/, Summary& summary) const {
  summary["bonds_broken"] = broken_.size();
  summary["elements_removed"] = removed_.size();
  if (!broken_.empty()) summary["first_rupture"] = {{"time", first_time_}};
}

void Rupture::state(Archive& archive) {
  archive(fracture_energy_, last_acts_, first_time_, broken_, removed_);
  Slots& slots = model_.slots();
  for (std::size_t k = 0; k < slots.rows() * lanes; ++k) {
    const Slots::Place place = Slots::place_of(k);
    if (slots.element_of(place) >= static_cast<std::int32_t>(slots.elements())) continue;
    std::int32_t neighbour = slots.neighbour_of(place);
    archive(neighbour);
    if (archive.is_reading()) slots.set_neighbour(place, neighbour);
  }
  if (archive.is_reading() && !slots.is_symmetric())
    throw std::out_of_range("a bond that only one of its elements has");
}

namespace {

Key minimal_bonds_key(RuptureParameters& p) {
  return may_have("minimal_bonds", integer(p.minimal_bonds, 0))
      .means(
          "an element that has lost bonds and keeps fewer is removed: it loses the others and "
          "stays where it is");
}

std::vector<Key> own_keys(RuptureParameters& p) {
  return {minimal_bonds_key(p), section_key(p.section)};
}

void read_rupture(const Value& value, Reading& reading) {
  table([&](const Section& section) {
    RuptureParameters p;
    const auto& beams = reading.setup.get<BeamParameters>();
    read_bond_law<RuptureLaws>(section, "law", own_keys(p), beams, p.law);
    if (!beams) return;  // refused as a whole
    reading.setup.get<RuptureParameters>() = p;
  }).read(value);
}

void plan_rupture(const Setup& setup, Plan& plan) {
  const auto& rupture = setup.get<RuptureParameters>();
  if (!rupture) return;
  plan.effects.push_back(
      {"rupture", "[rupture]", "", Phase::change_pairs, [rupture = *rupture](Assembly& assembly) {
         return std::make_unique<Rupture>(rupture, assembly.need<Beams>(), assembly.model);
       }});
}

}  // namespace

EffectKind rupture_kind() {
  EffectKind kind;
  kind.section = "rupture";
  kind.beside = {"beams"};
  kind.problem_alone = "there are no beams";
  kind.is_named = [](const Setup& setup) { return setup.get<RuptureParameters>().has_value(); };
  kind.read = read_rupture;
  kind.visit_keys = [](const VisitKeys& visit) {
    RuptureParameters p;
    visit_law_keys<RuptureLaws>("rupture", "law", own_keys(p), visit);
  };
  kind.plan = plan_rupture;
  kind.example =
      "[rupture]\n"
      "strain = 0.004\n"
      "minimal_bonds = 1\n";
  kind.explain = [](const Setup& setup, const Specimen&, nlohmann::ordered_json& values) {
    const RuptureParameters& p = *setup.get<RuptureParameters>();
    values["law"] = name_of(p.law);
    values["section"] = name_of(p.section);
    values["minimal_bonds"] = p.minimal_bonds;
    add_parameters(values, p.law);
  };
  return kind;
}

}  // namespace solidem
