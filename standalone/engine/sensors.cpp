// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/sensors.hpp"

#include <algorithm>
#include <limits>

#include "effects/selections.hpp"
#include "model/error.hpp"
#include "model/least_squares.hpp"
#include "model/periodic_image.hpp"

namespace solidem {

namespace {

/// From a point to an element, or to the nearest image of it.
Vector way_to(const Specimen& specimen, std::int32_t element, const Vector& point) {
  return to_nearest_image(specimen.domain,
                          specimen.position[static_cast<std::size_t>(element)] - point);
}

/// Refuses a point that is far from all elements.
void check_point(const Sensor& sensor, const Specimen& specimen) {
  constexpr double far = 3;  // mean radii from the nearest surface: wider than any gap in a packing
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < specimen.size(); ++i)
    gap = std::min(gap, norm(way_to(specimen, static_cast<std::int32_t>(i), sensor.point)) -
                            specimen.radius[i]);
  if (gap <= far * mean_radius(specimen)) return;
  const Vector& p = sensor.point;
  throw InputError("[[sensors]] \"" + sensor.name + "\" point: (" + text(p.x) + ", " + text(p.y) +
                   ", " + text(p.z) + ") m is " + text(gap) +
                   " m away from the nearest element; expected a point of the body, which lies "
                   "between " +
                   bounds(specimen));
}

/// Weights of some elements round a point whose weighted sum of values is the value there of a
/// linear function fitted to them (least squares, nearer elements count more).
std::vector<ElementValue> fit_weights(const Specimen& specimen,
                                      const std::vector<std::int32_t>& elements,
                                      const Vector& point) {
  constexpr std::size_t enough = 12;
  std::vector<ElementValue> round;
  double reach = 3 * mean_radius(specimen);  // a wider ball sees more of a field's curvature
  while (true) {
    round.clear();
    for (const std::int32_t e : elements) {
      const double distance = norm(way_to(specimen, e, point));
      if (distance < reach) round.push_back({e, distance});
    }
    if (round.size() >= std::min(enough, elements.size())) break;
    reach *= 1.25;
  }
  const auto rows = static_cast<Eigen::Index>(round.size());
  Eigen::MatrixXd linear(rows, 4);
  Eigen::VectorXd weight(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const ElementValue& element = round[static_cast<std::size_t>(k)];
    const Vector d = (1 / reach) * way_to(specimen, element.element, point);
    weight[k] = 1 - dot(d, d);  // the root of the usual weight (1 − d²)²
    linear.row(k) = weight[k] * Eigen::RowVector4d(1, d.x, d.y, d.z);
  }
  // The minimal solution also where the elements lie in a plane or on a line.
  const Eigen::MatrixXd inverse = least_squares(linear, weight.asDiagonal());
  for (Eigen::Index k = 0; k < rows; ++k) round[static_cast<std::size_t>(k)].value = inverse(0, k);
  return round;
}

/// Weighted sum of a vector of elements.
template <class Of>
Vector weighted(const std::vector<ElementValue>& weights, const Of& of) {
  Vector sum{0, 0, 0};
  for (const ElementValue& weight : weights)
    sum = sum + weight.value * of(static_cast<std::size_t>(weight.element));
  return sum;
}

}  // namespace

std::vector<ElementValue> sampling_weights(const Specimen& specimen,
                                           const std::vector<std::int32_t>& elements,
                                           const Sensor& sensor) {
  if (sensor.sampling == Sensor::Sampling::fit)
    return fit_weights(specimen, elements, sensor.point);
  return {{nearest_element(specimen, elements, sensor.point), 1}};
}

Vector sampled_displacement(const std::vector<ElementValue>& weights,
                            const std::vector<Vector>& displacement) {
  return weighted(weights, [&](std::size_t i) { return displacement[i]; });
}

Vector resting_place(const Specimen& specimen, const std::vector<ElementValue>& weights,
                     const Sensor& sensor) {
  return sensor.sampling == Sensor::Sampling::fit
             ? sensor.point
             : specimen.position[static_cast<std::size_t>(weights.front().element)];
}

PointSensor::PointSensor(const Sensor& sensor, const Model& model, bool elements_touch)
    : sensor_(sensor) {
  const Specimen& specimen = model.specimen();
  check_point(sensor, specimen);
  const bool thermal = sensor.quantity == Sensor::Quantity::temperature;
  // What no bond holds stands still, unless others touch it: it tells nothing of the body.
  const Slots& joined = thermal ? model.conductors() : model.slots();
  const std::vector<std::int32_t> elements =
      elements_touch && !thermal ? elements_of_the_body(std::vector<int>(specimen.size(), 0))
                                 : elements_of_the_body(joined.coordination());
  weights_ = sampling_weights(specimen, elements, sensor);
}

std::vector<std::int32_t> PointSensor::elements() const {
  std::vector<std::int32_t> found;
  for (const ElementValue& weight : weights_) found.push_back(weight.element);
  return found;
}

void PointSensor::observe(const Model& model, Observation& observation) const {
  const std::string name = "sensor." + sensor_.name + ".";
  const auto add = [&](const std::string& quantity, const Vector& v) {
    observation.add(name + quantity + "_x", v.x);
    observation.add(name + quantity + "_y", v.y);
    observation.add(name + quantity + "_z", v.z);
  };
  if (sensor_.quantity == Sensor::Quantity::temperature) {
    double temperature = 0;
    for (const ElementValue& weight : weights_)
      temperature += weight.value * model.data(columns::temperature)[weight.element];
    observation.add(name + "temperature", temperature);
    return;
  }
  const std::vector<Vector>& rest = model.specimen().position;
  const Vector displacement = weighted(weights_, [&](std::size_t i) {
    const double* place = model.positions()[i];
    return Vector{place[0], place[1], place[2]} - rest[i];
  });
  if (sensor_.quantity == Sensor::Quantity::position)
    add("position", resting_place(model.specimen(), weights_, sensor_) + displacement);
  else if (sensor_.quantity == Sensor::Quantity::displacement)
    add("displacement", displacement);
  else
    add("velocity",
        weighted(weights_, [&](std::size_t i) { return observation.motion.velocity[i]; }));
}

}  // namespace solidem
