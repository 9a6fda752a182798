// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CHANGING_CONDUCTORS_HPP
#define SOLIDEM_EFFECTS_CHANGING_CONDUCTORS_HPP

#include <map>
#include <set>
#include <vector>

#include "effects/conduction_geometry.hpp"
#include "effects/conduction_parameters.hpp"
#include "model/archive.hpp"
#include "model/model.hpp"

namespace solidem {

/// Which pairs conduct heat, and along which path, while bonds break and are made.
///
/// A pair whose bond broke keeps its place among the conductors and conducts nothing, or goes on,
/// as the scene chooses. A bond made anew conducts along the path that its pair had at the start.
/// A pair that had none gets the geometric mean of what its two elements offer to any neighbour,
/// over the distance at which the bond was made: under the platonic laws the transmission areas
/// S_i, under the Voronoi law the mean area of the faces through which an element was bonded at the
/// start. So the table of conductors follows from the pairs of the start and those made since
/// alone, whatever the order in which bonds broke and formed.
class ChangingConductors {
 public:
  /// Of a model that has just been made: its conductors and bonds are those of the start.
  ChangingConductors(ConductionParameters::BrokenBonds broken_bonds, ConductionGeometry geometry,
                     const Model& model);

  /// What the bonds' changes since the last time mean for conduction.
  struct Change {
    bool new_pairs = false;      ///< pairs() has grown
    std::vector<Pair> switched;  ///< pairs that may have another path now
    bool is_nothing() const { return !new_pairs && switched.empty(); }
  };
  Change follow(const Model& model);

  /// All pairs that conduct or may again, sorted.
  std::vector<Pair> pairs() const;
  /// Of one of them; an area of 0 where it insulates.
  HeatPath path(const Specimen& specimen, Pair pair) const;
  /// Pairs bonded since the start that did not conduct then, and the distance at which they were,
  /// m.
  const std::map<Pair, double>& made_anew() const { return anew_; }

  void state(Archive& archive, const Model& model);

 private:
  bool is_initial(Pair pair) const;
  /// A bond that was made, and one that broke; whether that gives the pair another path.
  bool join(Pair pair, double distance);
  bool part(Pair pair);

  ConductionParameters::BrokenBonds broken_bonds_;
  ConductionGeometry geometry_;
  std::vector<Pair> initial_;      ///< sorted
  std::vector<double> area_anew_;  ///< that an element offers to a neighbour it had not, m²
  std::map<Pair, double> anew_;    ///< see made_anew()
  std::set<Pair> insulating_;      ///< whose bond is broken
  std::size_t seen_ = 0;           ///< changes of bonds followed so far
};

}  // namespace solidem

#endif
