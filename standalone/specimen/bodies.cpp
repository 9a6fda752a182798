// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "model/outline.hpp"
#include "neighbours/linked_cells.hpp"
#include "specimen/bonds.hpp"
#include "specimen/report.hpp"

namespace solidem {

namespace {

constexpr double tolerated_overlap = 1e-6;   // of R_i + R_j, of bodies that touch
constexpr double deepest_when_bonded = 0.5;  // likewise, of bodies that are bonded

struct Place {
  Quaternion<double> turned;
  Vector about, shift;
  Vector of(const Vector& point) const { return about + rotate(turned, point - about) + shift; }
};

// Half of the extents of a turned body along x, y and z, and where their middle is.
std::pair<Vector, Vector> turned_extents(const Domain& domain, const Place& place) {
  const Vector half = 0.5 * (domain.upper - domain.lower);
  const Vector middle = place.of(0.5 * (domain.lower + domain.upper));
  Vector reach{};
  for (int k = 0; k < 3; ++k) {
    Vector unit{};
    component(unit, k) = 1;
    const Vector local = rotate(conjugate(place.turned), unit);
    double& r = component(reach, k);
    if (domain.is_sphere()) {
      r = domain.radius;
    } else if (domain.radius > 0 && !(domain.angle > 0)) {
      const double along = component(local, domain.axis);
      r = std::abs(along) * component(half, domain.axis) +
          domain.radius * std::sqrt(std::max(0.0, 1 - along * along));
    } else {
      r = std::abs(local.x) * half.x + std::abs(local.y) * half.y + std::abs(local.z) * half.z;
    }
  }
  return {middle, reach};
}

Specimen make_one(const BodyRecipe& recipe, const ReportProgress& progress) {
  const std::string name = "[[body]] \"" + recipe.name + "\"", alone = "[specimen]";
  try {
    return make_specimen(recipe.recipe, progress);
  } catch (const InputError& error) {
    const std::string words = error.what();
    const bool is_of_recipe = words.compare(0, alone.size(), alone) == 0;
    throw InputError(name + (is_of_recipe ? words.substr(alone.size()) : ": " + words));
  }
}

void append(Specimen& all, Outline& outline, const Specimen& one, const BodyRecipe& recipe) {
  if (one.domain.is_periodic())
    throw InputError("[[body]] \"" + recipe.name +
                     "\" periodic: a body that repeats itself has no place beside others; expected "
                     "walls on all sides");
  const Place place{recipe.turned, recipe.recipe.file.empty() ? recipe.recipe.origin : Vector{},
                    recipe.shift};
  const auto first = static_cast<std::int32_t>(all.size());
  Body body;
  body.name = recipe.name;
  body.shape = one.domain.cuts > 0 ? one.domain.shape + " with cuts" : one.domain.shape;
  body.volume = one.domain.volume;
  const auto [middle, reach] = turned_extents(one.domain, place);
  body.lower = middle - reach;
  body.upper = middle + reach;
  for (std::size_t i = 0; i < one.size(); ++i) {
    body.elements.push_back(first + static_cast<std::int32_t>(i));
    all.position.push_back(place.of(one.position[i]));
    all.radius.push_back(one.radius[i]);
  }
  for (const Pair& pair : one.bonds) all.bonds.push_back({first + pair.i, first + pair.j});
  for (const auto& [name, elements] : one.sets) {
    std::vector<std::int32_t>& set = all.sets[recipe.name + "." + name];
    for (const std::int32_t element : elements) set.push_back(first + element);
  }
  all.contact_margin = std::max(all.contact_margin, one.contact_margin);
  if (one.report.count(estimated_volume) != 0) all.report[estimated_volume] += one.domain.volume;
  all.bodies.push_back(std::move(body));
  outline.bodies.push_back({one.domain, one.outline, place.turned, place.of({})});
}

void put_around(const std::vector<Body>& bodies, Domain& domain) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  domain = Domain{};
  domain.shape = "bodies";
  domain.lower = {infinity, infinity, infinity};
  domain.upper = -domain.lower;
  for (const Body& body : bodies) {
    domain.volume += body.volume;
    for (int k = 0; k < 3; ++k) {
      double &low = component(domain.lower, k), &high = component(domain.upper, k);
      low = std::min(low, component(body.lower, k));
      high = std::max(high, component(body.upper, k));
    }
  }
}

void link(Specimen& all, const std::vector<BodyRecipe>& recipes) {
  for (std::size_t b = 0; b < recipes.size(); ++b)
    for (const std::string& name : recipes[b].bonded_to) {
      const auto found = std::find_if(recipes.begin(), recipes.end(),
                                      [&](const BodyRecipe& other) { return other.name == name; });
      if (found == recipes.end() || found->name == recipes[b].name)
        throw InputError(
            fmt::format("[[body]] \"{}\" bonded_to \"{}\": expected the name of "
                        "another body",
                        recipes[b].name, name));
      all.bodies[b].bonded_to.push_back(static_cast<std::int32_t>(found - recipes.begin()));
    }
}

// Calls visit(pair, distance over R_i + R_j) for elements of two bodies that are nearer than a
// reach, in R_i + R_j.
template <class Visit>
void for_each_meeting(const Specimen& specimen, double reach, const Visit& visit) {
  const std::vector<std::int32_t> body = body_of_elements(specimen);
  const Domain& domain = specimen.domain;
  for (const Pair& pair :
       neighbour_pairs({domain.lower, domain.upper, domain.periodic}, specimen.position,
                       specimen.radius, reach - 1, specimen.contact_margin)) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    if (body[i] == body[j]) continue;
    visit(pair, body[i], body[j],
          norm(specimen.position[j] - specimen.position[i]) /
              (specimen.radius[i] + specimen.radius[j]));
  }
}

