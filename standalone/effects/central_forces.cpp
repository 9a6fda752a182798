// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/central_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "effects/central_force_parameters.hpp"
#include "laws/central_interaction.hpp"
#include "laws/crack_face.hpp"
#include "model/error.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr double default_skin = 0.1;  // mean radii
constexpr double search_cost = 25;    // steps that take as long as a search, without a skin

Vector row_vector(const double* row) {
  return {row[0], row[1], row[2]};
}

bool are_remembered(const CentralForceParameters& parameters) {
  return parameters.equilibrium == CentralForceParameters::Equilibrium::initial;
}

bool change(const CentralForceParameters& parameters) {
  return parameters.neighbours == CentralForceParameters::Neighbours::changing;
}

}  // namespace

std::vector<const Column*> CentralForces::columns(const CentralForceParameters& parameters,
                                                  bool cracks, bool periodic) {
  std::vector<const Column*> asked = {&columns::position, &columns::velocity,
                                      &columns::inverse_mass};
  if (are_remembered(parameters)) asked.push_back(&columns::rest_length);
  if (change(parameters)) asked.push_back(&columns::listed_position);
  if (parameters.dissipation)
    asked.insert(asked.end(), {&columns::velocity_for_neighbours, &columns::dissipated_energy});
  if (cracks) asked.push_back(&columns::barycentre);
  if (periodic) asked.push_back(&columns::image_shift);
  return asked;
}

CentralForces::CentralForces(const CentralForceParameters& parameters,
                             const std::vector<double>& mass, Model& model)
    : parameters_(parameters), model_(model) {
  const Specimen& specimen = model.specimen();
  if (change(parameters_)) skin_ = parameters_.skin.value_or(default_skin) * mean_radius(specimen);
  double* buffers[] = {model.data(columns::position), model.next(columns::position)};
  double* inverse_mass = model.data(columns::inverse_mass);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    for (double* place : buffers) {
      const double row[] = {p.x, p.y, p.z, parameters_.range * specimen.radius[i]};
      std::copy_n(row, 4, place + 4 * i);
    }
    inverse_mass[i] = 1 / mass[i];
  }

  // A margin for crystals, as bonds have it.
  const double reach = (1 + parameters_.bond_tolerance) * (1 + 1e-12);
  initial_ = find_neighbours(specimen.domain, specimen.position, specimen.radius, reach, 0);
  smallest_stiffness_ = std::numeric_limits<double>::infinity();
  double largest_stiffness = 0, largest_deep_stiffness = 0;  // at the start, at the deepest overlap
  for (std::size_t i = 0; i < specimen.size(); ++i)
    for (std::size_t k = initial_.first[i]; k < initial_.first[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(initial_.neighbour[k]);
      // Both sides take the chord from the lower to the higher element.
      const std::size_t a = std::min(i, j), b = std::max(i, j);
      Vector chord = specimen.position[b] - specimen.position[a];
      if (!initial_.image.empty()) {
        const Vector shift = image_shift(specimen.domain, initial_.image[k]);
        chord += i < j ? shift : -shift;
      }
      const double distance = norm(chord), radii = specimen.radius[i] + specimen.radius[j];
      if (!(distance > 1e-9 * radii))
        throw InputError("[central_forces] elements " + std::to_string(a) + " and " +
                         std::to_string(b) +
                         " stand at one place, so that no force between them has a direction; "
                         "expected a specimen whose elements stand apart");
      const double equilibrium = are_remembered(parameters_) ? distance : radii;
      initial_distance_.push_back(equilibrium);
      std::visit(
          [&](const auto& law) {
            const double fraction = parameters_.interpenetration;
            const double at_rest = bare_force(law, equilibrium, equilibrium).stiffness;
            const double deepest =
                bare_force(law, (1 - fraction) * equilibrium, equilibrium).stiffness;
            stiffens_ = stiffens_ || deepest > at_rest;
            largest_deep_stiffness = std::max({largest_deep_stiffness, at_rest, deepest});
            largest_stiffness = std::max(
                largest_stiffness, central_force(law, fraction, distance, equilibrium).stiffness);
            smallest_stiffness_ = std::min(smallest_stiffness_, at_rest);
            mean_stiffness_ += at_rest;
            depth_ = std::max(depth_, -central_potential(law, fraction, parameters_.range * radii,
                                                         equilibrium, equilibrium));
          },
          parameters_.law);
    }
  if (!initial_distance_.empty()) mean_stiffness_ /= static_cast<double>(initial_distance_.size());
  if (largest_stiffness > 0)
    stiffening_ = std::max(1.0, largest_deep_stiffness / largest_stiffness);
  if (model.has(columns::listed_position))
    for (std::size_t i = 0; i < specimen.size(); ++i)
      set_lanes_vector(model.data(columns::listed_position), Model::at(columns::listed_position, i),
                       specimen.position[i]);
  if (specimen.domain.is_periodic()) count_own_images();
  fill_slots();
}

