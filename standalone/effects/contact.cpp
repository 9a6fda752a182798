// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/contact.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "effects/assembly.hpp"
#include "effects/effect_kind.hpp"
#include "effects/push.hpp"
#include "keys/rules.hpp"
#include "laws/contact.hpp"
#include "neighbours/linked_cells.hpp"

namespace solidem {

namespace {

/// Place of an element in a buffer of poses.
Vector centre_of(const double* pose, std::int32_t element) {
  const double* row = pose + std::ptrdiff_t{8} * element;
  return {row[0], row[1], row[2]};
}

/// Pairs whose bonds broke after so many had.
std::set<Pair> broken_since(const std::vector<BrokenBond>& broken, std::size_t count) {
  std::set<Pair> pairs;
  for (std::size_t k = count; k < broken.size(); ++k) pairs.insert(broken[k].pair);
  return pairs;
}

}  // namespace

ElementContacts::ElementContacts(const ContactParameters& parameters, double rebonding_strain,
                                 const Beams& beams, Rupture& rupture, Model& model)
    : parameters_(parameters),
      rebonding_strain_(rebonding_strain),
      beams_(beams),
      rupture_(rupture),
      model_(model),
      bonded_(model.elements(), 0.0) {
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i > j) return;
    const Beams::Bond bond = beams_.bond(model, i, j, row, lane);
    add_stiffness(bonded_, {i, j}, bond.rigidity().axial / bond.rest_length());
  });
  stiffness_at_start_ = largest_stiffness_ = largest_over_mass(bonded_);
}

Vector ElementContacts::chord(const Candidate& candidate) const {
  const double* pose = model_.data(columns::pose);
  return centre_of(pose, candidate.pair.j) - centre_of(pose, candidate.pair.i) + candidate.shift;
}

bool ElementContacts::is_pressed(const Candidate& candidate, const Vector& chord) {
  return !candidate.is_new && dot(chord, chord) < candidate.distance * candidate.distance;
}

void ElementContacts::settle_new() {
  for (Candidate& candidate : candidates_) {
    if (!candidate.is_new) continue;
    candidate.is_new = false;
    if (const double now = norm(chord(candidate)); now < candidate.distance)
      candidate.distance = nearer_[candidate.pair] = now;
  }
}

bool ElementContacts::must_search(const double* pose) const {
  if (rupture_.broken().size() != broken_then_) return true;
  // Two elements that move towards each other close the skin together.
  const double allowed = 0.25 * skin_ * skin_;
  for (std::size_t k = 0; k < surface_elements_.size(); ++k) {
    const Vector moved = centre_of(pose, surface_elements_[k]) - searched_at_[k];
    if (dot(moved, moved) > allowed) return true;
  }
  return false;
}

