// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "laws/constants.hpp"
#include "model/error.hpp"
#include "model/outline.hpp"
#include "neighbours/linked_cells.hpp"
#include "specimen/long_bonds.hpp"
#include "specimen/specimen_file.hpp"

namespace solidem {

namespace {

void check_domain(const Domain& domain, const std::string& origin) {
  static const char* const shapes[] = {"box",    "plate", "cylinder", "annulus", "wedge",
                                       "sphere", "mesh",  "crystal",  "bodies",  "imported"};
  if (std::find(std::begin(shapes), std::end(shapes), domain.shape) == std::end(shapes))
    throw InputError(fmt::format(
        "{}: domain shape \"{}\": expected box, plate, cylinder, annulus, wedge, sphere, mesh, "
        "crystal, bodies or imported",
        origin, domain.shape));
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(domain.lower, axis), high = component(domain.upper, axis);
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high))
      throw InputError(fmt::format("{}: domain from {} to {} m along {}: expected lower < upper",
                                   origin, low, high, "xyz"[axis]));
  }
  const bool is_unknown = domain.volume == 0 && domain.shape == "imported";
  if (!is_unknown && (!(domain.volume > 0) || !std::isfinite(domain.volume)))
    throw InputError(fmt::format("{}: domain volume {} m3: expected a number above zero", origin,
                                 domain.volume));
  if (domain.shape == "sphere" && !(domain.radius > 0 && domain.axis < 0))
    throw InputError(
        fmt::format("{}: sphere with axis {} and radius {} m: expected axis -1 and a "
                    "radius above zero",
                    origin, domain.axis, domain.radius));
  const bool wedge = domain.shape == "wedge", hollow = wedge || domain.shape == "annulus";
  if ((hollow || domain.shape == "cylinder") &&
      (domain.axis < 0 || domain.axis > 2 || !(domain.radius > 0)))
    throw InputError(fmt::format(
        "{}: {} with axis {} and radius {} m: expected axis 0, 1 or 2 and a radius above zero",
        origin, domain.shape, domain.axis, domain.radius));
  if (hollow && !(domain.inner_radius > 0 && domain.inner_radius < domain.radius))
    throw InputError(
        fmt::format("{}: {} with inner radius {} m and radius {} m: expected 0 < inner < outer",
                    origin, domain.shape, domain.inner_radius, domain.radius));
  if (wedge && !(domain.angle > 0 && domain.angle < pi))
    throw InputError(
        fmt::format("{}: wedge with angle {} rad: expected 0 < angle < pi", origin, domain.angle));
}

std::string place_of(const Specimen& specimen, std::size_t element) {
  const Vector& p = specimen.position[element];
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x, p.y, p.z);
}

// Centres may stand outside of the body, in a periodic one by a period, but not where a slip of
// the pen or of the disk has put them.
void check_places(const Specimen& specimen, const std::string& origin) {
  const Domain& domain = specimen.domain;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = component(domain.lower, axis), high = component(domain.upper, axis);
    for (std::size_t i = 0; i < specimen.size(); ++i) {
      const double p = component(specimen.position[i], axis);
      if (p < low - (high - low) || p > high + (high - low))
        throw InputError(fmt::format(
            "{}: element {} stands at {}, far outside of its body, which goes from {:.6g} to "
            "{:.6g} m along {}",
            origin, i, place_of(specimen, i), low, high, "xyz"[axis]));
    }
  }
  // Nearer than a thousandth of the sum of their radii.
  const std::vector<Pair> pairs = neighbour_pairs({domain.lower, domain.upper, domain.periodic},
                                                  specimen.position, specimen.radius, -0.999, 0);
  if (!pairs.empty())
    throw InputError(fmt::format(
        "{}: elements {} and {} are in one place, {}{}: expected each element once", origin,
        pairs[0].i, pairs[0].j, place_of(specimen, static_cast<std::size_t>(pairs[0].i)),
        pairs.size() > 1 ? fmt::format(", and so are {} pairs more", pairs.size() - 1) : ""));
}

