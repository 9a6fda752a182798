// SPDX-License-Identifier: GPL-2.0-or-later
//
// The hardening of bonds of which bars meet a curve of stress over strain.
#ifndef SOLIDEM_ENGINE_CURVE_CALIBRATION_HPP
#define SOLIDEM_ENGINE_CURVE_CALIBRATION_HPP

#include "engine/calibration.hpp"
#include "engine/tension_bench.hpp"

namespace solidem {

/// How far the bars of a curve are pulled: until the gauge section has its last strain.
TensionTest curve_test(const TensionTest& test, const CurveTarget& target);

/// Finds the hardening, once the elasticity is found. Bars are pulled slow and cold: what rate and
/// temperature do to the law is kept aside and stands in the result as it did. `note` hears of each
/// trial.
void find_curve(const CalibrationRequest& request, const TensionTest& test,
                const TensionBench& bench, Calibration& found,
                const std::function<void(CalibrationTrial)>& note);

}  // namespace solidem

#endif
