// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/flow_curve.hpp"

#include <algorithm>
#include <cmath>

#include "laws/johnson_cook.hpp"

namespace solidem {

FlowPoint true_point(double engineering_strain, double engineering_stress) {
  return {std::log1p(engineering_strain), engineering_stress * (1 + engineering_strain)};
}

FlowPoint compressed_point(double engineering_strain, double engineering_stress) {
  const FlowPoint point = true_point(-engineering_strain, -engineering_stress);
  return {-point.strain, -point.stress};
}

double stress_at(const std::vector<FlowPoint>& curve, double strain) {
  const auto above = std::find_if(curve.begin(), curve.end(),
                                  [&](const FlowPoint& p) { return p.strain >= strain; });
  if (above == curve.end()) return std::nan("");
  if (above->strain == strain) return above->stress;
  if (above == curve.begin()) return std::nan("");
  const FlowPoint &p = *(above - 1), &q = *above;
  return p.stress + (strain - p.strain) / (q.strain - p.strain) * (q.stress - p.stress);
}

double lasting_strain(const FlowPoint& point, double young_modulus) {
  return point.strain - point.stress / young_modulus;
}

std::vector<FlowPoint> points_of(const JohnsonCookCurve& curve, double young_modulus,
                                 const std::vector<double>& strains) {
  JohnsonCook law;
  law.yield_strain = curve.yield_stress / young_modulus;
  law.hardening_strain = curve.hardening_stress / young_modulus;
  law.hardening_exponent = curve.hardening_exponent;
  const YieldCurve<JohnsonCook, double> slow_and_cold{law};
  std::vector<FlowPoint> points;
  for (const double strain : strains) {
    const bool flows = strain > law.yield_strain;
    const double elastic = flows ? returned_strain(slow_and_cold, strain, 0.0) : strain;
    points.push_back({strain, young_modulus * elastic});
  }
  return points;
}

}  // namespace solidem
