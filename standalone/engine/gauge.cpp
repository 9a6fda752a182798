// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/gauge.hpp"

#include <string>
#include <utility>

#include "effects/gauge_check.hpp"
#include "model/displacement_gradient.hpp"
#include "model/error.hpp"

namespace solidem {

GaugeSection::GaugeSection(const Gauge& gauge, const std::vector<std::int32_t>& component_elements,
                           std::vector<const ActsBetweenElements*> actors, const Model& model)
    : gauge_(gauge),
      actors_(std::move(actors)),
      cross_section_(model.specimen().domain.cross_section(gauge.axis)) {
  check_gauge(gauge, model.specimen().domain);
  for (const std::int32_t e : component_elements) {
    const double along =
        component(model.specimen().position[static_cast<std::size_t>(e)], gauge.axis);
    if (gauge.lower <= along && along <= gauge.upper) elements_.push_back(e);
  }
  if (elements_.size() < 10)
    throw InputError("[gauge] holds " + std::to_string(elements_.size()) +
                     " elements; widen lower … upper until it holds 10 or more");
  weight_ = gradient_weights(model.specimen(), elements_);
}

Vector GaugeSection::strains(const Model& model) const {
  const auto positions = model.positions();
  Vector line[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // what lines along x, y and z have become
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    const auto i = static_cast<std::size_t>(elements_[k]);
    const Vector& p = model.specimen().position[i];
    const Vector shift{positions[i][0] - p.x, positions[i][1] - p.y, positions[i][2] - p.z};
    for (int axis = 0; axis < 3; ++axis) line[axis] += component(weight_[k], axis) * shift;
  }
  return {norm(line[0]) - 1, norm(line[1]) - 1, norm(line[2]) - 1};
}

void GaugeSection::observe(const Model& model, Observation& observation) const {
  const Specimen& specimen = model.specimen();
  double tension = 0;  // force times length along the axis
  for (const ActsBetweenElements* actor : actors_)
    actor->for_each_pair(model, [&](const PairLoad& pair) {
      const double from =
          component(specimen.position[static_cast<std::size_t>(pair.i)], gauge_.axis);
      const double along = component(pair.chord, gauge_.axis);
      const double pull = component(pair.force, gauge_.axis);
      tension += (along > 0 ? pull : -pull) * length_inside(gauge_, specimen.domain, from, along);
    });
  const double stress = tension / (gauge_.upper - gauge_.lower) / cross_section_;
  const Vector strain = strains(model);
  const double lateral =
      0.5 * (component(strain, (gauge_.axis + 1) % 3) + component(strain, (gauge_.axis + 2) % 3));
  observation.add("gauge.stress", stress);
  observation.add("gauge.strain", component(strain, gauge_.axis));
  observation.add("gauge.lateral_strain", lateral);
}

}  // namespace solidem
