// SPDX-License-Identifier: GPL-2.0-or-later
#include "specimen/bonds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/error.hpp"
#include "neighbours/linked_cells.hpp"
#include "specimen/pieces.hpp"

namespace solidem {

namespace {

// A bond is one pair with one nearest image: a period must be longer than two bonds in a row.
void insist_on_single_images(const Specimen& specimen, double tolerance) {
  const Domain& domain = specimen.domain;
  const double largest = *std::max_element(specimen.radius.begin(), specimen.radius.end());
  const double longest = (1.0 + tolerance) * 2.0 * largest * (1.0 + 1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    const double period = component(domain.upper - domain.lower, axis);
    if (!domain.periodic[axis] || period > 2.0 * longest) continue;
    throw InputError(fmt::format(
        "[specimen] periodic along {} with a period of {:.3g} m, and bonds of tolerance {} may be "
        "{:.3g} m long: an element could be bonded with two images of another; expected a period "
        "above {:.3g} m, or walls along this axis",
        "xyz"[axis], period, tolerance, longest, 2.0 * longest));
  }
}

}  // namespace

std::vector<Pair> find_bonds(const Specimen& specimen, double tolerance, BondImages images) {
  if (!(tolerance > -1.0) || !std::isfinite(tolerance))
    throw InputError(fmt::format(
        "[bonds] tolerance = {}: expected a number above -1, such as 0 (touching) or 0.05",
        tolerance));
  if (specimen.size() == 0) return {};
  if (images == BondImages::one) insist_on_single_images(specimen, tolerance);
  const Domain& domain = specimen.domain;
  std::vector<Pair> pairs =
      neighbour_pairs({domain.lower, domain.upper, domain.periodic}, specimen.position,
                      specimen.radius, tolerance, specimen.contact_margin);
  if (specimen.bodies.empty()) return pairs;
  const std::vector<std::int32_t> body = body_of_elements(specimen);
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&](const Pair& pair) {
                               return !may_be_bonded(specimen,
                                                     body[static_cast<std::size_t>(pair.i)],
                                                     body[static_cast<std::size_t>(pair.j)]);
                             }),
              pairs.end());
  return pairs;
}

bool may_be_bonded(const Specimen& specimen, std::int32_t body, std::int32_t other) {
  if (body == other) return true;
  const auto names = [&](std::int32_t one, std::int32_t another) {
    const auto& linked = specimen.bodies[static_cast<std::size_t>(one)].bonded_to;
    return std::find(linked.begin(), linked.end(), another) != linked.end();
  };
  return names(body, other) || names(other, body);
}

void make_bonds(Specimen& specimen, double tolerance, BondImages images) {
  specimen.bonds = find_bonds(specimen, tolerance, images);
  specimen.bond_tolerance = tolerance;
}

bool is_fibre(double radius_i, double radius_j, double distance, double tolerance, double margin) {
  return distance > (1.0 + tolerance) * (radius_i + radius_j) * (1.0 + margin);
}

bool is_fibre(const Specimen& specimen, Pair pair) {
  return is_fibre(specimen.radius[static_cast<std::size_t>(pair.i)],
                  specimen.radius[static_cast<std::size_t>(pair.j)],
                  norm(rest_chord(specimen, pair)), specimen.bond_tolerance,
                  specimen.contact_margin);
}

std::vector<Pair> find_fibres(const Specimen& specimen, const FibreRule& rule) {
  if (!(specimen.bond_tolerance > -1.0))
    throw InputError(
        "[beams.fibres] join elements beyond the tolerance of the bonds, and the specimen does not "
        "say which tolerance made its bonds: expected [bonds] tolerance in the scene");
  if (!(rule.reach > 1.0 + specimen.bond_tolerance) || !std::isfinite(rule.reach))
    throw InputError(
        fmt::format("[beams.fibres] reach = {}: bonds of tolerance {} reach as far; expected a "
                    "reach above {}, such as 2",
                    rule.reach, specimen.bond_tolerance, 1.0 + specimen.bond_tolerance));
  std::vector<Pair> pairs = find_bonds(specimen, rule.reach - 1.0);
  const auto is_none = [&](const Pair& pair) {
    const Vector chord = rest_chord(specimen, pair);
    return !is_fibre(specimen, pair) ||
           !(std::abs(dot(chord, rule.direction)) > rule.alignment * norm(chord));
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), is_none), pairs.end());
  return pairs;
}

void add_fibres(Specimen& specimen, const FibreRule& rule) {
  const std::vector<Pair> fibres = find_fibres(specimen, rule);
  std::vector<Pair> all;
  std::set_union(specimen.bonds.begin(), specimen.bonds.end(), fibres.begin(), fibres.end(),
                 std::back_inserter(all));
  specimen.bonds = std::move(all);
}

std::vector<Pair> bonds_in_contact(const Specimen& specimen) {
  std::vector<Pair> bonds;
  std::copy_if(specimen.bonds.begin(), specimen.bonds.end(), std::back_inserter(bonds),
               [&](const Pair& pair) { return !is_fibre(specimen, pair); });
  return bonds;
}

std::vector<std::int32_t> count_bonds(const Specimen& specimen) {
  std::vector<std::int32_t> count(specimen.size(), 0);
  for (const Pair& pair : specimen.bonds) {
    ++count[pair.i];
    ++count[pair.j];
  }
  return count;
}

std::vector<std::int32_t> largest_component(const Specimen& specimen) {
  const std::vector<std::int32_t> lowest = lowest_of_piece(specimen.size(), specimen.bonds);
  std::vector<std::int32_t> members(specimen.size(), 0);
  for (const std::int32_t element : lowest) ++members[static_cast<std::size_t>(element)];
  std::vector<std::int32_t> elements;
  if (members.empty()) return elements;
  const auto largest =
      static_cast<std::int32_t>(std::max_element(members.begin(), members.end()) - members.begin());
  for (std::size_t i = 0; i < members.size(); ++i)
    if (lowest[i] == largest) elements.push_back(static_cast<std::int32_t>(i));
  return elements;
}

}  // namespace solidem
