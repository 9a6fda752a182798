// SPDX-License-Identifier: GPL-2.0-or-later
//
// What stress a body bears at what strain in simple tension or compression, as a material's curve
// says it and as a bar shows it.
#ifndef SOLIDEM_SOLVE_CALIBRATION_FLOW_CURVE_HPP
#define SOLIDEM_SOLVE_CALIBRATION_FLOW_CURVE_HPP

#include <vector>

namespace solidem {

/// A point of a curve in true measures.
struct FlowPoint {
  double strain;  ///< logarithmic, elastic and plastic
  double stress;  ///< Pa
};

/// A curve that a body shall meet.
struct CurveTarget {
  std::vector<FlowPoint> points;  ///< at which it is compared, strains rising, all in the flow
  double tolerance = 0.02;        ///< of the stress at each
  bool is_compressed = false;     ///< the body: strains and stresses count as if they were tension
};

/// True measures of engineering ones. The stress counts on the section that a body of constant
/// volume has: σ (1 + e), so that its work over the logarithmic strain is that of the grips.
FlowPoint true_point(double engineering_strain, double engineering_stress);

/// The same of a body that is compressed: both measures count above 0, σ (1 − e) over −ln(1 − e).
FlowPoint compressed_point(double engineering_strain, double engineering_stress);

/// Where a curve of rising strains has a strain, on the lines between its points; NaN outside.
double stress_at(const std::vector<FlowPoint>& curve, double strain);

/// What is left of the strain of a point when its stress is gone.
double lasting_strain(const FlowPoint& point, double young_modulus);

/// A + B κ^n of Johnson and Cook (slow and cold) over the plastic strain κ, Pa.
struct JohnsonCookCurve {
  double yield_stress = 0, hardening_stress = 0, hardening_exponent = 1;
};

/// The curve at some strains of a body that is elastic before it flows.
std::vector<FlowPoint> points_of(const JohnsonCookCurve& curve, double young_modulus,
                                 const std::vector<double>& strains);

}  // namespace solidem

#endif
