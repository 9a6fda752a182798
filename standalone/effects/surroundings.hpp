// SPDX-License-Identifier: GPL-2.0-or-later
//
// How much of each element lies open at the surface of a body that is known by its elements alone.
//
// All elements are blown up by one factor, which closes the pores of a packing. What of an
// element's sphere lies in no other is open: the directions u from its centre that lead there fill
// a solid angle Ω.
//
//   a = ρ² ∫ u dΩ          the vector area of the open part, ρ the blown-up radius. Over any piece
//                          of surface these sum to the vector area of that piece, whatever its
//                          bumps (Gauss).
//   w = R² Ω               adds up around edges and corners, where two faces of one element are
//                          open, but is larger where a surface is rough
//
// So the area of an element is c w, c such that what is flat of the surface has the area that its
// vector areas sum to. Of what a crack lays open, only a is taken, along the normal there.
#ifndef SOLIDEM_EFFECTS_SURROUNDINGS_HPP
#define SOLIDEM_EFFECTS_SURROUNDINGS_HPP

#include <vector>

#include "model/specimen.hpp"
#include "neighbours/neighbourhood.hpp"

namespace solidem {

/// What of an element lies open.
struct Openness {
  double share = 0;  ///< Ω over that of a sphere
  Vector mean{};     ///< ∫ u dΩ over that of a sphere
};

/// What stands around each element of a body at rest and may hide it.
class Surroundings {
 public:
  explicit Surroundings(const Specimen& specimen);

  /// By which elements are blown up. Holes between spheres that touch are 1.73 radii from their
  /// centres in a simple cubic lattice, less in what is denser.
  static constexpr double blow_up = 1.75;

  /// Who may hide an element: all whose blown-up spheres meet its own.
  const Neighbourhood& near() const { return near_; }

  /// Calls visit(other, entry) for all that are near an element; entry: its place in near().
  template <class Visit>
  void for_each_near(std::size_t element, const Visit& visit) const {
    for (std::size_t k = near_.first[element]; k < near_.first[element + 1]; ++k)
      visit(static_cast<std::size_t>(near_.neighbour[k]), k);
  }

  /// Of an element, and of all. `apart`: which entries of near() hide nothing any more; empty:
  /// none.
  Openness openness(std::size_t element, const std::vector<char>& apart) const;
  std::vector<Openness> openness() const;

  /// a of an element that is open so far, m².
  Vector vector_area(std::size_t element, const Openness& open) const;

  /// The sum of the vector areas `area` of an element and of those near it that are not apart and
  /// look to its side, m²: along the normal of the surface there.
  Vector around(std::size_t element, const std::vector<Vector>& area,
                const std::vector<char>& apart) const;

  /// The area, m², of each element that is so far open.
  std::vector<double> areas(const std::vector<Openness>& open) const;

 private:
  const Specimen& specimen_;
  std::vector<Vector> spread_;
  Neighbourhood near_;
};

}  // namespace solidem

#endif
