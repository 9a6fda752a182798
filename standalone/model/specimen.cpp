// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/specimen.hpp"

#include <cmath>
#include <numeric>

#include "laws/constants.hpp"
#include "model/periodic_image.hpp"

namespace solidem {

namespace {

double volume_of_sphere(double radius) {
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

}  // namespace

double Domain::cross_section(int normal_axis) const {
  return volume / component(upper - lower, normal_axis);
}

bool Domain::has_walls() const {
  return cuts == 0 && shape != "imported" && shape != "mesh" && shape != "bodies";
}

Vector Domain::axis_point() const {
  Vector point = 0.5 * (lower + upper);
  if (is_sphere()) return point;
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
  return to_nearest_image(specimen.domain, specimen.position[pair.j] - specimen.position[pair.i]);
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

std::vector<std::int32_t> body_of_elements(const Specimen& specimen) {
  if (specimen.bodies.empty()) return {};
  std::vector<std::int32_t> body(specimen.size(), 0);
  for (std::size_t b = 0; b < specimen.bodies.size(); ++b)
    for (const std::int32_t element : specimen.bodies[b].elements)
      body[static_cast<std::size_t>(element)] = static_cast<std::int32_t>(b);
  return body;
}

std::vector<double> represented_share(const Specimen& specimen) {
  std::vector<double> share(specimen.size(), specimen.domain.volume / sphere_volume(specimen));
  for (const Body& body : specimen.bodies) {
    double spheres = 0;
    for (const std::int32_t element : body.elements)
      spheres += volume_of_sphere(specimen.radius[static_cast<std::size_t>(element)]);
    for (const std::int32_t element : body.elements)
      share[static_cast<std::size_t>(element)] = body.volume / spheres;
  }
  return share;
}

std::vector<double> represented_mass(const Specimen& specimen, const std::vector<double>& density) {
  const std::vector<double> share = represented_share(specimen);
  std::vector<double> mass(specimen.size());
  for (std::size_t i = 0; i < mass.size(); ++i)
    mass[i] =
        density[density.size() == 1 ? 0 : i] * share[i] * volume_of_sphere(specimen.radius[i]);
  return mass;
}

}  // namespace solidem
