// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/contact_list.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <string>

#include "effects/surface_elements.hpp"
#include "model/blocks.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

constexpr double skin_of_radius = 0.3;  // mean radii
constexpr std::size_t elements_searched_a_block = 512;

std::vector<std::int32_t> reachable(const Model& model) {
  const std::vector<int> bonds = model.slots().coordination();
  std::vector<std::int32_t> found;
  if (std::all_of(bonds.begin(), bonds.end(), [](int number) { return number == 0; })) {
    found.resize(bonds.size());
    std::iota(found.begin(), found.end(), 0);
    return found;
  }
  found = surface_elements(model.specimen(), model.slots().pairs());
  const std::size_t surface = found.size();
  for (std::size_t i = 0; i < bonds.size(); ++i)
    if (bonds[i] == 0) found.push_back(static_cast<std::int32_t>(i));
  std::inplace_merge(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(surface),
                     found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::int32_t> sorted(std::vector<std::int32_t> elements) {
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

/// The largest square of the ways, m², that a block of elements has gone from where they were
/// listed.
double farthest_square(const double* pose, const std::vector<std::int32_t>& elements,
                       const std::vector<Vector>& listed_at, std::size_t block) {
  constexpr std::size_t ahead = 24;
  const std::size_t first = block * elements_searched_a_block,
                    end = std::min(elements.size(), first + elements_searched_a_block);
  double farthest = 0;
  for (std::size_t k = first; k < end; ++k) {
    if (k + ahead < end) __builtin_prefetch(pose + std::ptrdiff_t{8} * elements[k + ahead]);
    const double* now = pose + std::ptrdiff_t{8} * elements[k];
    const Vector away = Vector{now[0], now[1], now[2]} - listed_at[k];
    const double square = dot(away, away);
    // What is no number is far.
    if (!(square <= farthest)) farthest = square > farthest ? square : HUGE_VAL;
  }
  return farthest;
}

}  // namespace

ContactList::ContactList(const Model& model)
    : model_(model),
      periodic_(model.specimen().domain.is_periodic()),
      skin_(skin_of_radius * mean_radius(model.specimen())),
      elements_(reachable(model)),
      new_(elements_) {}

void ContactList::expose(const std::vector<std::int32_t>& more) {
  coming_.insert(coming_.end(), more.begin(), more.end());
  outdated_ = outdated_ || !more.empty();
}

void ContactList::withdraw(const std::vector<std::int32_t>& fewer) {
  going_.insert(going_.end(), fewer.begin(), fewer.end());
  outdated_ = outdated_ || !fewer.empty();
}

void ContactList::come_and_go() {
  const std::vector<std::int32_t> coming = sorted(std::move(coming_)),
                                  going = sorted(std::move(going_));
  coming_.clear();
  going_.clear();
  std::vector<std::int32_t> added, all, left;
  std::set_difference(coming.begin(), coming.end(), elements_.begin(), elements_.end(),
                      std::back_inserter(added));
  std::set_union(elements_.begin(), elements_.end(), added.begin(), added.end(),
                 std::back_inserter(all));
  std::set_difference(all.begin(), all.end(), going.begin(), going.end(), std::back_inserter(left));
  elements_ = std::move(left);
  new_.insert(new_.end(), added.begin(), added.end());
  std::sort(new_.begin(), new_.end());
}

bool ContactList::is_new(std::int32_t element) const {
  return std::binary_search(new_.begin(), new_.end(), element);
}

bool ContactList::is_outdated() {
  if (outdated_) return true;
  // Two elements that move towards each other close the skin together.
  const double* pose = model_.data(columns::pose);
  const std::size_t blocks = elements_.size() / elements_searched_a_block + 1;
  std::vector<double> farthest(blocks, 0.0);
  for_blocks(blocks, 16, [&](std::size_t first, std::size_t last) {
    for (std::size_t block = first; block < last; ++block)
      farthest[block] = farthest_square(pose, elements_, listed_at_, block);
  });
  const double square = *std::max_element(farthest.begin(), farthest.end());
  moved_ = std::sqrt(square);
  return !(square <= 0.25 * skin_ * skin_);
}

std::vector<ContactCandidate> ContactList::find_pairs() {
  const Specimen& specimen = model_.specimen();
  const double* pose = model_.data(columns::pose);
  std::vector<double> radius;
  radius.reserve(elements_.size());
  listed_at_.clear();
  listed_at_.reserve(elements_.size());
  for (const std::int32_t element : elements_) {
    const Vector place = position(pose, element);
    if (!std::isfinite(place.x + place.y + place.z))
      throw RunError("the run diverged: element " + std::to_string(element) +
                     " stands at no finite place any more");
    listed_at_.push_back(place);
    radius.push_back(specimen.radius[static_cast<std::size_t>(element)]);
  }
  const Neighbourhood near =
      find_neighbours(specimen.domain, listed_at_, radius, 1, skin_, {}, kernels().pick_near);
  std::vector<ContactCandidate> pairs;
  pairs.reserve(near.neighbour.size() / 2);
  for (std::size_t a = 0; a < elements_.size(); ++a)
    for (std::size_t k = near.first[a]; k < near.first[a + 1]; ++k) {
      const auto b = static_cast<std::size_t>(near.neighbour[k]);
      const Pair pair{elements_[a], elements_[b]};
      if (b < a || model_.slots().find(pair.i, pair.j)) continue;
      pairs.push_back({pair, near.image.empty() ? Image{} : near.image[k], 0, 0, 0});
    }
  return pairs;
}

void ContactList::list_sides() {
  first_side_.assign(elements_.size() + 1, 0);
  const auto place_of = [&](std::int32_t element) {
    return static_cast<std::size_t>(std::lower_bound(elements_.begin(), elements_.end(), element) -
                                    elements_.begin());
  };
  const std::size_t count = candidates_.size();
  std::vector<std::size_t> place_i(count), place_j(count);
  for (std::size_t k = 0; k < count; ++k) {
    place_i[k] = place_of(candidates_.pair(k).i);
    place_j[k] = place_of(candidates_.pair(k).j);
    ++first_side_[place_i[k] + 1];
    ++first_side_[place_j[k] + 1];
  }
  std::partial_sum(first_side_.begin(), first_side_.end(), first_side_.begin());
  std::vector<std::uint32_t> next(first_side_.begin(), first_side_.end() - 1);
  sides_.resize(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    sides_[next[place_i[k]]++] = {static_cast<std::uint32_t>(k), true};
    sides_[next[place_j[k]]++] = {static_cast<std::uint32_t>(k), false};
  }
}

void ContactList::state(Archive& archive) {
  std::vector<ContactCandidate> candidates = candidates_.all();
  archive(elements_, new_, listed_at_, candidates, outdated_, clearance_);
  if (!archive.is_reading()) return;
  const auto is_listed = [&](std::int32_t element) {
    return std::binary_search(elements_.begin(), elements_.end(), element);
  };
  const bool fits = listed_at_.size() == elements_.size() || outdated_;
  if (!fits || !std::is_sorted(elements_.begin(), elements_.end()) ||
      !std::all_of(candidates.begin(), candidates.end(), [&](const ContactCandidate& candidate) {
        return is_listed(candidate.pair.i) && is_listed(candidate.pair.j);
      }))
    throw std::out_of_range("contacts between elements that are not in their list");
  candidates_ = ContactCandidates(model_.specimen().domain, candidates);
  list_sides();
}

}  // namespace solidem
