// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/gauge.hpp"

#include <algorithm>
#include <string>

#include "model/error.hpp"

namespace solidem {

GaugeSection::GaugeSection(const Gauge& gauge, const std::vector<std::int32_t>& component_elements,
                           const Mechanics& mechanics, const Model& model)
    : gauge_(gauge),
      mechanics_(mechanics),
      cross_section_(model.specimen().domain.cross_section(gauge.axis)) {
  for (const std::int32_t e : component_elements) {
    const double along =
        component(model.specimen().position[static_cast<std::size_t>(e)], gauge.axis);
    if (gauge.lower <= along && along <= gauge.upper) elements_.push_back(e);
  }
  if (elements_.size() < 10)
    throw InputError("[gauge] holds " + std::to_string(elements_.size()) +
                     " elements; widen lower … upper until it holds 10 or more");
}

double GaugeSection::slope(const Model& model, int axis) const {
  const auto positions = model.positions();
  double mean_place = 0, mean_shift = 0;
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    const double place = component(model.specimen().position[i], axis);
    mean_place += place;
    mean_shift += positions[i][axis] - place;
  }
  const auto count = static_cast<double>(elements_.size());
  mean_place /= count;
  mean_shift /= count;
  double covariance = 0, variance = 0;
  for (const std::int32_t e : elements_) {
    const auto i = static_cast<std::size_t>(e);
    const double place = component(model.specimen().position[i], axis);
    const double shift = positions[i][axis] - place;
    covariance += (place - mean_place) * (shift - mean_shift);
    variance += (place - mean_place) * (place - mean_place);
  }
  return covariance / variance;
}

void GaugeSection::observe(const Model& model, Observation& observation) const {
  const Specimen& specimen = model.specimen();
  double tension = 0;  // force times length along the axis
  mechanics_.for_each_pair(model, [&](std::int32_t i, std::int32_t j, const Vector& force) {
    const double from = component(specimen.position[static_cast<std::size_t>(i)], gauge_.axis);
    const double along = component(rest_chord(specimen, {i, j}), gauge_.axis);
    const double low = std::max(std::min(from, from + along), gauge_.lower);
    const double high = std::min(std::max(from, from + along), gauge_.upper);
    if (high <= low) return;
    const double pull = component(force, gauge_.axis);
    tension += (along > 0 ? pull : -pull) * (high - low);
  });
  const double stress = tension / (gauge_.upper - gauge_.lower) / cross_section_;
  const double lateral =
      0.5 * (slope(model, (gauge_.axis + 1) % 3) + slope(model, (gauge_.axis + 2) % 3));
  observation.add("gauge.stress", stress);
  observation.add("gauge.strain", slope(model, gauge_.axis));
  observation.add("gauge.lateral_strain", lateral);
}

}  // namespace solidem
