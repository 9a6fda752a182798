// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/central_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "effects/kernels/kernels.hpp"
#include "model/blocks.hpp"
#include "model/error.hpp"
#include "model/lane_vectors.hpp"

namespace solidem {

namespace {

constexpr std::size_t least_elements = 5000;  // for which a thread of its own pays

// What a search takes, in steps that go through a list without margins.
constexpr double search_cost = 22;
// Of mean radii: margins of what is at rest, and what no search should reach beyond.
constexpr double least_margin = 0.02, largest_margin = 1;

}  // namespace

CentralNeighbours::CentralNeighbours(const CentralForceParameters& parameters, Model& model)
    : parameters_(parameters), model_(model) {
  const Specimen& specimen = model.specimen();
  list_initial();
  if (parameters_.neighbours_change()) {
    double* listed = model.data(columns::listed_position);
    for (std::size_t i = 0; i < specimen.size(); ++i)
      set_lanes_vector(listed, Model::at(columns::listed_position, i), specimen.position[i]);
    choose_margins();
  }
  fill_slots();
}

void CentralNeighbours::list_initial() {
  const Specimen& specimen = model_.specimen();
  // A margin for crystals, as bonds have it.
  const double reach = (1 + parameters_.bond_tolerance) * (1 + 1e-12);
  initial_ = find_neighbours(specimen.domain, specimen.position, specimen.radius, reach, 0);
  for (std::size_t i = 0; i < specimen.size(); ++i)
    for (std::size_t k = initial_.first[i]; k < initial_.first[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(initial_.neighbour[k]);
      const double distance = norm(initial_chord(i, k));
      const double radii = specimen.radius[i] + specimen.radius[j];
      if (!(distance > 1e-9 * radii))
        throw InputError("[central_forces] elements " + std::to_string(std::min(i, j)) + " and " +
                         std::to_string(std::max(i, j)) +
                         " stand at one place, so that no force between them has a direction; "
                         "expected a specimen whose elements stand apart");
      initial_rest_length_.push_back(parameters_.remembers_distances() ? distance : radii);
    }
}

Vector CentralNeighbours::initial_chord(std::size_t i, std::size_t entry) const {
  const Specimen& specimen = model_.specimen();
  const auto j = static_cast<std::size_t>(initial_.neighbour[entry]);
  // From the lower to the higher element.
  Vector chord = specimen.position[std::max(i, j)] - specimen.position[std::min(i, j)];
  if (!initial_.image.empty()) {
    const Vector shift = image_shift(specimen.domain, initial_.image[entry]);
    chord += i < j ? shift : -shift;
  }
  return i < j ? chord : -chord;
}

std::vector<Pair> CentralNeighbours::initial_pairs() const {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < model_.elements(); ++i)
    for (std::size_t k = initial_.first[i]; k < initial_.first[i + 1]; ++k)
      if (const Pair pair{static_cast<std::int32_t>(i), initial_.neighbour[k]};
          pair.i < pair.j && (pairs.empty() || !(pairs.back() == pair)))
        pairs.push_back(pair);
  return pairs;
}

Neighbourhood CentralNeighbours::list_now() const {
  const Specimen& specimen = model_.specimen();
  const double* listed = model_.data(columns::listed_position);
  const double* margin = model_.data(columns::listed_margin);
  std::vector<Vector> position(specimen.size());
  std::vector<double> reach(specimen.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    position[i] = lanes_vector(listed, Model::at(columns::listed_position, i));
    reach[i] = parameters_.range * specimen.radius[i] + margin[i];
  }
  return find_neighbours(specimen.domain, position, reach, 1, 0, absent_, kernels().pick_near);
}

std::vector<double> CentralNeighbours::rest_lengths(const Neighbourhood& list) const {
  const std::vector<double>& radius = model_.specimen().radius;
  std::vector<double> rest_length(list.neighbour.size());
  const auto match = [&](std::size_t i) {
    std::size_t known = initial_.first[i];
    for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
      const std::int32_t j = list.neighbour[k];
      const Image image = list.image.empty() ? Image{} : list.image[k];
      // Both lists go in the same order.
      const auto is_before = [&](std::size_t entry) {
        const std::int32_t other = initial_.neighbour[entry];
        return other != j ? other < j : !initial_.image.empty() && initial_.image[entry] < image;
      };
      while (known < initial_.first[i + 1] && is_before(known)) ++known;
      const bool is_known = known < initial_.first[i + 1] && initial_.neighbour[known] == j &&
                            (initial_.image.empty() || initial_.image[known] == image);
      rest_length[k] =
          is_known ? initial_rest_length_[known] : radius[i] + radius[static_cast<std::size_t>(j)];
    }
  };
  for_blocks(radius.size(), least_elements, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) match(i);
  });
  return rest_length;
}

