// SPDX-License-Identifier: GPL-2.0-or-later
//
// How `solidem calibrate` tells of a curve.
#ifndef SOLIDEM_APP_CALIBRATE_CURVE_HPP
#define SOLIDEM_APP_CALIBRATE_CURVE_HPP

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/say.hpp"
#include "engine/calibration.hpp"

namespace solidem {

/// The greatest miss of a trial, of all points; empty without a curve.
std::string text_of_curve(const CurveTarget& target, const std::vector<BodyFigures>& figures);

/// A line for each point: strain, wanted and reached stress, what it misses.
void print_curve(const CurveTarget& target, const std::vector<BodyFigures>& figures,
                 const Voice& tell);

/// The same, in SI units.
nlohmann::ordered_json curve_json(const CurveTarget& target,
                                  const std::vector<BodyFigures>& figures);

}  // namespace solidem

#endif