void CentralForces::count_own_images() {
  own_images_.assign(model_.elements(), {});
  for_each_own_image([&](std::size_t i, const Vector& chord, double equilibrium) {
    const double range = 2 * parameters_.range * model_.specimen().radius[i];
    own_images_[i].pairs += 1;
    own_images_[i].potential += std::visit(
        [&](const auto& law) {
          return central_potential(law, parameters_.interpenetration, range, norm(chord),
                                   equilibrium);
        },
        parameters_.law);
  });
}

void CentralForces::for_each_own_image(const OwnImageVisit& visit) const {
  const Domain& domain = model_.specimen().domain;
  const std::vector<double>& radius = model_.specimen().radius;
  const double reach = 2 * parameters_.range * *std::max_element(radius.begin(), radius.end());
  std::array<double, 3> period{};
  std::array<int, 3> most{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!domain.periodic[axis]) continue;
    period[axis] = component(domain.upper - domain.lower, static_cast<int>(axis));
    most[axis] = static_cast<int>(reach / period[axis]);
  }
  // Of an image and the one on the other side, which make the same pair, the first.
  const auto is_counted = [](int a, int b, int c) {
    return a != 0 ? a > 0 : b != 0 ? b > 0 : c > 0;
  };
  for (int a = 0; a <= most[0]; ++a)
    for (int b = -most[1]; b <= most[1]; ++b)
      for (int c = -most[2]; c <= most[2]; ++c) {
        if (!is_counted(a, b, c)) continue;
        const Vector chord{a * period[0], b * period[1], c * period[2]};
        const double distance = norm(chord);
        for (std::size_t i = 0; i < radius.size(); ++i)
          if (distance < parameters_.range * 2 * radius[i])
            visit(i, chord, are_remembered(parameters_) ? distance : 2 * radius[i]);
      }
}

void CentralForces::fill_slots() {
  const Specimen& specimen = model_.specimen();
  Neighbourhood found;
  if (change(parameters_)) {
    std::vector<Vector> position(specimen.size());
    const double* listed = model_.data(columns::listed_position);
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] = lanes_vector(listed, Model::at(columns::listed_position, i));
    found = find_neighbours(specimen.domain, position, specimen.radius, parameters_.range, skin_,
                            absent_, kernels().pick_near);
  }
  const Neighbourhood& lists = change(parameters_) ? found : initial_;
  model_.replace_slots(Slots(lists.first, lists.neighbour, initial_.neighbour.size() / 2));
  ++searches_;
  double* rest_length =
      model_.has(columns::rest_length) ? model_.data(columns::rest_length) : nullptr;
  double* shift = model_.has(columns::image_shift) ? model_.data(columns::image_shift) : nullptr;
  const std::uint32_t* first_row = model_.slots().first_row();
  if (rest_length != nullptr)
    std::fill(rest_length, rest_length + model_.size(columns::rest_length), 1.0);
  const auto lay_out = [&](std::size_t i) {
    const int lane = static_cast<int>(i % lanes);
    std::size_t known = initial_.first[i];
    for (std::size_t k = lists.first[i]; k < lists.first[i + 1]; ++k) {
      const std::size_t row = first_row[i / lanes] + (k - lists.first[i]);
      const std::int32_t j = lists.neighbour[k];
      const Image image = lists.image.empty() ? Image{} : lists.image[k];
      if (shift != nullptr)
        set_lanes_vector(shift, Model::at_slot(columns::image_shift, row, lane),
                         image_shift(specimen.domain, image));
      if (rest_length == nullptr) continue;
      // Both lists go in the same order.
      const auto is_before = [&](std::size_t entry) {
        const std::int32_t other = initial_.neighbour[entry];
        return other != j ? other < j : !initial_.image.empty() && initial_.image[entry] < image;
      };
      while (known < initial_.first[i + 1] && is_before(known)) ++known;
      const bool is_known = known < initial_.first[i + 1] && initial_.neighbour[known] == j &&
                            (initial_.image.empty() || initial_.image[known] == image);
      rest_length[Model::at_slot(columns::rest_length, row, lane)] =
          is_known ? initial_distance_[known]
                   : specimen.radius[i] + specimen.radius[static_cast<std::size_t>(j)];
    }
  };
  for_blocks(specimen.size(), 5000, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) lay_out(i);
  });
}

