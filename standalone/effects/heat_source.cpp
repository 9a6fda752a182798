// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_source.hpp"

#include <algorithm>
#include <cmath>

namespace solidem {

HeatSource::HeatSource(const HeatSourceParameters& parameters,
                       const std::vector<std::int32_t>& elements, std::vector<double> volume,
                       const Specimen& specimen)
    : HeatLoad("heat_source." + parameters.name),
      parameters_(parameters),
      volume_(std::move(volume)),
      centre_(specimen.position.data()) {
  for (const std::int32_t e : elements) fixed_.push_back({e, volume_[static_cast<std::size_t>(e)]});
  if (!parameters_.shape) {
    volume_ = {};  // a region is known once and for all
    return;
  }
  constexpr double pi = 3.14159265358979323846;
  double largest = 0;
  for (const double v : volume_) {
    radius_.push_back(std::cbrt(0.75 * v / pi));
    largest = std::max(largest, radius_.back());
  }
  const auto [lower, upper] = parameters_.shape->bounds();
  lower_ = lower - Vector{largest, largest, largest};
  upper_ = upper + Vector{largest, largest, largest};
}

void HeatSource::heated(double time, std::vector<ElementValue>& volumes) const {
  if (!parameters_.shape) {
    volumes.insert(volumes.end(), fixed_.begin(), fixed_.end());
    return;
  }
  const Vector position{parameters_.position[0](time), parameters_.position[1](time),
                        parameters_.position[2](time)};
  for (std::size_t i = 0; i < volume_.size(); ++i) {
    const Vector p = centre_[i] - position;
    if (!(volume_[i] > 0) || p.x < lower_.x || p.x > upper_.x || p.y < lower_.y || p.y > upper_.y ||
        p.z < lower_.z || p.z > upper_.z)
      continue;
    const double share =
        share_inside(parameters_.shape->signed_distance(p, radius_[i]) / radius_[i]);
    if (share > 0) volumes.push_back({static_cast<std::int32_t>(i), share * volume_[i]});
  }
}

void HeatSource::powers(double time, const double* /*temperature*/,
                        std::vector<ElementValue>& powers) const {
  const std::size_t first = powers.size();
  heated(time, powers);
  double density = parameters_.power(time);
  if (!parameters_.is_density) {
    double volume = 0;
    for (std::size_t k = first; k < powers.size(); ++k) volume += powers[k].value;
    density = volume > 0 ? density / volume : 0;
  }
  for (std::size_t k = first; k < powers.size(); ++k) powers[k].value *= density;
}

bool HeatSource::reaches(double time) const {
  std::vector<ElementValue> volumes;
  heated(time, volumes);
  return !volumes.empty();
}

bool HeatSource::is_steady() const {
  const bool rests = std::all_of(parameters_.position.begin(), parameters_.position.end(),
                                 [](const TimeFunction& f) { return f.is_constant(); });
  return parameters_.power.is_constant() && (parameters_.region || rests);
}

}  // namespace solidem
