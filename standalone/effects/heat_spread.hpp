// SPDX-License-Identifier: GPL-2.0-or-later
//
// How what heats a part of a body is shared among its elements, while it moves.
#ifndef SOLIDEM_EFFECTS_HEAT_SPREAD_HPP
#define SOLIDEM_EFFECTS_HEAT_SPREAD_HPP

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "effects/heat_load.hpp"
#include "model/time_function.hpp"
#include "specimen/tessellation.hpp"

namespace solidem {

using Path = std::array<TimeFunction, 3>;

/// What heats: how much of a solid it holds when its origin is at a position.
struct HeatedPart {
  std::pair<Vector, Vector> bounds;  ///< of a box around it, about its origin, m
  double extent;                     ///< the least of its lengths, m
  std::function<double(const Polyhedron& solid, const Vector& position)> amount;
};

/// The amounts of a part on its path that elements take. What no heat could leave again takes
/// none: it would only grow hotter and hotter.
///
/// Amounts are exact when the part has moved by another sixteenth of its least extent, or of an
/// element's radius if that is less, and linear in time between: 4e-3 of an element at the worst.
/// In a periodic body the part has images as the body has.
class HeatSpread {
 public:
  /// The box that a part on its path stays in, m; endless along periodic axes.
  static std::pair<Vector, Vector> swept(const HeatedPart& part, const Path& path,
                                         const Domain& domain);

  /// `solids`: of the elements that it may meet. `share`: by which each element's amount is
  /// multiplied; 0: it takes none.
  HeatSpread(std::vector<CellSolid> solids, HeatedPart part, Path path, std::vector<double> share,
             const Specimen& specimen);

  /// Appends the amount of each element at a time. Returns their sum for all elements that it
  /// meets, also those that take none, before shares. Where all are such, the nearest that takes
  /// any takes that sum.
  double at(double time, std::vector<ElementValue>& amounts) const;

  /// Whether it stays where it is.
  bool rests() const { return !(spacing_ < std::numeric_limits<double>::infinity()); }

 private:
  struct Look {
    double knot = std::numeric_limits<double>::quiet_NaN();
    std::vector<ElementValue> amounts;  ///< by rising element
  };
  struct Solid {
    CellSolid cell;
    Vector lower, upper;
  };

  Vector position(double time) const;
  /// The amounts at a whole number of spacings; the last of even and of odd numbers are kept.
  const std::vector<ElementValue>& look(double knot) const;
  std::vector<ElementValue> exact(const Vector& position) const;
  /// Where the part stands with its images, m.
  std::vector<Vector> images(const Vector& position) const;
  void add_images(int axis, std::vector<Vector>& places) const;
  std::int32_t nearest_taker(const Vector& position) const;

  std::vector<Solid> solids_;
  HeatedPart part_;
  Path path_;
  std::vector<double> share_;
  const Vector* centre_;  ///< of the specimen, which outlives every effect
  Domain domain_;
  double spacing_;  ///< s
  mutable std::array<Look, 2> looks_;
};

}  // namespace solidem

#endif
