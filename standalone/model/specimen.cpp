// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/specimen.hpp"

#include <cmath>
#include <numeric>

namespace solidem {

namespace {

constexpr double pi = 3.14159265358979323846;

double nearest_image(double difference, double extent, bool periodic) {
  return periodic ? difference - extent * std::nearbyint(difference / extent) : difference;
}

double volume_of_sphere(double radius) {
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

}  // namespace

double Domain::cross_section(int normal_axis) const {
  return volume / component(upper - lower, normal_axis);
}

Vector Domain::axis_point() const {
  Vector point = 0.5 * (lower + upper);
  component(point, axis) = component(lower, axis);
  if (angle > 0) {
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    component(point, first) = component(upper, first) - radius;
    component(point, second) = component(lower, second);
  }
  return point;
}

double Domain::arc() const {
  return angle > 0 ? angle : 2.0 * pi;
}

Vector Domain::first_transverse() const {
  Vector unit{};
  component(unit, (axis + 1) % 3) = 1.0;
  return unit;
}

Vector Domain::second_transverse() const {
  Vector unit{};
  component(unit, (axis + 2) % 3) = 1.0;
  return unit;
}

Vector rest_chord(const Specimen& specimen, Pair pair) {
  const Domain& domain = specimen.domain;
  const Vector extent = domain.upper - domain.lower;
  const Vector d = specimen.position[pair.j] - specimen.position[pair.i];
  return {nearest_image(d.x, extent.x, domain.periodic[0]),
          nearest_image(d.y, extent.y, domain.periodic[1]),
          nearest_image(d.z, extent.z, domain.periodic[2])};
}

double sphere_volume(const Specimen& specimen) {
  double sum = 0;
  for (const double radius : specimen.radius) sum += volume_of_sphere(radius);
  return sum;
}

double mean_radius(const Specimen& specimen) {
  return std::accumulate(specimen.radius.begin(), specimen.radius.end(), 0.0) /
         static_cast<double>(specimen.size());
}

std::vector<double> represented_mass(const Specimen& specimen, const std::vector<double>& density) {
  const double fraction = specimen.domain.volume / sphere_volume(specimen);
  std::vector<double> mass(specimen.size());
  for (std::size_t i = 0; i < mass.size(); ++i)
    mass[i] =
        density[density.size() == 1 ? 0 : i] * fraction * volume_of_sphere(specimen.radius[i]);
  return mass;
}

}  // namespace solidem
