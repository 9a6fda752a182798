// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/constants.hpp"
#include "model/error.hpp"
#include "neighbours/linked_cells.hpp"

namespace solidem {

namespace {

void insist_on_length(double value, const char* key) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(fmt::format("[specimen] {} = {} m: expected a length above zero", key, value));
}

// The part of a round body's bounding box across its axis, for an axis at the origin.
void set_sector(double angle, double inner_radius, double radius, Vector& low, Vector& high,
                int axis) {
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  const bool past_square = angle > 0.5 * pi;
  component(low, first) = (past_square ? radius : inner_radius) * std::cos(angle);
  component(high, first) = radius;
  component(low, second) = 0;
  component(high, second) = past_square ? radius : radius * std::sin(angle);
}

Domain round_body_of(const SpecimenRecipe& recipe) {
  const bool hollow = recipe.shape != "cylinder", wedge = recipe.shape == "wedge";
  insist_on_length(recipe.length, "length");
  insist_on_length(recipe.radius, hollow ? "outer_radius" : "radius");
  if (hollow) insist_on_length(recipe.inner_radius, "inner_radius");
  if (hollow && !(recipe.inner_radius < recipe.radius))
    throw InputError(
        fmt::format("[specimen] inner_radius = {} m: expected a length below outer_radius = {} m",
                    recipe.inner_radius, recipe.radius));
  if (wedge && !(recipe.angle > 0 && recipe.angle < pi))
    throw InputError(fmt::format("[specimen] angle = {} rad: expected an angle above 0 and below π",
                                 recipe.angle));
  if (recipe.axis != "x" && recipe.axis != "y" && recipe.axis != "z")
    throw InputError(fmt::format("[specimen] axis = \"{}\": expected x, y or z", recipe.axis));
  Domain domain;
  domain.axis = recipe.axis[0] - 'x';
  domain.radius = recipe.radius;
  domain.inner_radius = hollow ? recipe.inner_radius : 0.0;
  domain.angle = wedge ? recipe.angle : 0.0;
  const double R = domain.radius;
  Vector low{-R, -R, -R}, high{R, R, R};
  if (wedge) set_sector(recipe.angle, recipe.inner_radius, R, low, high, domain.axis);
  component(low, domain.axis) = 0;
  component(high, domain.axis) = recipe.length;
  for (int axis = 0; axis < 3; ++axis)
    if (axis != domain.axis && recipe.periodic[axis])
      throw InputError(fmt::format(
          "[specimen] periodic along {}: the {} can be periodic along its axis ({}) only",
          "xyz"[axis], recipe.shape, recipe.axis));
  domain.lower = recipe.origin + low;
  domain.upper = recipe.origin + high;
  domain.volume =
      0.5 * domain.arc() * (R - domain.inner_radius) * (R + domain.inner_radius) * recipe.length;
  return domain;
}

Domain sphere_of(const SpecimenRecipe& recipe) {
  insist_on_length(recipe.radius, "radius");
  for (const bool periodic : recipe.periodic)
    if (periodic) throw InputError("[specimen] periodic: a sphere has walls all round");
  Domain domain;
  const double R = recipe.radius;
  domain.radius = R;
  domain.lower = recipe.origin - Vector{R, R, R};
  domain.upper = recipe.origin + Vector{R, R, R};
  domain.volume = volume_of(domain);
  return domain;
}

}  // namespace

Domain shape_of(const SpecimenRecipe& recipe) {
  Domain domain;
  if (recipe.shape == "cylinder" || recipe.shape == "annulus" || recipe.shape == "wedge") {
    domain = round_body_of(recipe);
  } else if (recipe.shape == "sphere") {
    domain = sphere_of(recipe);
  } else if (recipe.shape == "box" || recipe.shape == "plate") {
    const bool plate = recipe.shape == "plate";
    insist_on_length(recipe.size.x, plate ? "length" : "size (along x)");
    insist_on_length(recipe.size.y, plate ? "width" : "size (along y)");
    insist_on_length(recipe.size.z, plate ? "thickness" : "size (along z)");
    domain.lower = recipe.origin;
    domain.upper = recipe.origin + recipe.size;
    domain.volume = recipe.size.x * recipe.size.y * recipe.size.z;
  } else {
    throw InputError(
        fmt::format("[specimen] shape = \"{}\": expected box, plate, cylinder, annulus, wedge, "
                    "sphere or crystal",
                    recipe.shape));
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
  if (domain.is_sphere()) return 4.0 / 3.0 * pi * R * R * R;
  return 0.5 * domain.arc() * (R - r) * (R + r) * component(extent, domain.axis);
}

double narrowest_width(const Domain& domain) {
  double width = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (!domain.periodic[axis] && !(domain.radius > 0 && axis != domain.axis))
      width = std::min(width, component(domain.upper - domain.lower, axis));
  if (!(domain.radius > 0)) return width;
  width = std::min(
      width, domain.inner_radius > 0 ? domain.radius - domain.inner_radius : 2.0 * domain.radius);
  if (!(domain.angle > 0)) return width;
  // Of a sphere that touches both planes and the outer wall.
  const double sine = std::sin(0.5 * domain.angle);
  return std::min(width, 2.0 * domain.radius * sine / (1.0 + sine));
}

double shortest_period(const Domain& domain) {
  double period = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (domain.periodic[axis])
      period = std::min(period, component(domain.upper - domain.lower, axis));
  return period;
}

}  // namespace solidem
