// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_GAUGE_HPP
#define SOLIDEM_ENGINE_GAUGE_HPP

#include <vector>

#include "effects/mechanics.hpp"
#include "effects/setup.hpp"

namespace solidem {

/// Engineering stress and strain of a section between two planes.
/// Stress: the force of neighbours across a plane normal to the axis, averaged over all planes of
/// the section, over the cross-section at rest. Strain: slope of the least-squares line through the
/// displacements of the section's elements against their place at rest; lateral strain likewise,
/// mean of both directions. Only elements of the largest bonded component count.
class GaugeSection : public Observer {
 public:
  /// `component`: elements of the largest bonded component. Throws InputError when fewer than 10 of
  /// them lie in the section.
  GaugeSection(const Gauge& gauge, const std::vector<std::int32_t>& component,
               const Mechanics& mechanics, const Model& model);
  void observe(const Model& model, Observation& observation) const override;

  const std::vector<std::int32_t>& elements() const { return elements_; }

 private:
  double slope(const Model& model, int axis) const;

  Gauge gauge_;
  const Mechanics& mechanics_;
  double cross_section_;
  std::vector<std::int32_t> elements_;
};

}  // namespace solidem

#endif