std::string element_of(const Specimen& specimen, std::int32_t element, std::int32_t body) {
  const Body& of = specimen.bodies[static_cast<std::size_t>(body)];
  const Vector& p = specimen.position[static_cast<std::size_t>(element)];
  return fmt::format("element {} of \"{}\" at ({:.6g}, {:.6g}, {:.6g}) m",
                     element - of.elements.front(), of.name, p.x, p.y, p.z);
}

struct Meeting {
  Pair pair{};
  std::int32_t body = 0, other = 0;
  double distance = std::numeric_limits<double>::infinity();  // over R_i + R_j
  int count = 0;

  void add(const Pair& found, std::int32_t a, std::int32_t b, double at) {
    ++count;
    if (!(at < distance)) return;
    pair = found;
    body = a;
    other = b;
    distance = at;
  }
};

void check_overlap(const Specimen& specimen) {
  Meeting deepest;
  for_each_meeting(specimen, 1, [&](const Pair& pair, std::int32_t a, std::int32_t b, double at) {
    const double tolerated =
        may_be_bonded(specimen, a, b) ? deepest_when_bonded : tolerated_overlap;
    if (at < 1 - tolerated) deepest.add(pair, a, b, at);
  });
  if (deepest.count == 0) return;
  const double reach = specimen.radius[static_cast<std::size_t>(deepest.pair.i)] +
                       specimen.radius[static_cast<std::size_t>(deepest.pair.j)];
  throw InputError(fmt::format(
      "[[body]]: bodies overlap at the start: {} and {} by {:.4g} m, {} pairs of elements in all; "
      "expected bodies that stand apart, such as by a shift of {:.2g} m more",
      element_of(specimen, deepest.pair.i, deepest.body),
      element_of(specimen, deepest.pair.j, deepest.other), (1 - deepest.distance) * reach,
      deepest.count, (1 - deepest.distance) * reach));
}

}  // namespace

Specimen make_bodies(const std::vector<BodyRecipe>& recipes, const ReportProgress& progress) {
  Specimen all;
  Outline outline;
  bool all_alike = true;
  double tolerance = 0;
  for (std::size_t b = 0; b < recipes.size(); ++b) {
    const Specimen one = make_one(recipes[b], progress);
    if (b == 0) tolerance = one.bond_tolerance;
    all_alike = all_alike && one.bond_tolerance == tolerance;
    append(all, outline, one, recipes[b]);
  }
  all.outline = std::make_shared<const Outline>(std::move(outline));
  put_around(all.bodies, all.domain);
  link(all, recipes);
  check_overlap(all);
  if (all_alike && tolerance > -1) {
    make_bonds(all, tolerance);
  } else {
    all.bond_tolerance = -1;
    std::sort(all.bonds.begin(), all.bonds.end());
  }
  measure_specimen(all);
  return all;
}

void check_apart(const Specimen& specimen, double reach) {
  Meeting nearest;
  for_each_meeting(specimen, reach,
                   [&](const Pair& pair, std::int32_t a, std::int32_t b, double at) {
                     if (!may_be_bonded(specimen, a, b)) nearest.add(pair, a, b, at);
                   });
  if (nearest.count == 0) return;
  throw InputError(fmt::format(
      "[[body]]: {} and {} stand {:.3g} (R_i + R_j) apart, within the range of the central forces, "
      "{:.3g}, which would bind the two bodies from the start; expected bodies farther apart, or "
      "bonded_to",
      element_of(specimen, nearest.pair.i, nearest.body),
      element_of(specimen, nearest.pair.j, nearest.other), nearest.distance, reach));
}

}  // namespace solidem
