// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/central_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

#include "effects/central_force_parameters.hpp"
#include "laws/central_interaction.hpp"
#include "laws/crack_face.hpp"
#include "model/error.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

/// Centre of an element, and its share α R of ranges.
const double* place_in(const CentralMotion& m, std::int32_t element) {
  const std::ptrdiff_t length = m.dissipated_energy == nullptr ? 4 : 8;
  return m.position + length * element;
}

/// The chord of the pair in a slot; none beyond the range.
std::optional<Vector> chord_in(const CentralMotion& m, std::int32_t i, std::int32_t j,
                               std::size_t row, int lane) {
  const double *row_i = place_in(m, i), *row_j = place_in(m, j);
  Vector chord = row_vector(row_j) - row_vector(row_i);
  if (m.image_shift != nullptr)
    chord += lanes_vector(m.image_shift, Model::at_slot(columns::image_shift, row, lane));
  const double squared = dot(chord, chord), range = row_i[3] + row_j[3];
  if (!(squared < range * range) || !(squared > 0)) return std::nullopt;
  return chord;
}

}  // namespace

std::vector<const Column*> CentralForces::columns(const CentralForceParameters& parameters,
                                                  bool cracks, bool periodic) {
  std::vector<const Column*> asked = {
      parameters.dissipation ? &columns::position_and_velocity : &columns::position,
      &columns::velocity, &columns::inverse_mass};
  if (parameters.remembers_distances()) asked.push_back(&columns::rest_length);
  if (parameters.neighbours_change())
    asked.insert(asked.end(), {&columns::listed_position, &columns::listed_margin});
  if (parameters.dissipation) asked.push_back(&columns::dissipated_energy);
  if (cracks) asked.push_back(&columns::barycentre);
  if (periodic) asked.push_back(&columns::image_shift);
  return asked;
}

CentralForces::CentralForces(const CentralForceParameters& parameters,
                             const std::vector<double>& mass, Model& model)
    : parameters_(parameters), model_(model), neighbours_(parameters_, model) {
  const Specimen& specimen = model.specimen();
  const Model::Rows<double> buffers[] = {model.positions(), model.next_positions()};
  double* inverse_mass = model.data(columns::inverse_mass);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const Vector& p = specimen.position[i];
    for (const Model::Rows<double>& place : buffers) {
      const double row[] = {p.x, p.y, p.z, parameters_.range * specimen.radius[i]};
      std::copy_n(row, 4, place[i]);
    }
    inverse_mass[i] = 1 / mass[i];
  }

  const Neighbourhood& initial = neighbours_.initial();
  smallest_stiffness_ = std::numeric_limits<double>::infinity();
  double largest_stiffness = 0, largest_deep_stiffness = 0;  // at the start, at the deepest overlap
  for (std::size_t i = 0; i < specimen.size(); ++i)
    for (std::size_t k = initial.first[i]; k < initial.first[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(initial.neighbour[k]);
      const double distance = norm(neighbours_.initial_chord(i, k));
      const double radii = specimen.radius[i] + specimen.radius[j];
      const double equilibrium = neighbours_.rest_length(k);
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
  if (const std::size_t entries = neighbours_.initial_entries())
    mean_stiffness_ /= static_cast<double>(entries);
  if (largest_stiffness > 0)
    stiffening_ = std::max(1.0, largest_deep_stiffness / largest_stiffness);
  if (specimen.domain.is_periodic()) count_own_images();
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
            visit(i, chord, parameters_.remembers_distances() ? distance : 2 * radius[i]);
      }
}

void CentralForces::keep_neighbours() {
  neighbours_.keep(list_outdated_);
  list_outdated_ = false;
}

void CentralForces::finish_move(Model& model) {
  model.swap(model.position_column());
}

CentralMotion CentralForces::motion(Model& model) const {
  const auto where = [&](const Column& column) {
    return model.has(column) ? model.data(column) : nullptr;
  };
  CentralMotion motion{};
  motion.law = parameters_.law;
  motion.first_row = model.slots().first_row();
  motion.neighbour = model.slots().neighbours();
  motion.position = model.positions().first;
  motion.next_position = model.next_positions().first;
  motion.velocity = model.data(columns::velocity);
  motion.inverse_mass = model.data(columns::inverse_mass);
  motion.rest_length = where(columns::rest_length);
  motion.image_shift = where(columns::image_shift);
  motion.range = parameters_.range;
  motion.interpenetration = parameters_.interpenetration;
  if (parameters_.dissipation) {
    motion.dissipation = *parameters_.dissipation;
    motion.dissipated_energy = model.data(columns::dissipated_energy);
  }
  motion.barycentre = where(columns::barycentre);
  motion.neighbours_at_start = where(columns::neighbours_at_start);
  motion.listed_position = where(columns::listed_position);
  motion.listed_margin = where(columns::listed_margin);
  return motion;
}

