// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CENTRAL_NEIGHBOURS_HPP
#define SOLIDEM_EFFECTS_CENTRAL_NEIGHBOURS_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "effects/central_force_parameters.hpp"
#include "model/archive.hpp"
#include "model/model.hpp"
#include "neighbours/neighbourhood.hpp"

namespace solidem {

/// Who may act on whom under central forces, and at which distance they rest: fills the slots of
/// the model. Where neighbours change, they are those of a Verlet list whose skin is each element's
/// own, the wider the faster it is: a few fast fragments do not make the lists of all others long,
/// or short-lived. A pair is listed within the range and the margins of both, and neighbours are
/// sought anew when an element has moved by more than its margin.
class CentralNeighbours {
 public:
  /// Finds the neighbours at the specimen's positions and fills the slots. Throws InputError when
  /// two elements stand at one place.
  CentralNeighbours(const CentralForceParameters& parameters, Model& model);

  /// Those of the start.
  const Neighbourhood& initial() const { return initial_; }
  /// Distance at which an entry of theirs rests, m.
  double rest_length(std::size_t entry) const { return initial_rest_length_[entry]; }
  std::size_t initial_entries() const { return initial_rest_length_.size(); }
  /// From element i to the neighbour of an entry, as they stood then; both sides of a pair tell
  /// the same bits, with opposite signs.
  Vector initial_chord(std::size_t i, std::size_t entry) const;
  /// The pairs that were neighbours at the start.
  std::vector<Pair> initial_pairs() const;

  /// Finds neighbours anew if elements have moved far enough. `outdated`: one that moves freely
  /// has.
  void keep(bool outdated);
  /// A step has been made with the list, s.
  void count_step(double time_step) {
    ++steps_since_;
    time_step_ = time_step;
  }

  /// Takes an element out: it has no neighbours any more.
  void exclude(std::int32_t element);
  bool is_absent(std::size_t element) const { return !absent_.empty() && absent_[element] != 0; }

  /// How often neighbours were listed.
  std::size_t searches() const { return searches_; }

  void state(Archive& archive);

 private:
  void list_initial();
  /// Lists those near each other now, where columns::listed_position says.
  Neighbourhood list_now() const;
  /// Lays out the slots for the elements as they were listed.
  void fill_slots();
  /// Distances at rest of the entries of a list, m.
  std::vector<double> rest_lengths(const Neighbourhood& list) const;
  void search();
  /// Chooses the margins that make steps and searches together cheapest.
  void choose_margins();
  /// How far each element goes in a step, m.
  std::vector<double> ways_in_a_step() const;
  /// Margins with which lists should last for so many steps, where speeds stay; their mean volume
  /// over that of the range. `ways`: as above.
  double set_margins(double steps, const std::vector<double>& ways, double* margin) const;

  const CentralForceParameters& parameters_;
  Model& model_;
  Neighbourhood initial_;
  std::vector<double> initial_rest_length_;  ///< m
  std::vector<char> absent_;                 ///< elements taken out; empty: none
  std::size_t searches_ = 0;
  std::int64_t steps_since_ = 0;  ///< the last search
  double time_step_ = 0;          ///< of them, s
  double expected_steps_ = 0;     ///< that the list should last
  double caution_ = 1;            ///< by which margins exceed what speeds ask for
};

}  // namespace solidem

#endif