void CentralForces::search() {
  if (!parameters_.skin) choose_skin();
  steps_since_ = 0;
  const double* positions = model_.data(columns::position);
  double* listed = model_.data(columns::listed_position);
  for (std::size_t i = 0; i < model_.elements(); ++i) {
    const Vector place = row_vector(positions + 4 * i);
    if (!std::isfinite(place.x + place.y + place.z))
      throw RunError("the run diverged: element " + std::to_string(i) +
                     " stands at no finite place any more");
    set_lanes_vector(listed, Model::at(columns::listed_position, i), place);
  }
  fill_slots();
}

void CentralForces::choose_skin() {
  // Lists grow with the volume they hold, and last as long as the fastest element takes for half
  // the skin. Counted, never timed: runs are alike on every machine, and whatever the skin, results
  // are the same bits.
  const double radius = mean_radius(model_.specimen());
  const double step = 0.5 * skin_ / static_cast<double>(std::max<std::int64_t>(1, steps_since_));
  const auto cost = [&](double skin) {
    const double size = 1 + skin / (2 * parameters_.range * radius);
    return size * size * size * (1 + search_cost / std::max(1.0, 0.5 * skin / step));
  };
  double best = skin_;
  for (const double fraction : {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0})
    if (cost(fraction * radius) < cost(best)) best = fraction * radius;
  skin_ = best;
}

void CentralForces::keep_neighbours() {
  if (!change(parameters_)) return;
  bool moved = list_outdated_;
  const std::vector<std::int32_t>& driven = model_.driven();
  const double* positions = model_.data(columns::position);
  const double* listed = model_.data(columns::listed_position);
  for (std::size_t k = 0; k < driven.size() && !moved; ++k) {
    const auto i = static_cast<std::size_t>(driven[k]);
    const Vector away = row_vector(positions + 4 * i) -
                        lanes_vector(listed, Model::at(columns::listed_position, i));
    moved = !(dot(away, away) <= 0.25 * skin_ * skin_);
  }
  if (moved) search();
  list_outdated_ = false;
}

void CentralForces::finish_move(Model& model) {
  model.swap(columns::position);
  if (model.has(columns::velocity_for_neighbours)) model.swap(columns::velocity_for_neighbours);
}

CentralMotion CentralForces::motion(Model& model) const {
  const auto where = [&](const Column& column) {
    return model.has(column) ? model.data(column) : nullptr;
  };
  CentralMotion motion{};
  motion.law = parameters_.law;
  motion.first_row = model.slots().first_row();
  motion.neighbour = model.slots().neighbours();
  motion.position = model.data(columns::position);
  motion.next_position = model.next(columns::position);
  motion.velocity = model.data(columns::velocity);
  motion.inverse_mass = model.data(columns::inverse_mass);
  motion.rest_length = where(columns::rest_length);
  motion.image_shift = where(columns::image_shift);
  motion.range = parameters_.range;
  motion.interpenetration = parameters_.interpenetration;
  if (parameters_.dissipation) {
    motion.dissipation = *parameters_.dissipation;
    motion.velocity_for_neighbours = model.data(columns::velocity_for_neighbours);
    motion.next_velocity_for_neighbours = model.next(columns::velocity_for_neighbours);
    motion.dissipated_energy = model.data(columns::dissipated_energy);
  }
  motion.barycentre = where(columns::barycentre);
  motion.neighbours_at_start = where(columns::neighbours_at_start);
  motion.listed_position = where(columns::listed_position);
  motion.listed_margin = 0.5 * skin_;
  return motion;
}

