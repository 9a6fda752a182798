// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_CRACKED_BONDS_HPP
#define SOLIDEM_EFFECTS_CRACKED_BONDS_HPP

#include <vector>

#include "effects/central_force_parameters.hpp"
#include "effects/rupture.hpp"
#include "neighbours/neighbourhood.hpp"

namespace solidem {

/// Micro-cracks among bonded elements (laws/crack_face.hpp; Terreros 2013, annex E.2): a bond in
/// tension between elements on opposite faces of a crack breaks, as by [rupture]; and elements that
/// have lost their hold are taken out.
///
/// Neighbours are all elements within range, bonded or not. They are listed with a skin and sought
/// anew when one has moved half of it; results do not depend on when.
class CrackedBonds : public Effect {
 public:
  CrackedBonds(const DamageParameters& parameters, const Beams& beams, Rupture& rupture,
               Model& model);

  /// After the bonds that broke by themselves, in the poses that the step began with.
  void advance(Model& model, const Step& step) override;
  /// Numbers of elements on crack faces and of those that were taken out.
  void observe(const Model& model, Observation& observation) const override;
  void show(const Model& model, Frame& frame) const override;
  void state(Archive& archive) override;

 private:
  /// Where the neighbours of an element stand.
  struct Surroundings {
    Vector sum{};  ///< of the chords to them, m
    int count = 0;
  };
  void keep_neighbours();
  Surroundings surroundings(std::size_t element) const;
  void look_around();
  std::vector<Pair> torn_bonds() const;
  std::vector<std::int32_t> isolated() const;

  DamageParameters parameters_;
  const Beams& beams_;
  Rupture& rupture_;
  Model& model_;
  double range_, skin_;               ///< α; m
  Neighbourhood listed_;              ///< within range and skin
  std::vector<Vector> listed_at_;     ///< where elements stood then
  std::vector<Surroundings> around_;  ///< of each element at the last look
  std::vector<int> had_;              ///< neighbours of each at the start
  std::vector<Vector> barycentre_;    ///< what each shows of the cracks about it
  std::int64_t steps_ = 0;
};

}  // namespace solidem

#endif
