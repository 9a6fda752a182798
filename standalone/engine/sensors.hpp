// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_SENSORS_HPP
#define SOLIDEM_ENGINE_SENSORS_HPP

#include <vector>

#include "effects/heat_load.hpp"
#include "effects/setup.hpp"

namespace solidem {

/// Elements and the weights with which their values make that at a sensor's point: the nearest
/// element, or a linear fit round the point.
std::vector<ElementValue> sampling_weights(const Specimen& specimen,
                                           const std::vector<std::int32_t>& elements,
                                           const Sensor& sensor);

/// Displacement that a sensor shows where elements have these, m.
Vector sampled_displacement(const std::vector<ElementValue>& weights,
                            const std::vector<Vector>& displacement);

/// Where what a sensor follows is at rest, m: the centre of its element, or the point of a fit.
Vector resting_place(const Specimen& specimen, const std::vector<ElementValue>& weights,
                     const Sensor& sensor);

/// Follows a quantity at the element nearest to a point, or by a linear fit round it; of elements
/// that nothing joins to others only where those that touch act on each other.
class PointSensor : public Observer {
 public:
  PointSensor(const Sensor& sensor, const Model& model, bool elements_touch);
  void observe(const Model& model, Observation& observation) const override;
  /// That it reads.
  std::vector<std::int32_t> elements() const;

 private:
  Sensor sensor_;
  std::vector<ElementValue> weights_;
};

}  // namespace solidem

#endif
