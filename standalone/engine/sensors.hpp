// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_ENGINE_SENSORS_HPP
#define SOLIDEM_ENGINE_SENSORS_HPP

#include <vector>

#include "effects/heat_load.hpp"
#include "effects/setup.hpp"

namespace solidem {

/// Follows a quantity at the element nearest to a point, or a temperature by a linear fit round it;
/// of elements that nothing joins to others only where those that touch act on each other.
class PointSensor : public Observer {
 public:
  PointSensor(const Sensor& sensor, const Model& model, bool elements_touch);
  void observe(const Model& model, Observation& observation) const override;
  std::int32_t element() const { return element_; }

 private:
  Sensor sensor_;
  std::int32_t element_ = 0;
  std::vector<ElementValue> weights_;  ///< of elements' temperatures
};

}  // namespace solidem

#endif
