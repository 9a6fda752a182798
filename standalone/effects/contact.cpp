// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "effects/beam_parameters.hpp"
#include "effects/selections.hpp"
#include "laws/contact.hpp"
#include "model/error.hpp"
#include "specimen/pieces.hpp"

namespace solidem {

namespace {

constexpr double round_off = 1e-9;  // of the radii: not an overlap

/// From the first to the second, or the nearest of its images.
Vector nearest_chord(const Model& model, Pair pair) {
  const double *i = model.positions()[static_cast<std::size_t>(pair.i)],
               *j = model.positions()[static_cast<std::size_t>(pair.j)];
  Vector chord{j[0] - i[0], j[1] - i[1], j[2] - i[2]};
  const Domain& domain = model.specimen().domain;
  const Vector extent = domain.upper - domain.lower;
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[static_cast<std::size_t>(axis)])
      component(chord, axis) -= component(extent, axis) *
                                std::nearbyint(component(chord, axis) / component(extent, axis));
  return chord;
}

}  // namespace

ElementContacts::ElementContacts(const ContactParameters& parameters, const ContactLaw& law,
                                 double rebonding_strain, const Beams* beams, Rupture* rupture,
                                 Model& model)
    : parameters_(parameters),
      law_(law),
      rebonding_strain_(rebonding_strain),
      damping_ratio_(restitution_damping_ratio(law.restitution)),
      beams_(beams),
      rupture_(rupture),
      model_(model),
      has_rotation_(law.friction > 0),
      list_(model),
      bonded_(stiffness_of_bonds()) {
  const double longest = longest_time_step();
  stiffness_at_start_ = std::max(largest_over_mass(bonded_), 2 / (longest * longest));
  largest_stiffness_ = stiffness_at_start_;
}

void ElementContacts::follow(const std::vector<Grip*>& grips) {
  for (const Grip* grip : grips) {
    imposed_.resize(model_.elements(), 0);
    for (const std::int32_t element : grip->elements())
      for (int axis = 0; axis < 3; ++axis)
        if (grip->imposed(axis))
          imposed_[static_cast<std::size_t>(element)] |= static_cast<char>(1 << axis);
  }
}

void ElementContacts::start(const Model& /*model*/, double /*duration*/) {
  list_contacts();
  if (law_.initial_overlap == ContactLaw::InitialOverlap::refused) refuse_overlaps();
  find_forces(0);
}

void ElementContacts::refuse_overlaps() const {
  const std::vector<std::int32_t> piece =
      lowest_of_piece(model_.elements(), model_.slots().pairs());
  const std::vector<double>& radius = model_.specimen().radius;
  std::size_t count = 0;
  double deepest = 0, share = 0;
  Pair where{0, 0};
  for (const auto& [pair, distance] : nearer_) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    const double depth = radius[i] + radius[j] - distance;
    if (piece[i] == piece[j] || !(depth > round_off * (radius[i] + radius[j]))) continue;
    ++count;
    if (!(depth > deepest)) continue;
    deepest = depth;
    share = depth / std::min(radius[i], radius[j]);
    where = pair;
  }
  if (count == 0) return;
  throw InputError(
      "[contact] elements " + std::to_string(where.i) + " and " + std::to_string(where.j) +
      " overlap by " + text(deepest) + " m at the start, " + text(100 * share) +
      " % of the smaller radius" +
      (count > 1 ? ", and so do " + std::to_string(count - 1) + " more pairs, less deeply" : "") +
      "; expected bodies that stand apart, or initial_overlap = \"kept\": then they "
      "touch where they stand");
}

double ElementContacts::section(Pair pair, const Vector& chord) const {
  if (const BrokenBond* bond = broken_bond(pair)) return bond->section;
  return beam_area(beams_->properties().section(model_.specimen(), pair, chord));
}

double ElementContacts::stiffness(Pair pair, const Vector& chord) const {
  const std::vector<double>& radius = model_.specimen().radius;
  const double r_i = radius[static_cast<std::size_t>(pair.i)],
               r_j = radius[static_cast<std::size_t>(pair.j)];
  if (!law_.is_stiff_as_bonds()) return law_.stiffness(r_i, r_j);
  if (const BrokenBond* bond = broken_bond(pair))
    return parameters_.stiffness_ratio * bond->axial_stiffness;
  const BeamSection<double> beam = beams_->properties().section(model_.specimen(), pair, chord);
  return parameters_.stiffness_ratio * beam.young_modulus * beam_area(beam) / (r_i + r_j);
}

