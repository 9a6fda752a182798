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

#include "model/region.hpp"

namespace solidem {

/// What beams are made of, and how thick they are.
struct BeamElasticity {
  double young_modulus = 0;               ///< E, Pa
  double shear_modulus = 0;               ///< G, Pa; 0 for springs
  double radius_ratio = 0;                ///< r̃
  std::optional<double> poisson_ratio{};  ///< where it is given in place of the shear modulus
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

/// The beams of an interface that nobody says more of: half of each is of one material. Moduli in
/// series, the mean of the radii; of one material twice it is that material.
BeamElasticity in_series(const BeamElasticity& first, const BeamElasticity& second);

/// Which beams are of which material: from the elements at their ends.
class BeamMaterialTable {
 public:
  BeamMaterialTable() = default;
  /// Throws InputError when an element lies in the regions of two materials, or a region is empty.
  BeamMaterialTable(const BeamElasticity& rest, const std::vector<BeamMaterial>& materials,
                    const std::vector<BeamInterface>& interfaces, const Specimen& specimen);

  /// Of the beam between two elements.
  const BeamElasticity& between(std::int32_t i, std::int32_t j) const {
    return pairs_[number(i) * count_ + number(j)];
  }

 private:
  std::size_t number(std::int32_t element) const {
    return of_element_[static_cast<std::size_t>(element)];
  }

  std::size_t count_ = 0;
  std::vector<std::size_t> of_element_;  ///< 0: the rest
  std::vector<BeamElasticity> pairs_;    ///< count × count
};

}  // namespace solidem

#endif