void CentralForces::advance(Model& model, const Step& step) {
  keep_neighbours();
  ++steps_since_;
  CentralMotion common = motion(model);
  common.kick = step.kick;
  common.drift = step.time_step;
  common.compression_ratio = compression_ratio_;
  const auto move = kernels().move_by_central_forces;
  std::mutex gathering;
  for_blocks(model.slots().blocks(), least_blocks_moving, [&](std::size_t first, std::size_t last) {
    CentralMotion mine = common;
    move(mine, first, last);
    const std::lock_guard<std::mutex> lock(gathering);
    compression_ratio_ = std::max(compression_ratio_, mine.compression_ratio);
    list_outdated_ = list_outdated_ || mine.outran;
  });
}

void CentralForces::accelerate(Model& model) const {
  CentralMotion still = motion(model);
  still.kick = 1;
  still.velocity_for_neighbours = nullptr;
  still.barycentre = nullptr;
  still.listed_position = nullptr;
  for_blocks(model.slots().blocks(), least_blocks_moving, [&](std::size_t first, std::size_t last) {
    CentralMotion mine = still;
    kernels().move_by_central_forces(mine, first, last);
  });
}

void CentralForces::find_crack_faces(double threshold) {
  CentralMotion common = motion(model_);
  common.crack_threshold = threshold;
  for_blocks(model_.slots().blocks(), least_blocks_moving,
             [&](std::size_t first, std::size_t last) {
               kernels().find_crack_faces(common, first, last);
             });
}

std::vector<int> CentralForces::neighbours_within_range() const {
  std::vector<int> count(model_.elements(), 0);
  model_.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (acting(model_, i, j, row, lane)) ++count[static_cast<std::size_t>(i)];
  });
  return count;
}

void CentralForces::exclude(std::int32_t element) {
  if (absent_.empty()) absent_.assign(model_.elements(), 0);
  absent_[static_cast<std::size_t>(element)] = 1;
  Slots& slots = model_.slots();
  const auto block = static_cast<std::size_t>(element / lanes);
  for (std::size_t row = slots.first_row()[block]; row < slots.first_row()[block + 1]; ++row) {
    const Slots::Place here{row, element % lanes};
    const std::int32_t other = slots.neighbour_of(here);
    if (other == element) continue;
    while (const auto there = slots.find(other, element)) {
      // An empty slot must not reach an image of its own element.
      slots.set_neighbour(*there, other);
      if (model_.has(columns::image_shift))
        set_lanes_vector(model_.data(columns::image_shift),
                         Model::at_slot(columns::image_shift, there->row, there->lane), {});
    }
    slots.set_neighbour(here, element);
    if (model_.has(columns::image_shift))
      set_lanes_vector(model_.data(columns::image_shift),
                       Model::at_slot(columns::image_shift, here.row, here.lane), {});
  }
}

std::vector<Pair> CentralForces::initial_pairs() const {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < model_.elements(); ++i)
    for (std::size_t k = initial_.first[i]; k < initial_.first[i + 1]; ++k)
      if (const Pair pair{static_cast<std::int32_t>(i), initial_.neighbour[k]};
          pair.i < pair.j && (pairs.empty() || !(pairs.back() == pair)))
        pairs.push_back(pair);
  return pairs;
}

double CentralForces::largest_interpenetration() const {
  return compression_ratio_ > 0 ? 1 - 1 / compression_ratio_
                                : -std::numeric_limits<double>::infinity();
}

