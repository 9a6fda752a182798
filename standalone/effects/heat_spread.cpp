// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_spread.hpp"

#include <algorithm>
#include <cmath>

#include "effects/selections.hpp"
#include "model/blocks.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double looks_per_length = 16;

double speed(const Path& path) {
  const Vector v{path[0].largest_rate(), path[1].largest_rate(), path[2].largest_rate()};
  return norm(v);
}

/// Of two lists by rising element, the values between them.
std::vector<ElementValue> between(const std::vector<ElementValue>& a,
                                  const std::vector<ElementValue>& b, double fraction) {
  std::vector<ElementValue> mixed;
  auto left = a.begin(), right = b.begin();
  while (left != a.end() || right != b.end()) {
    const bool has_left = left != a.end(), has_right = right != b.end();
    const bool takes_left = has_left && (!has_right || left->element <= right->element);
    const bool takes_right = has_right && (!has_left || right->element <= left->element);
    mixed.push_back({takes_left ? left->element : right->element, 0});
    if (takes_left) mixed.back().value += (1 - fraction) * (left++)->value;
    if (takes_right) mixed.back().value += fraction * (right++)->value;
  }
  return mixed;
}

}  // namespace

std::pair<Vector, Vector> HeatSpread::swept(const HeatedPart& part, const Path& path,
                                            const Domain& domain) {
  std::pair<Vector, Vector> box = part.bounds;
  for (int k = 0; k < 3; ++k) {
    const TimeFunction& f = path[static_cast<std::size_t>(k)];
    const auto [least, most] = std::minmax_element(f.value.begin(), f.value.end());
    const double sine = std::fabs(f.amplitude);
    component(box.first, k) += domain.periodic[k] ? -infinity : *least - sine;
    component(box.second, k) += domain.periodic[k] ? infinity : *most + sine;
  }
  return box;
}

HeatSpread::HeatSpread(std::vector<CellSolid> solids, HeatedPart part, Path path,
                       std::vector<double> share, const Specimen& specimen)
    : part_(std::move(part)),
      path_(std::move(path)),
      share_(std::move(share)),
      centre_(specimen.position.data()),
      domain_(specimen.domain),
      spacing_(std::min(part_.extent, mean_radius(specimen)) / looks_per_length / speed(path_)) {
  for (CellSolid& cell : solids) {
    if (cell.solid.empty()) continue;
    const auto [lower, upper] = bounds(cell.solid);
    solids_.push_back({std::move(cell), lower, upper});
  }
}

Vector HeatSpread::position(double time) const {
  return {path_[0](time), path_[1](time), path_[2](time)};
}

void HeatSpread::add_images(int axis, std::vector<Vector>& places) const {
  const double length = component(part_.bounds.second - part_.bounds.first, axis);
  if (!domain_.periodic[axis] || std::isinf(length)) return;
  const double low = component(domain_.lower, axis);
  const double period = component(domain_.upper, axis) - low;
  std::vector<Vector> all;
  for (const Vector& place : places)
    for (const int shift : {-1, 0, 1}) {
      Vector image = place;
      double& x = component(image, axis);
      x += period * (shift - std::floor((x - low) / period));
      all.push_back(image);
    }
  places = all;
}

std::vector<Vector> HeatSpread::images(const Vector& position) const {
  std::vector<Vector> places{position};
  for (int axis = 0; axis < 3; ++axis) add_images(axis, places);
  return places;
}

std::vector<ElementValue> HeatSpread::exact(const Vector& position) const {
  std::vector<ElementValue> amounts;
  std::vector<std::pair<const Solid*, Vector>> met;
  for (const Vector& place : images(position)) {
    const Vector from = place + part_.bounds.first, to = place + part_.bounds.second;
    for (const Solid& solid : solids_)
      if (from.x < solid.upper.x && to.x > solid.lower.x && from.y < solid.upper.y &&
          to.y > solid.lower.y && from.z < solid.upper.z && to.z > solid.lower.z)
        met.emplace_back(&solid, place);
  }
  std::vector<double> amount(met.size());
  for_blocks(met.size(), 500, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k)
      amount[k] = part_.amount(met[k].first->cell.solid, met[k].second);
  });
  for (std::size_t k = 0; k < met.size(); ++k) {
    const CellSolid& cell = met[k].first->cell;
    if (amount[k] > 0)
      amounts.push_back({cell.element, cell.is_taken_away ? -amount[k] : amount[k]});
  }
  std::stable_sort(
      amounts.begin(), amounts.end(),
      [](const ElementValue& a, const ElementValue& b) { return a.element < b.element; });
  std::vector<ElementValue> sums;
  for (const ElementValue& value : amounts) {
    if (sums.empty() || sums.back().element != value.element) sums.push_back({value.element, 0});
    sums.back().value += value.value;
  }
  return sums;
}

const std::vector<ElementValue>& HeatSpread::look(double knot) const {
  Look& look = looks_[std::fmod(knot, 2) == 0 ? 0 : 1];
  if (look.knot != knot) look = {knot, exact(position(rests() ? 0 : knot * spacing_))};
  return look.amounts;
}

std::int32_t HeatSpread::nearest_taker(const Vector& position) const {
  std::int32_t nearest = 0;
  double least = infinity;
  for (const Vector& place : images(position))
    for (std::size_t i = 0; i < share_.size(); ++i)
      if (const double distance = norm(centre_[i] - place); share_[i] > 0 && distance < least) {
        least = distance;
        nearest = static_cast<std::int32_t>(i);
      }
  return nearest;
}

double HeatSpread::at(double time, std::vector<ElementValue>& amounts) const {
  const double knot = rests() ? 0 : std::floor(time / spacing_);
  const std::vector<ElementValue> now =
      rests() ? look(0) : between(look(knot), look(knot + 1), time / spacing_ - knot);
  double met = 0, taken = 0;
  for (const ElementValue& amount : now) {
    const double share = share_[static_cast<std::size_t>(amount.element)];
    met += amount.value;
    if (!(amount.value > 0) || !(share > 0)) continue;
    amounts.push_back({amount.element, share * amount.value});
    taken += amounts.back().value;
  }
  if (met > 0 && !(taken > 0)) amounts.push_back({nearest_taker(position(time)), met});
  return met;
}

}  // namespace solidem
