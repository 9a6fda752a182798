// SPDX-License-Identifier: GPL-2.0-or-later
//
// [calibration].
#include "effects/beam_parameters.hpp"
#include "keys/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

/// Two numbers, the lower one first.
std::array<double, 2> read_bounds(const Value& value, const Range& range,
                                  const std::string& expected) {
  const std::vector<Value> entries = value.entries(2, expected);
  const std::array<double, 2> bounds{read_number(entries[0], range),
                                     read_number(entries[1], range)};
  if (!(bounds[0] < bounds[1])) value.refuse("the first is not below the second", expected);
  return bounds;
}

Rule rupture_target(std::optional<std::array<double, 2>>& place) {
  const std::string expected = "a number above 0, or [lowest, highest]";
  return {expected, [&place, expected](const Value& value) {
            if (value.node().is_array()) {
              place = read_bounds(value, positive, expected);
              return;
            }
            const double number = read_number(value, positive);
            place = {number, number};
          }};
}

Rule radius_ratio_range(RootRange& place) {
  const std::string expected = "[lowest, highest], both above 0";
  return {expected, [&place, expected](const Value& value) {
            const std::array<double, 2> bounds = read_bounds(value, positive, expected);
            place = {bounds[0], bounds[1]};
          }};
}

Rule tolerances(CalibrationTolerances& tolerances) {
  return table([&tolerances](const Section& section) {
    section.read({may_have("poisson_ratio", number(tolerances.poisson_ratio, positive)),
                  may_have("yield_stress", number(tolerances.yield_stress, positive)),
                  may_have("peak_stress", number(tolerances.peak_stress, positive)),
                  may_have("rupture_strain", number(tolerances.rupture_strain, positive))});
  });
}

void check(const Section& section, const CalibrationTargets& targets) {
  if (targets.yield_stress && targets.peak_stress && *targets.peak_stress <= *targets.yield_stress)
    section.refuse("peak_stress", "not above yield_stress", "peak_stress > yield_stress");
  for (const char* figure : {"yield_stress", "peak_stress", "rupture_strain"})
    if (targets.curve && section.has(figure))
      section.refuse(figure, "the whole curve is given", "either this or a curve");
  if (section.has("speed") && targets.is_elastic())
    section.refuse("speed", "no bar is pulled for an elastic calibration",
                   "yield_stress, peak_stress, rupture_strain or a curve beside it");
}

}  // namespace

Rule calibration_section(std::optional<CalibrationRequest>& calibration,
                         std::optional<OrthotropicRequest>& orthotropic,
                         const std::optional<BeamParameters>& beams) {
  return table([&calibration, &orthotropic, &beams](const Section& section) {
    if (beams && !beams->materials.empty())
      section.refuse("there are several materials of beams",
                     "one, in [beams]; each material is calibrated alone");
    if (asks_for_orthotropic_calibration(section)) {
      orthotropic = read_orthotropic_calibration(section, beams);
      return;
    }
    CalibrationRequest request;
    CalibrationTargets& targets = request.targets;
    section.read(
        {must_have("young_modulus", quantity(targets.young_modulus, dimension::modulus, positive)),
         may_have("poisson_ratio", number(targets.poisson_ratio, Range{-1, 0.5, false, true})),
         may_have("yield_stress", quantity(targets.yield_stress, dimension::modulus, positive)),
         may_have("peak_stress", quantity(targets.peak_stress, dimension::modulus, positive)),
         may_have("rupture_strain", rupture_target(targets.rupture_strain)),
         may_have("curve", curve_section(targets.curve, targets.young_modulus)),
         may_have("specimens", integer(request.specimens, 1, 1000)),
         may_have("fit", choice<bool>(request.one_set, {{"mean", true}, {"each", false}})),
         may_have("poisson_by",
                  choice<PoissonParameter>(request.poisson_by,
                                           {{"radius_ratio", PoissonParameter::radius_ratio},
                                            {"poisson_ratio", PoissonParameter::poisson_ratio}})),
         may_have("radius_ratio", radius_ratio_range(request.radius_ratio)),
         may_have("tolerances", tolerances(request.tolerances)),
         may_have("tension_tests", integer(request.tension_tests, 1, 1000)),
         may_have("speed", quantity(request.speed, dimension::velocity, positive))});
    check(section, targets);
    if (beams && beams->law == BeamParameters::Law::spring &&
        request.poisson_by == PoissonParameter::poisson_ratio)
      section.refuse("poisson_by", "springs have no Poisson ratio", "\"radius_ratio\"");
    calibration = request;
  });
}

}  // namespace solidem
