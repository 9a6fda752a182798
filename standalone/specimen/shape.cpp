// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "neighbours/linked_cells.hpp"

namespace solidem {

namespace {

constexpr double pi = 3.14159265358979323846;

void insist_on_length(double value, const char* key) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("specimen.{} = {} m: expected a length above zero", key, value));
}

bool is_round(const Domain& domain, int axis) {
  return domain.radius > 0 && axis != domain.axis;
}

Domain cylinder_of(const SpecimenRecipe& recipe) {
  insist_on_length(recipe.length, "length");
  insist_on_length(recipe.radius, "radius");
  if (recipe.axis != "x" && recipe.axis != "y" && recipe.axis != "z")
    throw InputError(fmt::format("specimen.axis = \"{}\": expected x, y or z", recipe.axis));
  Domain domain;
  domain.axis = recipe.axis[0] - 'x';
  domain.radius = recipe.radius;
  domain.volume = pi * recipe.radius * recipe.radius * recipe.length;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = component(recipe.origin, axis);
    const bool round = is_round(domain, axis);
    if (round && recipe.periodic[axis])
      throw InputError(fmt::format(
          "specimen.periodic along {}: a cylinder can be periodic along its axis ({}) only",
          "xyz"[axis], recipe.axis));
    component(domain.lower, axis) = round ? origin - recipe.radius : origin;
    component(domain.upper, axis) = origin + (round ? recipe.radius : recipe.length);
  }
  return domain;
}

}  // namespace

Domain shape_of(const SpecimenRecipe& recipe) {
  Domain domain;
  if (recipe.shape == "cylinder") {
    domain = cylinder_of(recipe);
  } else if (recipe.shape == "box" || recipe.shape == "plate") {
    const bool plate = recipe.shape == "plate";
    insist_on_length(recipe.size.x, plate ? "length" : "size (along x)");
    insist_on_length(recipe.size.y, plate ? "width" : "size (along y)");
    insist_on_length(recipe.size.z, plate ? "thickness" : "size (along z)");
    domain.lower = recipe.origin;
    domain.upper = recipe.origin + recipe.size;
    domain.volume = recipe.size.x * recipe.size.y * recipe.size.z;
  } else {
    throw InputError(fmt::format(
        "specimen.shape = \"{}\": expected box, plate, cylinder or crystal", recipe.shape));
  }
  domain.shape = recipe.shape;
  domain.periodic = recipe.periodic;
  return domain;
}

Domain scaled(const Domain& domain, double unit) {
  Domain result = domain;
  result.lower = {};
  result.upper = (1.0 / unit) * (domain.upper - domain.lower);
  result.volume = domain.volume / (unit * unit * unit);
  result.radius = domain.radius / unit;
  result.inner_radius = domain.inner_radius / unit;
  return result;
}

double volume_of(const Domain& domain) {
  const Vector extent = domain.upper - domain.lower;
  if (!(domain.radius > 0)) return extent.x * extent.y * extent.z;
  const double R = domain.radius, r = domain.inner_radius;
  return 0.5 * domain.arc() * (R - r) * (R + r) * component(extent, domain.axis);
}

double narrowest_width(const Domain& domain) {
  double width = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (!domain.periodic[axis])
      width = std::min(width, component(domain.upper - domain.lower, axis));
  return width;
}

double shortest_period(const Domain& domain) {
  double period = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[axis])
      period = std::min(period, component(domain.upper - domain.lower, axis));
  return period;
}

}  // namespace solidem