std::vector<TimeStepCriterion> CentralForces::time_step_criteria(const Model& model) const {
  const double* inverse_mass = model.data(columns::inverse_mass);
  double squared_frequency = 0;
  for (std::size_t i = 0; i < model.elements(); ++i)
    for (std::size_t k = initial_.first[i]; k < initial_.first[i + 1]; ++k)
      std::visit(
          [&](const auto& law) {
            const double equilibrium = initial_distance_[k];
            const double nearest = (1 - parameters_.interpenetration) * equilibrium;
            const double stiffness = std::max(bare_force(law, equilibrium, equilibrium).stiffness,
                                              bare_force(law, nearest, equilibrium).stiffness);
            squared_frequency = std::max(squared_frequency, stiffness * inverse_mass[i]);
          },
          parameters_.law);
  return {
      {"stiffness of the pairs at the deepest overlap allowed", 1 / std::sqrt(squared_frequency)}};
}

double CentralForces::longest_time_step(double squared_frequency) const {
  const double squared = squared_frequency * stiffening_;
  if (!parameters_.dissipation) return 2 / std::sqrt(squared);
  // Drag sees velocities half a step late: dt² ω² + 2 dt (c/K) ω² = 4 is the limit.
  const double drag = *parameters_.dissipation / smallest_stiffness_ * squared_frequency;
  return (std::sqrt(drag * drag + 4 * squared) - drag) / squared;
}

std::optional<CentralForces::Acting> CentralForces::acting(const Model& model, std::int32_t i,
                                                           std::int32_t j, std::size_t row,
                                                           int lane) const {
  const double* positions = model.data(columns::position);
  const double* row_i = positions + std::ptrdiff_t{4} * i;
  const double* row_j = positions + std::ptrdiff_t{4} * j;
  Acting pair{};
  pair.chord = row_vector(row_j) - row_vector(row_i);
  if (model.has(columns::image_shift))
    pair.chord += lanes_vector(model.data(columns::image_shift),
                               Model::at_slot(columns::image_shift, row, lane));
  pair.distance = norm(pair.chord);
  const double range = row_i[3] + row_j[3];
  if (!(pair.distance < range) || !(pair.distance > 0)) return std::nullopt;
  pair.equilibrium =
      model.has(columns::rest_length)
          ? model.data(columns::rest_length)[Model::at_slot(columns::rest_length, row, lane)]
          : range / parameters_.range;
  std::visit(
      [&](const auto& law) {
        pair.push =
            central_force(law, parameters_.interpenetration, pair.distance, pair.equilibrium).force;
        pair.potential = central_potential(law, parameters_.interpenetration, range, pair.distance,
                                           pair.equilibrium);
        if (!model.has(columns::barycentre)) return;
        const double* barycentre = model.data(columns::barycentre);
        if (pair.push >= 0 ||
            !on_opposite_faces(row_vector(barycentre + std::ptrdiff_t{4} * i),
                               row_vector(barycentre + std::ptrdiff_t{4} * j), pair.chord))
          return;
        pair.push = 0;
      },
      parameters_.law);
  if (parameters_.dissipation) {
    const double* velocity = model.data(columns::velocity_for_neighbours);
    const double drag = dissipative_force(*parameters_.dissipation, pair.chord, 1 / pair.distance,
                                          row_vector(velocity + std::ptrdiff_t{4} * i) -
                                              row_vector(velocity + std::ptrdiff_t{4} * j));
    pair.push += drag;
    pair.power = drag * drag / *parameters_.dissipation;
  }
  return pair;
}

void CentralForces::for_each_pair(const Model& model, const PairVisit& visit) const {
  model.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i > j) return;
    const auto pair = acting(model, i, j, row, lane);
    if (!pair) return;
    const auto moved = [&](std::int32_t e) {
      return row_vector(model.data(columns::position) + std::ptrdiff_t{4} * e) -
             model.specimen().position[static_cast<std::size_t>(e)];
    };
    const Vector force = (-pair->push / pair->distance) * pair->chord;
    visit({i, j, pair->chord - (moved(j) - moved(i)), force, {}});
  });
  if (own_images_.empty()) return;
  for_each_own_image([&](std::size_t i, const Vector& chord, double equilibrium) {
    if (!absent_.empty() && absent_[i] != 0) return;
    const double distance = norm(chord);
    const double push = std::visit(
        [&](const auto& law) {
          return central_force(law, parameters_.interpenetration, distance, equilibrium).force;
        },
        parameters_.law);
    const auto element = static_cast<std::int32_t>(i);
    visit({element, element, chord, (-push / distance) * chord, {}});
  });
}