void CentralForces::advance(Model& model, const Step& step) {
  keep_neighbours();
  neighbours_.count_step(step.time_step);
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
  still.dissipation = 0;
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
  const CentralMotion m = motion(model_);
  model_.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (chord_in(m, i, j, row, lane)) ++count[static_cast<std::size_t>(i)];
  });
  return count;
}

double CentralForces::largest_interpenetration() const {
  return compression_ratio_ > 0 ? 1 - 1 / compression_ratio_
                                : -std::numeric_limits<double>::infinity();
}

std::vector<TimeStepCriterion> CentralForces::time_step_criteria(const Model& model) const {
  const double* inverse_mass = model.data(columns::inverse_mass);
  const Neighbourhood& initial = neighbours_.initial();
  double squared_frequency = 0;
  for (std::size_t i = 0; i < model.elements(); ++i)
    for (std::size_t k = initial.first[i]; k < initial.first[i + 1]; ++k)
      std::visit(
          [&](const auto& law) {
            const double equilibrium = neighbours_.rest_length(k);
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

void CentralForces::for_each_pair(const Model& model, const PairVisit& visit) const {
  const CentralMotion m = motion(model_);
  const auto moved = [&](std::int32_t e) {
    return row_vector(place_in(m, e)) - model.specimen().position[static_cast<std::size_t>(e)];
  };
  Buffer<double> force;  // of the slots of a block
  for (std::size_t block = 0; block < model.slots().blocks(); ++block) {
    const std::size_t first_row = m.first_row[block];
    force.assign(3 * lanes * (m.first_row[block + 1] - first_row));
    kernels().find_central_efforts(m, {nullptr, nullptr, nullptr, nullptr, nullptr, force.begin()},
                                   block, block + 1);
    model.slots().for_each_in(
        block, [&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
          if (i > j) return;
          const auto chord = chord_in(m, i, j, row, lane);
          if (!chord) return;
          const std::size_t at = 3 * lanes * (row - first_row) + static_cast<std::size_t>(lane);
          visit({i, j, *chord - (moved(j) - moved(i)), lanes_vector(force.begin(), at), {}});
        });
  }
  if (own_images_.empty()) return;
  for_each_own_image([&](std::size_t i, const Vector& chord, double equilibrium) {
    if (neighbours_.is_absent(i)) return;
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
  ObservedMotion& seen = observation.motion;
  seen.force.assign(count, {});
  // Of each element, so that the sums do not depend on where empty slots stand.
  Buffer<double> forces(3 * count), energy(count), pairs(count), nearest(count);
  Buffer<double> power(parameters_.dissipation ? count : 0);
  const CentralMotion columns_now = motion(model_);
  for_blocks(blocks, least_blocks_moving, [&](std::size_t first, std::size_t last) {
    kernels().find_central_efforts(
        columns_now,
        {forces.begin(), energy.begin(), pairs.begin(), power.begin(), nearest.begin(), nullptr},
        first, last);
    for (std::size_t i = first * lanes; i < last * lanes; ++i)
      seen.force[i] = lanes_vector(forces.begin(), Model::at(columns::velocity, i));
  });
  double interactions = 0, potential = 0, compression_ratio = compression_ratio_;
  for (std::size_t i = 0; i < count; ++i) {
    potential += energy[i];
    interactions += pairs[i];
    compression_ratio = std::max(compression_ratio, nearest[i]);
  }
  for (std::size_t i = 0; i < own_images_.size(); ++i) {
    if (neighbours_.is_absent(i)) continue;
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
  seen.force.resize(elements);
  seen.velocity.resize(elements);
  seen.kinetic_energy = seen.squared_impulse = 0;
  for (std::size_t i = 0; i < elements; ++i) {
    if (!(inverse_mass[i] > 0)) continue;  // removed
    Vector& v = seen.velocity[i];
    v = lanes_vector(velocity, Model::at(columns::velocity, i)) +
        (observation.behind * inverse_mass[i]) * seen.force[i];
    seen.kinetic_energy += 0.5 * dot(v, v) / inverse_mass[i];
    seen.add_impulse({}, seen.force[i], inverse_mass[i]);
  }
  observation.add("interactions", interactions);
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
  archive(compression_ratio_, list_outdated_);
  neighbours_.state(archive);
}

}  // namespace solidem