void ElementContacts::search(const double* pose) {
  const Specimen& specimen = model_.specimen();
  std::map<Pair, const BrokenBond*> once_bonded;
  const std::set<Pair> broke_now = broken_since(rupture_.broken(), broken_then_);
  surface_elements_.clear();
  for (const BrokenBond& bond : rupture_.broken()) {
    if (rupture_.is_removed(bond.pair.i) || rupture_.is_removed(bond.pair.j)) continue;
    once_bonded[bond.pair] = &bond;
    surface_elements_.insert(surface_elements_.end(), {bond.pair.i, bond.pair.j});
  }
  std::sort(surface_elements_.begin(), surface_elements_.end());
  surface_elements_.erase(std::unique(surface_elements_.begin(), surface_elements_.end()),
                          surface_elements_.end());
  broken_then_ = rupture_.broken().size();
  const std::vector<Candidate> before = std::move(candidates_);
  const auto was_candidate = [&before](const Pair& pair) {
    const auto at = std::lower_bound(
        before.begin(), before.end(), pair,
        [](const Candidate& candidate, const Pair& p) { return candidate.pair < p; });
    return at != before.end() && at->pair == pair;
  };
  for (const Candidate& candidate : before)
    if (rupture_.is_removed(candidate.pair.i) || rupture_.is_removed(candidate.pair.j))
      hand_over(candidate, 1);
  candidates_.clear();
  searched_at_.clear();
  if (surface_elements_.empty()) return;

  double largest = 0;
  CellBox box{centre_of(pose, surface_elements_[0]), centre_of(pose, surface_elements_[0]),
              specimen.domain.periodic};
  for (const std::int32_t e : surface_elements_) {
    const Vector at = centre_of(pose, e);
    searched_at_.push_back(at);
    largest = std::max(largest, specimen.radius[static_cast<std::size_t>(e)]);
    for (int axis = 0; axis < 3; ++axis) {
      component(box.lower, axis) = std::min(component(box.lower, axis), component(at, axis));
      component(box.upper, axis) = std::max(component(box.upper, axis), component(at, axis));
    }
  }
  skin_ = 0.5 * largest;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.periodic[static_cast<std::size_t>(axis)]) {
      component(box.lower, axis) = component(specimen.domain.lower, axis);
      component(box.upper, axis) = component(specimen.domain.upper, axis);
    } else {
      component(box.lower, axis) -= largest;
      component(box.upper, axis) += largest;
    }
  }
  LinkedCells cells(box, 2 * largest + skin_, surface_elements_.size());
  cells.sort(searched_at_);
  cells.for_each_pair(0, cells.cell_count(), [&](std::int32_t a, std::int32_t b, Vector to) {
    std::int32_t i = surface_elements_[static_cast<std::size_t>(a)],
                 j = surface_elements_[static_cast<std::size_t>(b)];
    if (i > j) {
      std::swap(i, j);
      to = -to;
    }
    const auto n = static_cast<std::size_t>(i), m = static_cast<std::size_t>(j);
    const double radii = specimen.radius[n] + specimen.radius[m];
    if (dot(to, to) > (radii + skin_) * (radii + skin_) || model_.slots().find(i, j)) return;
    Candidate candidate{{i, j}, radii, 0, 0, {}, false};
    if (const auto found = once_bonded.find({i, j}); found != once_bonded.end()) {
      const BrokenBond& bond = *found->second;
      candidate.stiffness = parameters_.stiffness_ratio * bond.axial_stiffness;
      candidate.distance = bond.contact_distance(candidate.stiffness);
      candidate.section = bond.section;
    } else {
      const BeamSection<double> section =
          beams_.properties().section(specimen.radius[n], specimen.radius[m], to);
      candidate.section = beam_area(section);
      candidate.stiffness =
          parameters_.stiffness_ratio * section.young_modulus * candidate.section / radii;
      if (const auto known = nearer_.find({i, j}); known != nearer_.end())
        candidate.distance = known->second;
      else
        candidate.is_new = !was_candidate({i, j});
    }
    candidate.shift = to - (centre_of(pose, j) - centre_of(pose, i));
    if (!specimen.domain.is_periodic()) candidate.shift = {};
    // A bond that breaks while pressed hands on what the contact holds.
    if (broke_now.count({i, j}) > 0) hand_over(candidate, -1);
    candidates_.push_back(candidate);
  });
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.pair < b.pair; });
  measure_stiffness();
}

void ElementContacts::hand_over(const Candidate& candidate, double sign) {
  const Vector to = chord(candidate);
  if (!is_pressed(candidate, to)) return;
  rupture_.lose(candidate.pair, sign * contact_energy(candidate.stiffness, candidate.distance, to),
                {sign * contact_force(candidate.stiffness, candidate.distance, to), {}, {}});
}

void ElementContacts::measure_stiffness() {
  const std::vector<BrokenBond>& broken = rupture_.broken();
  for (; subtracted_ < broken.size(); ++subtracted_)
    add_stiffness(bonded_, broken[subtracted_].pair, -broken[subtracted_].axial_stiffness);
  std::vector<double> now = bonded_;
  for (const Candidate& candidate : candidates_) {
    if (is_pressed(candidate, chord(candidate)))
      add_stiffness(now, candidate.pair, candidate.stiffness);
  }
  largest_stiffness_ = std::max(largest_stiffness_, largest_over_mass(now));
}

void ElementContacts::add_stiffness(std::vector<double>& sums, const Pair& pair,
                                    double stiffness) const {
  sums[static_cast<std::size_t>(pair.i)] += stiffness;
  sums[static_cast<std::size_t>(pair.j)] += stiffness;
}

double ElementContacts::largest_over_mass(const std::vector<double>& sums) const {
  const double* inverse_mass = model_.data(columns::inverse_mass);
  double largest = 0;
  for (std::size_t i = 0; i < sums.size(); ++i)
    largest = std::max(largest, inverse_mass[i] * sums[i]);
  return largest;
}

void ElementContacts::advance(Model& model, const Step& step) {
  if (rupture_.broken().empty()) return;
  settle_new();
  std::vector<Candidate> pressed;
  for (const Candidate& candidate : candidates_) {
    const Vector to = chord(candidate);
    if (!is_pressed(candidate, to)) continue;
    const Vector force = contact_force(candidate.stiffness, candidate.distance, to);
    push(model, step, candidate.pair.i, force);
    push(model, step, candidate.pair.j, -force);
    if (parameters_.rebonding_pressure &&
        norm(force) > *parameters_.rebonding_pressure * candidate.section)
      pressed.push_back(candidate);
  }
  for (const Candidate& candidate : pressed) bond_anew(candidate);
  // A bond that broke in this step acted once more: its elements touch from the next pose on.
  const double* next = model.next(columns::pose);
  if (!pressed.empty() || must_search(next)) search(next);
}