// Every element is in one body, which has a volume.
void check_bodies(const Specimen& specimen, const std::string& origin) {
  if (specimen.bodies.empty()) return;
  std::vector<int> holders(specimen.size(), 0);
  const auto number = static_cast<std::int32_t>(specimen.bodies.size());
  for (const Body& body : specimen.bodies) {
    if (!(body.volume > 0) || !std::isfinite(body.volume))
      throw InputError(fmt::format("{}: body \"{}\" of {} m3: expected a volume above zero", origin,
                                   body.name, body.volume));
    for (const std::int32_t element : body.elements) {
      if (element < 0 || static_cast<std::size_t>(element) >= specimen.size())
        throw InputError(fmt::format("{}: body \"{}\" holds element {}: expected 0 <= element < {}",
                                     origin, body.name, element, specimen.size()));
      ++holders[static_cast<std::size_t>(element)];
    }
    for (const std::int32_t other : body.bonded_to)
      if (other < 0 || other >= number)
        throw InputError(fmt::format("{}: body \"{}\" is bonded to body {}: expected 0 to {}",
                                     origin, body.name, other, number - 1));
  }
  for (std::size_t i = 0; i < holders.size(); ++i)
    if (holders[i] != 1)
      throw InputError(
          fmt::format("{}: element {} is in {} bodies: expected one", origin, i, holders[i]));
  if (specimen.outline == nullptr) return;
  if (specimen.outline->bodies.size() != specimen.bodies.size())
    throw InputError(fmt::format("{}: {} bodies, but outlines of {}: expected one of each", origin,
                                 number, specimen.outline->bodies.size()));
  for (const PlacedOutline& body : specimen.outline->bodies) check_domain(body.domain, origin);
}

}  // namespace

void check_specimen(const Specimen& specimen, const std::string& origin) {
  const std::size_t n = specimen.size();
  if (n == 0) throw InputError(origin + ": the specimen has no elements");
  if (specimen.radius.size() != n)
    throw InputError(
        fmt::format("{}: {} positions but {} radii", origin, n, specimen.radius.size()));
  for (std::size_t i = 0; i < n; ++i) {
    const Vector& p = specimen.position[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(fmt::format("{}: element {} has position ({}, {}, {}) m: expected numbers",
                                   origin, i, p.x, p.y, p.z));
    const double radius = specimen.radius[i];
    if (!(radius > 0) || !std::isfinite(radius))
      throw InputError(fmt::format("{}: element {} has radius {} m: expected a number above zero",
                                   origin, i, radius));
  }
  check_domain(specimen.domain, origin);
  if (!(specimen.contact_margin >= 0 && specimen.contact_margin < 0.1))
    throw InputError(fmt::format("{}: contact margin {}: expected a number from 0 to 0.1", origin,
                                 specimen.contact_margin));
  check_places(specimen, origin);
  for (std::size_t b = 0; b < specimen.bonds.size(); ++b) {
    const Pair& pair = specimen.bonds[b];
    if (pair.i < 0 || pair.j <= pair.i || static_cast<std::size_t>(pair.j) >= n)
      throw InputError(fmt::format("{}: bond {} joins elements {} and {}: expected 0 <= i < j < {}",
                                   origin, b, pair.i, pair.j, n));
    if (const double ratio = relative_length(specimen, pair);
        specimen.bond_tolerance <= -1 && !(ratio <= longest_bond))
      throw InputError(fmt::format(
          "{}: the bond of elements {} and {} is {:.3g} times as long as the sum of their radii: "
          "expected neighbours, at most {} times, or the tolerance that made the bonds",
          origin, pair.i, pair.j, ratio, longest_bond));
    if (b > 0 && specimen.bonds[b - 1] == pair)
      throw InputError(
          fmt::format("{}: the bond of elements {} and {} is there twice", origin, pair.i, pair.j));
    if (b > 0 && pair < specimen.bonds[b - 1])
      throw InputError(
          fmt::format("{}: bond {} ({}, {}) comes after ({}, {}): expected rising order", origin, b,
                      pair.i, pair.j, specimen.bonds[b - 1].i, specimen.bonds[b - 1].j));
  }
  check_bodies(specimen, origin);
  for (const auto& [name, elements] : specimen.sets)
    for (const std::int32_t element : elements)
      if (element < 0 || static_cast<std::size_t>(element) >= n)
        throw InputError(fmt::format("{}: set \"{}\" holds element {}: expected 0 <= element < {}",
                                     origin, name, element, n));
}

}  // namespace solidem