double ElementContacts::inverse_mass(const double* column, std::int32_t element) const {
  constexpr char all_axes = 7;
  const auto i = static_cast<std::size_t>(element);
  return !imposed_.empty() && imposed_[i] == all_axes ? 0 : column[i];
}

double ElementContacts::damping(Pair pair, double stiffness) const {
  const double* column = model_.data(columns::inverse_mass);
  const double inverse = inverse_mass(column, pair.i) + inverse_mass(column, pair.j);
  return inverse > 0 ? damping_coefficient(damping_ratio_, stiffness, inverse) : 0;
}

const BrokenBond* ElementContacts::broken_bond(Pair pair) const {
  if (broken_.empty()) return nullptr;
  const auto found = broken_.find(pair);
  return found == broken_.end() ? nullptr : &rupture_->broken()[found->second];
}

ContactCandidate ElementContacts::candidate(Pair pair, const Vector& chord, bool is_reached_now) {
  const std::vector<double>& radius = model_.specimen().radius;
  const double stiff = stiffness(pair, chord);
  double distance =
      radius[static_cast<std::size_t>(pair.i)] + radius[static_cast<std::size_t>(pair.j)];
  if (const BrokenBond* bond = broken_bond(pair)) {
    distance = bond->contact_distance(stiff);
  } else if (const auto known = nearer_.find(pair); known != nearer_.end()) {
    distance = known->second;
  } else if (const double now = norm(chord); is_reached_now && now < distance) {
    distance = nearer_[pair] = now;
  }
  return {pair, {}, distance, stiff, damping(pair, stiff)};
}

void ElementContacts::list_contacts() {
  const std::vector<History> history = std::move(history_);
  const std::vector<Load> load = std::move(load_);
  const std::vector<char> acts = std::move(acts_);
  history_.clear();
  load_.clear();
  acts_.clear();
  const std::size_t likely = history.size() + history.size() / 8 + lanes;
  history_.reserve(likely);
  load_.reserve(likely);
  acts_.reserve(likely);
  const auto enter = [this](const History& past, const Load& last, char act) {
    history_.push_back(past);
    load_.push_back(last);
    acts_.push_back(act);
  };
  list_.renew(
      [&](Pair pair, const Vector& chord, bool is_new) {
        enter({}, {}, 0);
        return candidate(pair, chord, is_new);
      },
      [&](std::size_t then) { enter(history[then], load[then], acts[then]); });
  acts_.resize(acts_.size() + lanes, 0);
}

void ElementContacts::look(const Step& step) {
  const bool outdated = list_.is_outdated();
  if (outdated) list_contacts();
  if (!outdated && acting_ == 0 && !list_.may_touch()) return;
  find_forces(step.time_step);
  if (outdated) largest_stiffness_ = std::max(largest_stiffness_, present_stiffness());
}

BeamLoad<double> ElementContacts::load(std::size_t k) const {
  const Load& load = load_[k];
  if (!has_rotation_) return {load.force, {}, {}};
  return {load.force, load.arm_i * load.moment, load.arm_j * load.moment};
}

void ElementContacts::for_each_pair(const Model& model, const PairVisit& visit) const {
  const auto displacement = [&](std::int32_t element) {
    const auto e = static_cast<std::size_t>(element);
    const double* now = model.positions()[e];
    return Vector{now[0], now[1], now[2]} - model.specimen().position[e];
  };
  for (std::size_t k = 0; k < list_.candidates().size(); ++k) {
    if (acts_[k] == 0) continue;
    const ContactCandidate contact = list_.candidates()[k];
    const auto [i, j] = contact.pair;
    const BeamLoad<double> on_i = load(k);
    const Vector chord_at_rest = list_.chord(contact) - (displacement(j) - displacement(i));
    visit({i, j, chord_at_rest, on_i.force, on_i.moment_i});
  }
}

