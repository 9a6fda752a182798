// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/sensors.hpp"

namespace solidem {

PointSensor::PointSensor(const Sensor& sensor, const Model& model)
    : sensor_(sensor), element_(nearest_element(model.specimen(), sensor.point)) {}

void PointSensor::observe(const Model& model, Observation& observation) const {
  const auto i = static_cast<std::size_t>(element_);
  const std::string name = "sensor." + sensor_.name + ".";
  const auto add = [&](const std::string& quantity, const Vector& v) {
    observation.add(name + quantity + "_x", v.x);
    observation.add(name + quantity + "_y", v.y);
    observation.add(name + quantity + "_z", v.z);
  };
  if (sensor_.quantity == Sensor::Quantity::temperature) {
    observation.add(name + "temperature", model.data(columns::temperature)[i]);
    return;
  }
  const double* pose = model.data(columns::pose) + 8 * i;
  const Vector position{pose[0], pose[1], pose[2]};
  if (sensor_.quantity == Sensor::Quantity::position)
    add("position", position);
  else if (sensor_.quantity == Sensor::Quantity::displacement)
    add("displacement", position - model.specimen().position[i]);
  else
    add("velocity", observation.motion.velocity[i]);
}

}  // namespace solidem