void CentralNeighbours::fill_slots() {
  const Neighbourhood found = parameters_.neighbours_change() ? list_now() : Neighbourhood{};
  const Neighbourhood& list = parameters_.neighbours_change() ? found : initial_;
  model_.replace_slots(list.first, list.neighbour, initial_.neighbour.size() / 2);
  ++searches_;
  double* rest_length =
      model_.has(columns::rest_length) ? model_.data(columns::rest_length) : nullptr;
  double* shift = model_.has(columns::image_shift) ? model_.data(columns::image_shift) : nullptr;
  if (rest_length == nullptr && shift == nullptr) return;
  const std::vector<double> at_rest =
      rest_length != nullptr ? rest_lengths(list) : std::vector<double>{};
  const std::uint32_t* first_row = model_.slots().first_row();
  if (rest_length != nullptr)
    std::fill(rest_length, rest_length + model_.size(columns::rest_length), 1.0);
  const auto lay_out = [&](std::size_t i) {
    const int lane = static_cast<int>(i % lanes);
    for (std::size_t k = list.first[i]; k < list.first[i + 1]; ++k) {
      const std::size_t row = first_row[i / lanes] + (k - list.first[i]);
      if (shift != nullptr)
        set_lanes_vector(
            shift, Model::at_slot(columns::image_shift, row, lane),
            image_shift(model_.specimen().domain, list.image.empty() ? Image{} : list.image[k]));
      if (rest_length != nullptr)
        rest_length[Model::at_slot(columns::rest_length, row, lane)] = at_rest[k];
    }
  };
  for_blocks(model_.elements(), least_elements, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) lay_out(i);
  });
}

void CentralNeighbours::keep(bool outdated) {
  if (!parameters_.neighbours_change()) return;
  const auto positions = model_.positions();
  const double* listed = model_.data(columns::listed_position);
  const double* margin = model_.data(columns::listed_margin);
  const std::vector<std::int32_t>& driven = model_.driven();
  for (std::size_t k = 0; k < driven.size() && !outdated; ++k) {
    const auto i = static_cast<std::size_t>(driven[k]);
    const Vector away =
        row_vector(positions[i]) - lanes_vector(listed, Model::at(columns::listed_position, i));
    outdated = !(dot(away, away) <= margin[i] * margin[i]);
  }
  if (outdated) search();
}

void CentralNeighbours::search() {
  const auto positions = model_.positions();
  const double* velocity = model_.data(columns::velocity);
  double* listed = model_.data(columns::listed_position);
  for (std::size_t i = 0; i < model_.elements(); ++i) {
    const Vector place = row_vector(positions[i]);
    const Vector speed = lanes_vector(velocity, Model::at(columns::velocity, i));
    if (!std::isfinite(place.x + place.y + place.z + norm(speed)))
      throw RunError("the run diverged: element " + std::to_string(i) +
                     " stands at no finite place any more");
    set_lanes_vector(listed, Model::at(columns::listed_position, i), place);
  }
  choose_margins();
  steps_since_ = 0;
  fill_slots();
}

std::vector<double> CentralNeighbours::ways_in_a_step() const {
  const double* velocity = model_.data(columns::velocity);
  std::vector<double> ways(model_.elements());
  for (std::size_t i = 0; i < ways.size(); ++i)
    ways[i] = time_step_ * norm(lanes_vector(velocity, Model::at(columns::velocity, i)));
  return ways;
}

double CentralNeighbours::set_margins(double steps, const std::vector<double>& ways,
                                      double* margin) const {
  const double radius = mean_radius(model_.specimen());
  const auto count = static_cast<double>(ways.size());
  const double mean_way = std::accumulate(ways.begin(), ways.end(), 0.0) / count;
  double volume = 0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    // What stands still now may be as fast as others soon.
    margin[i] = std::clamp(caution_ * steps * (mean_way + ways[i]), least_margin * radius,
                           largest_margin * radius);
    const double growth = 1 + margin[i] / (parameters_.range * radius);
    volume += growth * growth * growth;
  }
  return volume / count;
}

void CentralNeighbours::choose_margins() {
  double* margin = model_.data(columns::listed_margin);
  if (parameters_.skin) {
    const double half = 0.5 * *parameters_.skin * mean_radius(model_.specimen());
    std::fill_n(margin, model_.elements(), half);
    return;
  }
  // Counted, never timed: runs are alike on every machine, and whatever the margins, results are
  // the same bits.
  if (expected_steps_ > 0) {
    const double lasted = static_cast<double>(std::max<std::int64_t>(1, steps_since_));
    const double change = std::clamp(std::sqrt(expected_steps_ / lasted), 0.9, 1.5);
    caution_ = std::clamp(change * caution_, 0.5, 10.0);
  }
  const std::vector<double> ways = ways_in_a_step();
  double least = std::numeric_limits<double>::infinity();
  for (const double steps : {5.0, 10.0, 20.0, 40.0, 80.0, 160.0})
    if (const double cost = set_margins(steps, ways, margin) + search_cost / steps; cost < least) {
      least = cost;
      expected_steps_ = steps;
    }
  set_margins(expected_steps_, ways, margin);
}

void CentralNeighbours::exclude(std::int32_t element) {
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

void CentralNeighbours::state(Archive& archive) {
  std::vector<std::int32_t> gone;
  for (std::size_t i = 0; i < absent_.size(); ++i)
    if (absent_[i] != 0) gone.push_back(static_cast<std::int32_t>(i));
  archive(searches_, steps_since_, time_step_, expected_steps_, caution_, gone);
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