void CentralForces::observe(const Model& model, Observation& observation) const {
  const std::size_t count = model.slots().padded_elements(), blocks = model.slots().blocks();
  ObservedMotion& motion = observation.motion;
  motion.force.assign(count, {});
  // Of each element, so that the sums do not depend on where empty slots stand.
  std::vector<double> energy(count, 0.0), pairs(count, 0.0), power(count, 0.0);
  std::vector<double> nearest(count, compression_ratio_);
  for_blocks(blocks, least_blocks_moving, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block)
      model.slots().for_each_in(
          block, [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
            const auto pair = acting(model, i, j, row, lane);
            if (!pair) return;
            const auto own = static_cast<std::size_t>(i);
            motion.force[own] += (-pair->push / pair->distance) * pair->chord;
            energy[own] += 0.5 * pair->potential;
            pairs[own] += 0.5;
            power[own] += 0.5 * pair->power;
            nearest[own] = std::max(nearest[own], pair->equilibrium / pair->distance);
          });
  });
  double interactions = 0, potential = 0;
  for (std::size_t i = 0; i < count; ++i) {
    potential += energy[i];
    interactions += pairs[i];
  }
  for (std::size_t i = 0; i < own_images_.size(); ++i) {
    if (!absent_.empty() && absent_[i] != 0) continue;
    potential += own_images_[i].potential;
    interactions += own_images_[i].pairs;
  }
  observation.energies.add(EnergyLedger::Kind::stored, "potential_energy", potential);
  if (parameters_.dissipation) {
    const double* dissipated = model.data(columns::dissipated_energy);
    double sum = 0;
    // The power of now has acted for the half step that the velocities are behind.
    for (std::size_t i = 0; i < model.elements(); ++i)
      sum += dissipated[i] + observation.behind * power[i];
    observation.energies.add(EnergyLedger::Kind::dissipated, "dissipated_energy", sum);
  }
  const double* velocity = model.data(columns::velocity);
  const double* inverse_mass = model.data(columns::inverse_mass);
  const std::size_t elements = model.elements();
  motion.force.resize(elements);
  motion.velocity.resize(elements);
  motion.kinetic_energy = motion.squared_impulse = 0;
  for (std::size_t i = 0; i < elements; ++i) {
    if (!(inverse_mass[i] > 0)) continue;  // removed
    Vector& v = motion.velocity[i];
    v = lanes_vector(velocity, Model::at(columns::velocity, i)) +
        (observation.behind * inverse_mass[i]) * motion.force[i];
    motion.kinetic_energy += 0.5 * dot(v, v) / inverse_mass[i];
    motion.add_impulse({}, motion.force[i], inverse_mass[i]);
  }
  observation.add("interactions", interactions);
  const double compression_ratio =
      nearest.empty() ? 0 : *std::max_element(nearest.begin(), nearest.end());
  observation.add("largest_interpenetration",
                  compression_ratio > 0 ? 1 - 1 / compression_ratio : 0.0);
}

void CentralForces::summarise(const Model& /*model*/, Summary& summary) const {
  summary["neighbour_searches"] = searches();
  summary["largest_interpenetration"] = largest_interpenetration();
  summary["allowed_interpenetration"] = allowed_interpenetration();
}

void CentralForces::show(const Model& /*model*/, Frame& frame) const {
  const std::vector<int> within_range = neighbours_within_range();
  frame.add("interactions", {within_range.begin(), within_range.end()});
}

void CentralForces::state(Archive& archive) {
  std::vector<std::int32_t> gone;
  for (std::size_t i = 0; i < absent_.size(); ++i)
    if (absent_[i] != 0) gone.push_back(static_cast<std::int32_t>(i));
  archive(compression_ratio_, list_outdated_, searches_, steps_since_, skin_, gone);
  if (!archive.is_reading()) return;
  // Neighbours as they were listed then: in the columns of positions, which are restored by now.
  const std::size_t searches = searches_;
  absent_.clear();
  if (!gone.empty()) absent_.assign(model_.elements(), 0);
  fill_slots();
  for (const std::int32_t element : gone) exclude(element);
  searches_ = searches;
}

}  // namespace solidem