double ElementContacts::stored(std::size_t k) const {
  const ContactCandidate candidate = list_.candidates()[k];
  const double depth = overlap(k);
  const Vector& spring = history_[k].spring;
  return 0.5 * candidate.stiffness *
         (depth * depth + law_.tangential_stiffness_ratio * dot(spring, spring));
}

void ElementContacts::advance(Model& model, const Step& step) {
  if (rupture_ != nullptr) follow_ruptures();
  if (acting_ == 0) return;
  push_elements(model, step);
  if (parameters_.rebonding_pressure)
    for (std::size_t k = 0; k < list_.candidates().size(); ++k)
      if (acts_[k] != 0) bond_anew(k);
}

void ElementContacts::observe(const Model& model, Observation& observation) const {
  double energy = 0;
  for (std::size_t k = 0; k < list_.candidates().size(); ++k)
    if (acts_[k] != 0) energy += stored(k);
  if (acting_ > 0) observe_loads(model, observation);
  using Kind = EnergyLedger::Kind;
  observation.energies.add(Kind::stored, "contact_energy", energy);
  if (has_rotation_) observation.energies.add(Kind::dissipated, "friction", friction_);
  if (damping_ratio_ > 0) observation.energies.add(Kind::dissipated, "contact_damping", damped_);
  observation.add("contacts", static_cast<double>(acting_));
  if (parameters_.rebonding_pressure)
    observation.add("bonds_formed", static_cast<double>(bonded_anew_));
}

void ElementContacts::follow_ruptures() {
  const std::vector<BrokenBond>& broken = rupture_->broken();
  if (rupture_->removed() != removed_seen_) {
    removed_seen_ = rupture_->removed();
    for (std::size_t k = 0; k < list_.candidates().size(); ++k) {
      const Pair pair = list_.candidates().pair(k);
      if (rupture_->is_removed(pair.i) || rupture_->is_removed(pair.j)) lose_contact(k);
    }
    std::vector<std::int32_t> removed;
    for (const std::int32_t element : list_.elements())
      if (rupture_->is_removed(element)) removed.push_back(element);
    list_.withdraw(removed);
  }
  if (broken.size() == broken_seen_) return;
  std::vector<std::int32_t> exposed;
  for (; broken_seen_ < broken.size(); ++broken_seen_) {
    const BrokenBond& bond = broken[broken_seen_];
    add_stiffness(bonded_, bond.pair, -bond.axial_stiffness);
    if (rupture_->is_removed(bond.pair.i) || rupture_->is_removed(bond.pair.j)) continue;
    broken_[bond.pair] = broken_seen_;
    exposed.insert(exposed.end(), {bond.pair.i, bond.pair.j});
    take_over(bond);
  }
  list_.expose(exposed);
  // A bond that broke in this step acted once more: its elements touch from the next pose on.
  list_.outdate();
}

void ElementContacts::take_over(const BrokenBond& bond) {
  const Vector to = nearest_chord(model_, bond.pair);
  const double stiff = stiffness(bond.pair, to), distance = bond.contact_distance(stiff);
  if (!(norm(to) < distance)) return;
  rupture_->lose(bond.pair, -contact_energy(stiff, distance, to),
                 {-contact_force(stiff, distance, to), {}, {}});
}

void ElementContacts::lose_contact(std::size_t k) {
  if (acts_[k] != 0) rupture_->lose(list_.candidates().pair(k), stored(k), load(k));
}

void ElementContacts::bond_anew(std::size_t k) {
  const ContactCandidate contact = list_.candidates()[k];
  const Vector to = list_.chord(contact);
  const double push = -dot(load_[k].force, history_[k].normal);
  if (!(push > *parameters_.rebonding_pressure * section(contact.pair, to))) return;
  const auto [i, j] = contact.pair;
  const std::vector<double>& radius = model_.specimen().radius;
  if (!may_be_bonded_anew(
          norm(to), radius[static_cast<std::size_t>(i)] + radius[static_cast<std::size_t>(j)]))
    return;
  // Where all places are taken they go on pushing.
  if (!model_.make_bond(contact.pair, norm(to))) return;
  lose_contact(k);
  const auto here = model_.slots().find(i, j), there = model_.slots().find(j, i);
  beams_->bind(model_, i, j, here->row, here->lane, to);
  beams_->bind(model_, j, i, there->row, there->lane, -to);
  const Beams::Bond bond = beams_->bond(model_, i, j, here->row, here->lane);
  add_stiffness(bonded_, contact.pair, bond.rigidity().axial / bond.rest_length());
  ++bonded_anew_;
  list_.outdate();
}

