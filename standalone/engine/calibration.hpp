// SPDX-License-Identifier: GPL-2.0-or-later
//
// Which beams make a body with the properties of a material.
#ifndef SOLIDEM_ENGINE_CALIBRATION_HPP
#define SOLIDEM_ENGINE_CALIBRATION_HPP

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/tension_test.hpp"
#include "solve/calibration/flow_curve.hpp"
#include "solve/calibration/root_search.hpp"

namespace solidem {

/// What the body shall show in a tension test.
struct CalibrationTargets {
  double young_modulus = 0;                             ///< E, Pa
  std::optional<double> poisson_ratio;                  ///< ν
  std::optional<double> yield_stress;                   ///< σ_0.2, Pa
  std::optional<double> peak_stress;                    ///< Pa
  std::optional<std::array<double, 2>> rupture_strain;  ///< lowest and highest that will do

  std::optional<CurveTarget> curve{};  ///< in place of the three before

  bool is_elastic() const { return !yield_stress && !peak_stress && !rupture_strain && !curve; }
};

/// How near is near enough.
struct CalibrationTolerances {
  double poisson_ratio = 0.002;  ///< absolute
  double yield_stress = 0.01;    ///< shares of the target
  double peak_stress = 0.02;
  double rupture_strain = 0.1;  ///< of a target that is one number
};

/// Each target has its parameter: E the beams' modulus, σ_0.2 their yield strain, the peak stress
/// their hardening, the rupture strain theirs, and ν one of two.
enum class PoissonParameter {
  radius_ratio,  ///< of the beams
  poisson_ratio  ///< of the beams: G against E
};

struct CalibrationRequest {
  CalibrationTargets targets;
  CalibrationTolerances tolerances;
  int specimens = 3;  ///< packings of the same recipe, of seeds that follow each other
  /// One set of parameters, of which the mean of all specimens meets the targets; or a set for
  /// each.
  bool one_set = true;
  PoissonParameter poisson_by = PoissonParameter::radius_ratio;
  RootRange radius_ratio{0.1, 0.9};  ///< where it is sought
  int tension_tests = 10;            ///< most of each specimen
  std::optional<double> speed;       ///< of the tension test, m/s; default: 1/1000 of sqrt(E/ρ)
};

/// What a body showed; the dynamic figures are missing where no bar was pulled.
struct BodyFigures {
  ElasticConstants elastic;
  TensionFigures tension;
  std::vector<double> stresses{};  ///< true ones at the points of the curve, Pa; NaN: not reached
};

/// One set of parameters that was tried.
struct CalibrationTrial {
  bool is_dynamic;  ///< bars were pulled; else static tests
  BondParameters bonds;
  std::vector<BodyFigures> figures;  ///< of each specimen
  double seconds;                    ///< wall time
};

struct Calibration {
  BondParameters bonds;              ///< found
  std::vector<BodyFigures> figures;  ///< of each specimen with these
  double poisson_slope = 0;          ///< dν / d of the parameter that brings it; 0: not known
  std::vector<CalibrationTrial> trials;
  std::vector<std::string> misses;  ///< targets that were not met, each with what can be reached
};

/// Mean and standard deviation of those that are there.
struct Spread {
  double mean = 0, deviation = 0;
  std::size_t count = 0;
};
Spread spread(const std::vector<std::optional<double>>& values);

/// The figures of all specimens by name, in SI: "young_modulus", "poisson_ratio", "yield_stress",
/// "peak_stress", "rupture_strain"; left out where there are none.
std::vector<std::pair<std::string, Spread>> spreads(const std::vector<BodyFigures>& figures);

/// Their stresses at each point of the curve.
std::vector<Spread> curve_spreads(const std::vector<BodyFigures>& figures);

/// Finds the parameters. `start`: what is fixed and where the search begins. `gauge`: of the
/// tension test; none: the middle 40 % of the longest side. `tell` hears of each trial at once.
/// Throws InputError when the Poisson ratio is out of reach (what is reachable, and what else
/// would move it) or the specimens are no bars.
Calibration calibrate(const CalibrationRequest& request, const BondParameters& start,
                      const std::vector<Material>& materials, const std::optional<Gauge>& gauge,
                      const std::vector<Specimen>& specimens,
                      const std::function<void(const CalibrationTrial&)>& tell = {});

}  // namespace solidem

#endif
