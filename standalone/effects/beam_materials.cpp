// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beam_materials.hpp"

#include <algorithm>

#include "effects/selections.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// Of two halves, one after the other.
double series(double a, double b) {
  return a == b ? a : 2 * a * b / (a + b);
}

std::size_t number_of(const std::string& name, const std::vector<BeamMaterial>& materials) {
  if (name == rest_of_beams) return 0;
  const auto found =
      std::find_if(materials.begin(), materials.end(),
                   [&](const BeamMaterial& material) { return material.name == name; });
  return static_cast<std::size_t>(found - materials.begin()) + 1;
}

}  // namespace

BeamElasticity in_series(const BeamElasticity& first, const BeamElasticity& second) {
  return {series(first.young_modulus, second.young_modulus),
          first.shear_modulus > 0 ? series(first.shear_modulus, second.shear_modulus) : 0,
          first.radius_ratio == second.radius_ratio
              ? first.radius_ratio
              : 0.5 * (first.radius_ratio + second.radius_ratio)};
}

BeamMaterialTable::BeamMaterialTable(const BeamElasticity& rest,
                                     const std::vector<BeamMaterial>& materials,
                                     const std::vector<BeamInterface>& interfaces,
                                     const Specimen& specimen)
    : count_(materials.size() + 1), of_element_(specimen.size(), 0) {
  std::vector<BeamElasticity> alone{rest};
  for (const BeamMaterial& material : materials) {
    alone.push_back(material);
    Selections unused;
    for (const std::int32_t element : select_some(
             unused, "[[beams.material]] \"" + material.name + "\"", material.region, specimen)) {
      std::size_t& number = of_element_[static_cast<std::size_t>(element)];
      if (number != 0)
        throw InputError("[[beams.material]] \"" + material.name + "\" and \"" +
                         materials[number - 1].name + "\" share elements, " +
                         place(specimen, static_cast<std::size_t>(element)) +
                         " for one; their regions must not overlap");
      number = alone.size() - 1;
    }
  }
  for (const BeamElasticity& first : alone)
    for (const BeamElasticity& second : alone) pairs_.push_back(in_series(first, second));
  for (const BeamInterface& interface : interfaces) {
    const std::size_t first = number_of(interface.first, materials),
                      second = number_of(interface.second, materials);
    pairs_[first * count_ + second] = pairs_[second * count_ + first] = interface;
  }
}

}  // namespace solidem
