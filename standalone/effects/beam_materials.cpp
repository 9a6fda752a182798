// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/beam_materials.hpp"

#include <algorithm>
#include <utility>
#include <variant>

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

/// The limits of the half that bears less stress, as strains of a beam with a modulus of its own.
double weaker(double first, double second, double first_modulus, double second_modulus,
              double modulus) {
  if (first == second && first_modulus == second_modulus && first_modulus == modulus) return first;
  return std::min(first * first_modulus, second * second_modulus) / modulus;
}

LimitScale<double> weaker(const BeamPairing& first, const BeamPairing& second, double modulus) {
  const double E1 = first.elasticity.young_modulus, E2 = second.elasticity.young_modulus;
  const LimitScale<double>&a = first.limits, &b = second.limits;
  return {true, weaker(a.yield, b.yield, E1, E2, modulus),
          a.yield * E1 <= b.yield * E2 ? a.plastic : b.plastic,
          weaker(a.rupture, b.rupture, E1, E2, modulus)};
}

/// Those that are stated in place of others.
LimitScale<double> stated(const BeamLimits& limits, LimitScale<double> otherwise,
                          const YieldLaw* yield) {
  if (limits.yield_strain && yield != nullptr)
    otherwise.yield =
        *limits.yield_strain /
        std::visit([](const auto& law) { return law.limit(0.0, YieldState<double>{}); }, *yield);
  otherwise.plastic = limits.plastic_strain_ratio.value_or(otherwise.plastic);
  otherwise.rupture = limits.rupture_ratio.value_or(otherwise.rupture);
  return otherwise;
}

bool is_one(const LimitScale<double>& scale) {
  return scale.yield == 1 && scale.plastic == 1 && scale.rupture == 1;
}

}  // namespace

BeamPairing in_series(const BeamPairing& one, const BeamPairing& other) {
  const BeamElasticity &first = one.elasticity, &second = other.elasticity;
  const BeamElasticity made{
      series(first.young_modulus, second.young_modulus),
      first.shear_modulus > 0 ? series(first.shear_modulus, second.shear_modulus) : 0,
      first.radius_ratio == second.radius_ratio ? first.radius_ratio
                                                : 0.5 * (first.radius_ratio + second.radius_ratio)};
  return {made, weaker(one, other, made.young_modulus)};
}

std::vector<BeamPairing> pairings(const BeamElasticity& rest,
                                  const std::vector<BeamMaterial>& materials,
                                  const std::vector<BeamInterface>& interfaces,
                                  const YieldLaw* yield) {
  std::vector<BeamPairing> alone{{rest, {}}}, pairs;
  for (const BeamMaterial& material : materials)
    alone.push_back({material, stated(material.limits, {}, yield)});
  for (const BeamPairing& first : alone)
    for (const BeamPairing& second : alone) pairs.push_back(in_series(first, second));
  for (const BeamInterface& interface : interfaces) {
    const std::size_t first = number_of(interface.first, materials),
                      second = number_of(interface.second, materials);
    const LimitScale<double> sides = weaker(alone[first], alone[second], interface.young_modulus);
    pairs[first * alone.size() + second] =
        pairs[second * alone.size() + first] = {interface, stated(interface.limits, sides, yield)};
  }
  for (BeamPairing& pair : pairs) pair.limits.is_one = is_one(pair.limits);
  return pairs;
}

bool limits_are_alike(const std::vector<BeamPairing>& pairings) {
  return std::all_of(pairings.begin(), pairings.end(),
                     [](const BeamPairing& pair) { return pair.limits.is_one; });
}

BeamMaterialTable::BeamMaterialTable(const std::vector<BeamMaterial>& materials,
                                     std::vector<BeamPairing> pairings, const Specimen& specimen)
    : count_(materials.size() + 1), of_element_(specimen.size(), 0), pairs_(std::move(pairings)) {
  std::size_t count = 0;
  for (const BeamMaterial& material : materials) {
    ++count;
    const std::string owner = "[[beams.material]] \"" + material.name + "\"";
    for (const std::int32_t element : select_some(owner, material.region, specimen)) {
      std::size_t& number = of_element_[static_cast<std::size_t>(element)];
      if (number != 0)
        throw InputError(owner + " and \"" + materials[number - 1].name + "\" share elements, " +
                         place(specimen, static_cast<std::size_t>(element)) +
                         " for one; their regions must not overlap");
      number = count;
    }
  }
}

}  // namespace solidem
