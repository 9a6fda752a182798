// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_DAMAGE_HPP
#define SOLIDEM_EFFECTS_DAMAGE_HPP

#include <vector>

#include "effects/central_force_parameters.hpp"
#include "effects/central_forces.hpp"

namespace solidem {

/// Micro-cracks among elements under central forces: laws/crack_face.hpp. Looks at the places that
/// a step begins with before anyone observes them, so that rows have the forces of that step; and
/// takes out elements that have lost their hold.
///
/// An element that is removed stays where it is, at rest. The energy that cracks take is what the
/// balance of energy lacks.
class Damage : public Effect {
 public:
  Damage(const DamageParameters& parameters, CentralForces& forces, Model& model);

  /// Once after each step, when all elements are in their new places.
  void advance(Model& model, const Step& step) override;
  /// Numbers of crack faces and of removed elements.
  void observe(const Model& model, Observation& observation) const override;
  void show(const Model& model, Frame& frame) const override;
  void summarise(const Model& model, Summary& summary) const override;
  void state(Archive& archive) override;

  bool tells_crack_faces() const { return parameters_.crack_threshold.has_value(); }
  bool removes() const { return parameters_.minimal_neighbours > 0; }
  bool is_removed(std::int32_t element) const;
  std::size_t removed() const { return removed_.size(); }

 private:
  void find_crack_faces();
  void remove_isolated();

  DamageParameters parameters_;
  CentralForces& forces_;
  Model& model_;
  std::vector<int> had_;               ///< neighbours of each element at the start
  std::vector<std::int32_t> removed_;  ///< sorted
  std::int64_t steps_ = 0;
};

}  // namespace solidem

#endif
