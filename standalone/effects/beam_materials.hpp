// SPDX-License-Identifier: GPL-2.0-or-later
//
// Beams of several materials: those between elements of a region, and those between elements of
// two.
#ifndef SOLIDEM_EFFECTS_BEAM_MATERIALS_HPP
#define SOLIDEM_EFFECTS_BEAM_MATERIALS_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "laws/limit_scale.hpp"
#include "laws/yield_laws.hpp"
#include "model/region.hpp"

namespace solidem {

/// Where beams of a material flow and break, as far as it is not where [plasticity] and [rupture]
/// say, or for an interface as the weaker of its sides.
struct BeamLimits {
  std::optional<double> yield_strain;          ///< ε_y where nothing has flowed
  std::optional<double> plastic_strain_ratio;  ///< plastic strains over those of the yield law
  std::optional<double> rupture_ratio;         ///< strains of rupture over those of its law
};

/// What beams are made of, and how thick they are.
struct BeamElasticity {
  double young_modulus = 0;               ///< E, Pa
  double shear_modulus = 0;               ///< G, Pa; 0 for springs
  double radius_ratio = 0;                ///< r̃
  std::optional<double> poisson_ratio{};  ///< where it is given in place of the shear modulus
  BeamLimits limits{};                    ///< as they are stated
};

/// Beams between elements of a region.
struct BeamMaterial : BeamElasticity {
  std::string name;
  Region region;
};

/// Beams between elements of two materials.
struct BeamInterface : BeamElasticity {
  std::string first, second;  ///< names of materials; "rest": of elements in no region
};

/// The material that beams have where no region is named.
inline constexpr const char* rest_of_beams = "rest";

/// Beams of two materials, or of one: what they are made of and where they flow and break.
struct BeamPairing {
  BeamElasticity elasticity;
  LimitScale<double> limits;
};

/// The beams of an interface that nobody says more of: half of each is of one material. Moduli in
/// series, the mean of the radii, the limits of the half that bears less stress; of one material
/// twice it is that material.
BeamPairing in_series(const BeamPairing& first, const BeamPairing& second);

/// Of the beams between each two materials, `count` × `count`; the first is the rest. `yield`: the
/// law that all share; null: none.
std::vector<BeamPairing> pairings(const BeamElasticity& rest,
                                  const std::vector<BeamMaterial>& materials,
                                  const std::vector<BeamInterface>& interfaces,
                                  const YieldLaw* yield);

/// Whether all of them flow and break where the laws say.
bool limits_are_alike(const std::vector<BeamPairing>& pairings);

/// Which beams are of which material: from the elements at their ends.
class BeamMaterialTable {
 public:
  BeamMaterialTable() = default;
  /// Throws InputError when an element lies in the regions of two materials, or a region is empty.
  BeamMaterialTable(const std::vector<BeamMaterial>& materials, std::vector<BeamPairing> pairings,
                    const Specimen& specimen);

  /// Of the beam between two elements.
  const BeamPairing& between(std::int32_t i, std::int32_t j) const {
    return pairs_[number(i) * count_ + number(j)];
  }

 private:
  std::size_t number(std::int32_t element) const {
    return of_element_[static_cast<std::size_t>(element)];
  }

  std::size_t count_ = 0;
  std::vector<std::size_t> of_element_;  ///< 0: the rest
  std::vector<BeamPairing> pairs_;       ///< count × count
};

}  // namespace solidem

#endif