double ElementContacts::stiffness_with_friction() const {
  // A sphere turns as easily as it moves: m R² / J = 5/2 of its tangential stiffness adds.
  return has_rotation_ ? std::max(1.0, 3.5 * law_.tangential_stiffness_ratio) : 1;
}

std::vector<double> ElementContacts::stiffness_of_bonds() const {
  std::vector<double> sums(model_.elements(), 0.0);
  if (beams_ == nullptr) return sums;
  model_.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i > j) return;
    const Beams::Bond bond = beams_->bond(model_, i, j, row, lane);
    add_stiffness(sums, {i, j}, bond.rigidity().axial / bond.rest_length());
  });
  return sums;
}

void ElementContacts::add_stiffness(std::vector<double>& sums, Pair pair, double stiffness) const {
  sums[static_cast<std::size_t>(pair.i)] += stiffness;
  sums[static_cast<std::size_t>(pair.j)] += stiffness;
}

double ElementContacts::largest_over_mass(const std::vector<double>& sums) const {
  const double* inverse = model_.data(columns::inverse_mass);
  double largest = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) largest = std::max(largest, inverse[i] * sums[i]);
  return largest;
}

double ElementContacts::present_stiffness() const {
  std::vector<double> now = bonded_;
  for (std::size_t k = 0; k < list_.candidates().size(); ++k)
    if (acts_[k] != 0)
      add_stiffness(now, list_.candidates().pair(k),
                    stiffness_with_friction() * list_.candidates()[k].stiffness);
  return largest_over_mass(now);
}

double ElementContacts::longest_time_step() const {
  if (law_.is_stiff_as_bonds()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const std::int32_t element : list_.elements()) {
    const auto i = static_cast<std::size_t>(element);
    largest = std::max(largest,
                       model_.data(columns::inverse_mass)[i] * stiffness({element, element}, {}));
  }
  return std::sqrt(2 / (stiffness_with_friction() * largest));
}

std::vector<TimeStepCriterion> ElementContacts::time_step_criteria(const Model& model) const {
  const double slowed = std::max(1.0, damping_ratio_);
  if (const double longest = longest_time_step(); std::isfinite(longest))
    return {{"stiffness of contacts", longest / std::sqrt(2) / slowed}};
  const double factor = stiffening() * slowed;
  if (!(factor > 1)) return {};
  return {{"stiffness of contacts", beams_->time_step_criteria(model).front().value / factor}};
}

double ElementContacts::stiffening() const {
  if (beams_ == nullptr || !law_.is_stiff_as_bonds()) return 1;
  const double most = std::max(1.0, parameters_.stiffness_ratio * stiffness_with_friction());
  // A bond that is made anew is as much shorter, and stiffer, as its pressure strains the contact.
  return std::sqrt(std::max(most, 1 / (1 - rebonding_strain_)));
}

double ElementContacts::stiffened() const {
  return std::sqrt(std::max(largest_stiffness_, present_stiffness()) / stiffness_at_start_);
}

void ElementContacts::state(Archive& archive) {
  list_.state(archive);
  acts_.resize(list_.candidates().size());
  archive(history_, load_, acts_, nearer_, broken_seen_, removed_seen_, bonded_anew_, acting_,
          friction_, damped_, bonded_, largest_stiffness_);
  const std::size_t count = list_.candidates().size();
  const bool fits = acts_.size() == count;
  acts_.resize(count + lanes, 0);
  if (!archive.is_reading()) return;
  if (history_.size() != count || load_.size() != count || !fits ||
      bonded_.size() != model_.elements() ||
      (rupture_ != nullptr && broken_seen_ > rupture_->broken().size()))
    throw std::out_of_range("contacts of " + std::to_string(history_.size()) + " pairs");
  broken_.clear();
  for (std::size_t n = 0; rupture_ != nullptr && n < broken_seen_; ++n)
    broken_[rupture_->broken()[n].pair] = n;
}

}  // namespace solidem
