// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CENTRAL_FORCES_HPP
#define SOLIDEM_EFFECTS_CENTRAL_FORCES_HPP

#include <functional>
#include <vector>

#include "effects/central_force_parameters.hpp"
#include "effects/central_neighbours.hpp"
#include "effects/kernels/kernels.hpp"
#include "effects/mechanics.hpp"

namespace solidem {

/// Elements in motion under central forces: a law of laws/central_laws.hpp within the range of
/// laws/central_interaction.hpp; velocity Verlet. Elements have no orientation.
///
/// Pairs that were neighbours at the start keep the distance they had then as that of equilibrium,
/// also when they part and meet again; all others have the sum of their radii. Neighbours are
/// sought anew when an element has moved half the skin since the last time. As neighbours stand in
/// the order of their numbers and those beyond the range add nothing, results do not depend on when
/// that is.
class CentralForces : public Mechanics {
 public:
  /// Columns that the effect needs; `cracks`: its elements may stand on crack faces.
  static std::vector<const Column*> columns(const CentralForceParameters& parameters, bool cracks,
                                            bool periodic);

  /// Elements are at rest at the specimen's positions. `mass` per element, kg. `cracks` as above.
  /// Throws InputError when two elements stand at one place.
  CentralForces(const CentralForceParameters& parameters, const std::vector<double>& mass,
                Model& model);

  void advance(Model& model, const Step& step) override;
  void observe(const Model& model, Observation& observation) const override;
  void state(Archive& archive) override;
  void show(const Model& model, Frame& frame) const override;
  void summarise(const Model& model, Summary& summary) const override;

  std::vector<TimeStepCriterion> time_step_criteria(const Model& model) const override;
  double longest_time_step(double squared_frequency) const override;
  void accelerate(Model& model) const override;
  /// So small that no pair comes into range by it, where forces jump.
  double trial_displacement() const override { return 1e-9; }
  double mean_stiffness(const Model& /*model*/) const override { return mean_stiffness_; }
  double typical_energy(const Model& /*model*/) const override { return depth_; }
  bool releases_energy() const override { return true; }
  bool lets_elements_meet() const override { return true; }
  void for_each_pair(const Model& model, const PairVisit& visit) const override;
  void finish_move(Model& model) override;

  /// Finds neighbours anew if elements have moved far enough.
  void keep_neighbours();

  /// Tells for every element whether it stands on a crack face. `threshold`: C. Free faces
  /// are left out where columns::neighbours_at_start is there.
  void find_crack_faces(double threshold);

  /// Number of elements within range of each, at the present poses.
  std::vector<int> neighbours_within_range() const;

  /// Takes an element out: it has no neighbours any more.
  void exclude(std::int32_t element) { neighbours_.exclude(element); }

  /// The pairs that were neighbours at the start.
  std::vector<Pair> initial_pairs() const { return neighbours_.initial_pairs(); }

  /// Deepest overlap that was met, as a fraction of the equilibrium distance; below 0: none.
  double largest_interpenetration() const;
  double allowed_interpenetration() const { return parameters_.interpenetration; }
  /// Whether pairs came nearer than the law is followed, and it is stiffer there.
  bool has_exceeded() const {
    return stiffens_ && largest_interpenetration() > parameters_.interpenetration;
  }
  /// How often neighbours were sought.
  std::size_t searches() const { return neighbours_.searches(); }

 private:
  /// What elements have in common with their own images. It stays as it is, and the forces cancel:
  /// no slot is needed.
  struct OwnImages {
    double pairs = 0, potential = 0;
  };
  void count_own_images();
  /// Calls visit(i, chord, equilibrium distance) for each pair of an element and an image of it
  /// within the range.
  using OwnImageVisit = std::function<void(std::size_t, const Vector&, double)>;
  void for_each_own_image(const OwnImageVisit& visit) const;
  CentralMotion motion(Model& model) const;

  CentralForceParameters parameters_;
  Model& model_;
  CentralNeighbours neighbours_;
  std::vector<OwnImages> own_images_;  ///< of each element; empty where nothing is periodic
  double depth_ = 0;                   ///< of the deepest well at the start, J
  double stiffening_ = 1;              ///< stiffness at the deepest overlap over that at the start
  bool stiffens_ = false;              ///< whether the law is stiffer there than at rest
  double mean_stiffness_ = 0;          ///< at the equilibrium, of the pairs of the start, N/m
  double smallest_stiffness_ = 0;      ///< at the equilibrium, N/m
  double compression_ratio_ = 0;       ///< the largest δ_eq/δ met
  bool list_outdated_ = false;         ///< by the last step
};

}  // namespace solidem

#endif
