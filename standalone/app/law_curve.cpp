// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/law_curve.hpp"

#include <algorithm>

#include "laws/central_interaction.hpp"

namespace solidem {

const char* name_of(LawPart part) {
  switch (part) {
    case LawPart::continuation:
      return "continuation";
    case LawPart::beyond:
      return "beyond";
    case LawPart::law:
      break;
  }
  return "law";
}

LawPoint law_at(const ShownLaw& shown, double distance) {
  const double range = shown.range * shown.equilibrium;
  if (distance >= range) return {distance, 0, 0, 0, LawPart::beyond};
  const bool is_deep = distance < (1 - shown.interpenetration) * shown.equilibrium;
  return std::visit(
      [&](const auto& law) -> LawPoint {
        const ForceAndStiffness at =
            central_force(law, shown.interpenetration, distance, shown.equilibrium);
        return {distance, at.force, at.stiffness,
                central_potential(law, shown.interpenetration, range, distance, shown.equilibrium),
                is_deep ? LawPart::continuation : LawPart::law};
      },
      shown.law);
}

std::vector<LawPoint> sample(const ShownLaw& shown, double from, double to, int count) {
  std::vector<double> ratios;
  for (int k = 0; k < count; ++k) ratios.push_back(from + (to - from) * k / (count - 1));
  for (const double edge : {1 - shown.interpenetration, shown.range, 1.0})
    for (const double side : {-1e-9, 1e-9}) ratios.push_back(edge + side);
  std::sort(ratios.begin(), ratios.end());
  std::vector<LawPoint> points;
  for (const double ratio : ratios)
    if (ratio >= from && ratio <= to) points.push_back(law_at(shown, ratio * shown.equilibrium));
  return points;
}

LawFigures figures_of(const ShownLaw& shown) {
  const double equilibrium = shown.equilibrium;
  const double deepest = (1 - shown.interpenetration) * equilibrium;
  const double end = shown.range * equilibrium * (1 - 1e-15);
  const LawPoint at_rest = law_at(shown, equilibrium), deep = law_at(shown, deepest);
  LawFigures figures{
      at_rest.stiffness, 0, 0, law_at(shown, end).force, -at_rest.potential, deep.force,
      deep.stiffness};
  // Attraction grows as long as the stiffness is above zero; then it is the largest.
  double growing = equilibrium, past = end;
  if (law_at(shown, end).stiffness > 0)
    growing = end;
  else
    for (int halvings = 0; halvings < 60; ++halvings) {
      const double middle = (growing + past) / 2;
      (law_at(shown, middle).stiffness > 0 ? growing : past) = middle;
    }
  figures.attraction = -law_at(shown, growing).force;
  figures.attraction_distance = growing;
  return figures;
}

}  // namespace solidem