void ElementContacts::bond_anew(const Candidate& candidate) {
  const auto [i, j] = candidate.pair;
  const Vector to = chord(candidate);
  // Where all places are taken they go on pushing.
  if (!model_.make_bond(candidate.pair, norm(to))) return;
  hand_over(candidate, 1);
  const auto here = model_.slots().find(i, j), there = model_.slots().find(j, i);
  beams_.bind(model_, i, j, here->row, here->lane, to);
  beams_.bind(model_, j, i, there->row, there->lane, -to);
  const Beams::Bond bond = beams_.bond(model_, i, j, here->row, here->lane);
  add_stiffness(bonded_, candidate.pair, bond.rigidity().axial / bond.rest_length());
  ++bonded_anew_;
}

void ElementContacts::observe(const Model& model, Observation& observation) const {
  double stored = 0;
  for (const Candidate& candidate : candidates_) {
    const Vector to = chord(candidate);
    if (!is_pressed(candidate, to)) continue;
    const Vector force = contact_force(candidate.stiffness, candidate.distance, to);
    stored += contact_energy(candidate.stiffness, candidate.distance, to);
    observe_push(model, observation, candidate.pair.i, force);
    observe_push(model, observation, candidate.pair.j, -force);
  }
  observation.energies.add(EnergyLedger::Kind::stored, "contact_energy", stored);
  if (parameters_.rebonding_pressure)
    observation.add("bonds_formed", static_cast<double>(bonded_anew_));
}

std::vector<TimeStepCriterion> ElementContacts::time_step_criteria(const Model& model) const {
  if (!(stiffening() > 1)) return {};
  return {{"stiffness of contacts", beams_.time_step_criteria(model).front().value / stiffening()}};
}

double ElementContacts::stiffening() const {
  double most = std::max(1.0, parameters_.stiffness_ratio);
  // A bond that is made anew is as much shorter, and stiffer, as its pressure strains the contact.
  return std::sqrt(std::max(most, 1 / (1 - rebonding_strain_)));
}

double ElementContacts::stiffened() const {
  return stiffness_at_start_ > 0 ? std::sqrt(largest_stiffness_ / stiffness_at_start_) : 1;
}

void ElementContacts::state(Archive& archive) {
  archive(bonded_anew_, broken_then_, skin_, candidates_, nearer_, surface_elements_, searched_at_,
          bonded_, subtracted_, largest_stiffness_);
  if (archive.is_reading() && searched_at_.size() != surface_elements_.size())
    throw std::out_of_range("positions of " + std::to_string(searched_at_.size()) + " elements");
}

namespace {

std::vector<Key> contact_keys(ContactParameters& p, Reading& /*reading*/) {
  return {
      may_have("stiffness_ratio", number(p.stiffness_ratio, positive))
          .means("stiffness over E S / l of the bond"),
      may_have("rebonding_pressure", quantity(p.rebonding_pressure, dimension::modulus, positive))
          .means("force over section of the bond above which a new one is made, free of load; "
                 "not with `\"scaled-offset\"`")
          .without("never")};
}

/// The strain of a contact under the pressure at which it becomes a bond, of the softest beams; 0
/// where none does.
double rebonding_strain(const ContactParameters& contact, const BeamParameters& beams) {
  if (!contact.rebonding_pressure) return 0;
  double modulus = beams.young_modulus;
  if (const auto& grain = beams.anisotropy)
    modulus = std::min({modulus, grain->tangential_modulus, grain->radial_modulus});
  return *contact.rebonding_pressure / (contact.stiffness_ratio * modulus);
}

void finish_contact(const Section& section, ContactParameters& p, Reading& reading) {
  const auto& beams = reading.setup.get<BeamParameters>();
  if (beams && rebonding_strain(p, *beams) >= 1)
    section.refuse("rebonding_pressure", "no contact can bear so much: its elements would meet",
                   "less than stiffness_ratio times Young's modulus of the beams");
  const auto& plasticity = reading.setup.get<PlasticityParameters>();
  if (p.rebonding_pressure && plasticity &&
      plasticity->law == PlasticityParameters::Law::scaled_offset)
    section.refuse("bonds by the law scaled-offset cannot be made anew",
                   "law = \"radial-return\" in [plasticity], or no rebonding_pressure");
}

void plan_contact(const Setup& setup, Plan& plan) {
  const auto& contact = setup.get<ContactParameters>();
  if (!contact) return;
  plan.effects.push_back(
      {"contact", "[contact]", "", Phase::push, [contact = *contact](Assembly& assembly) {
         return std::make_unique<ElementContacts>(
             contact, rebonding_strain(contact, *assembly.setup.get<BeamParameters>()),
             assembly.need<Beams>(), assembly.need<Rupture>(), assembly.model);
       }});
}

}  // namespace

EffectKind contact_kind() {
  EffectKind kind = single_kind<ContactParameters>("contact", contact_keys, finish_contact);
  kind.beside = {"rupture"};
  kind.problem_alone = "no bond ever breaks";
  kind.plan = plan_contact;
  kind.example =
      "[contact]\n"
      "rebonding_pressure = \"200 MPa\"\n";
  return kind;
}

}  // namespace solidem
