// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_GAUGE_HPP
#define SOLIDEM_ENGINE_GAUGE_HPP

#include <vector>

#include "effects/acting_effects.hpp"
#include "effects/effect.hpp"
#include "effects/setup.hpp"

namespace solidem {

/// Engineering stress and strain of a section between two planes.
/// Stress: the force of neighbours, and of contacts, across a plane normal to the axis, averaged
/// over all planes of the section, over the cross-section at rest; planes go with the elements.
/// Strain: of F = 1 + the gradient of the displacement that fits the section's elements best (least
/// squares, all nine components at once), the stretch of a line along the axis, |F e| − 1, so that
/// a rotation strains nothing; lateral strain likewise, mean of both directions. Only elements of
/// the largest bonded component count.
class GaugeSection : public Observer {
 public:
  /// `component`: elements of the largest bonded component. Throws InputError when fewer than 10 of
  /// them lie in the section, or when it reaches beyond the body.
  GaugeSection(const Gauge& gauge, const std::vector<std::int32_t>& component,
               std::vector<const ActsBetweenElements*> actors, const Model& model);
  void observe(const Model& model, Observation& observation) const override;

  const std::vector<std::int32_t>& elements() const { return elements_; }

 private:
  /// Stretches of lines along x, y and z, less 1.
  Vector strains(const Model& model) const;

  Gauge gauge_;
  std::vector<const ActsBetweenElements*> actors_;
  double cross_section_;
  std::vector<std::int32_t> elements_;
  std::vector<Vector> weight_;  ///< of each element's displacement: they sum to the gradient
};

}  // namespace solidem

#endif
