// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SPECIMEN_BONDS_HPP
#define SOLIDEM_SPECIMEN_BONDS_HPP

#include <cstdint>
#include <vector>

#include "model/specimen.hpp"

namespace solidem {

/// Whether two images of an element may be neighbours of another. A bond is one pair: it joins the
/// nearest.
enum class BondImages { one, several };

/// The pairs with d_ij ≤ (1 + tolerance)(R_i + R_j), the nearest image in periodic directions;
/// sorted, i < j; within a body, and between two that are bonded. Touching spheres count at
/// tolerance 0: distances are compared with the specimen's `contact_margin`. Throws InputError when
/// the tolerance is not a number above −1, or when a periodic cell is so small that two images of
/// one element would both be neighbours of another and only one may be.
std::vector<Pair> find_bonds(const Specimen& specimen, double tolerance,
                             BondImages images = BondImages::one);

/// Whether elements of two bodies, by number, may be bonded: of one, or of two that the specimen
/// says are.
bool may_be_bonded(const Specimen& specimen, std::int32_t body, std::int32_t other);

/// Replaces the specimen's bonds by those of a tolerance, and notes the tolerance.
void make_bonds(Specimen& specimen, double tolerance, BondImages images = BondImages::one);

/// Pairs beyond contact that fibres join.
struct FibreRule {
  Vector direction{1, 0, 0};  ///< of the fibres, unit
  double reach = 2;           ///< d ≤ reach (R_i + R_j), above 1 + tolerance of the bonds
  double alignment = 0.94;    ///< |cos| of the angle to the direction is above this, 0 to 1
};

/// Whether two elements at a distance are farther apart than the tolerance of the bonds allows: if
/// they are bonded, then by a fibre. Radii and distance in m; `margin` as in the specimen.
bool is_fibre(double radius_i, double radius_j, double distance, double tolerance, double margin);
bool is_fibre(const Specimen& specimen, Pair pair);

/// The pairs that fibres join: beyond the bonds' tolerance, within reach, aligned. Sorted, i < j.
/// Throws InputError when the tolerance of the bonds is not known, when the reach lies within it,
/// or when a periodic cell is too small for the reach.
std::vector<Pair> find_fibres(const Specimen& specimen, const FibreRule& rule);

/// Adds fibres to the specimen's bonds; those it has already are not doubled.
void add_fibres(Specimen& specimen, const FibreRule& rule);

/// The specimen's bonds that are no fibres.
std::vector<Pair> bonds_in_contact(const Specimen& specimen);

/// Number of bonds of each element.
std::vector<std::int32_t> count_bonds(const Specimen& specimen);

/// The elements of the largest body that bonds hold together, ascending. Elements outside it have
/// no stiffness and must be left out of the mechanics. Of several equally large the one with the
/// lowest element; empty for an empty specimen.
std::vector<std::int32_t> largest_component(const Specimen& specimen);

}  // namespace solidem

#endif
