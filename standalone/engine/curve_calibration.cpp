// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/curve_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/seconds_since.hpp"
#include "solve/calibration/hardening_search.hpp"

namespace solidem {

namespace {

/// Of the strain of the gauge section: a bar that stretches elsewhere never has its last strain.
constexpr double longest_elongation = 3;
/// Its ends do not meet.
constexpr double longest_compression = 0.9;

/// A bar that is pulled without heat, so slowly that the rate does not count.
BondParameters slow_and_cold(BondParameters bonds, const YieldLaw& law) {
  bonds.plasticity->hardening = slow_and_cold(law);
  bonds.plasticity->rate_time.reset();
  return bonds;
}

std::vector<double> stresses_of(const TensionCurve& shown, const CurveTarget& target) {
  std::vector<FlowPoint> curve;
  const auto measured = target.is_compressed ? compressed_point : true_point;
  for (const TensionPoint& p : shown.points) curve.push_back(measured(p.strain, p.stress));
  std::vector<double> stresses;
  for (const FlowPoint& p : target.points) stresses.push_back(stress_at(curve, p.strain));
  return stresses;
}

/// The mean of all specimens; NaN where not all came.
std::vector<double> mean_stresses(const std::vector<BodyFigures>& figures) {
  std::vector<double> means(figures.front().stresses.size(), 0);
  for (const BodyFigures& body : figures)
    for (std::size_t k = 0; k < means.size(); ++k)
      means[k] += body.stresses[k] / static_cast<double>(figures.size());
  return means;
}

std::string parameters_in_words(const YieldLaw& law) {
  std::string text;
  for (const HardeningParameter& parameter : hardening_parameters(law))
    text += fmt::format("{}{} {:.4g}", text.empty() ? "" : ", ", parameter.name, parameter.value);
  return text;
}

/// What of the curve is not met.
std::vector<std::string> misses_of(const CurveTarget& target, const HardeningSearch& search,
                                   JudgedSection section) {
  std::vector<std::string> misses;
  for (std::size_t k = 0; k < target.points.size(); ++k) {
    const auto [strain, wanted] = target.points[k];
    const double reached = search.stresses[k], miss = reached / wanted - 1;
    if (std::abs(miss) <= target.tolerance) continue;
    misses.push_back(
        fmt::format("curve: {:.5g} MPa at a strain of {:.4g}: ", wanted / 1e6, strain) +
        (std::isnan(reached)
             ? std::string("the gauge section of not every bar came so far")
             : fmt::format("the nearest gave {:.5g} MPa, {:+.1f} %", reached / 1e6, 100 * miss)));
  }
  if (!misses.empty())
    misses.back() += fmt::format(
        " ({}). {}Other strains or a larger tolerance ask for less",
        parameters_in_words(search.law),
        section == JudgedSection::middle
            ? "[plasticity] section = \"ends\" sharpens the knee of a network of bonds. "
            : "");
  return misses;
}

}  // namespace

TensionTest curve_test(const TensionTest& test, const CurveTarget& target) {
  TensionTest longer = test;
  const double strain = target.points.back().strain;
  const double last = target.is_compressed ? -std::expm1(-strain) : std::expm1(strain);
  if (target.is_compressed) longer.speed = -test.speed;
  longer.longest_strain = 1.01 * last;
  longer.longest_elongation = longest_elongation * last;
  if (target.is_compressed)
    longer.longest_elongation = std::min(longer.longest_elongation, longest_compression);
  return longer;
}

void find_curve(const CalibrationRequest& request, const TensionTest& test,
                const TensionBench& bench, Calibration& found,
                const std::function<void(CalibrationTrial)>& note) {
  const CurveTarget& target = *request.targets.curve;
  if (!found.bonds.plasticity) {
    found.bonds.plasticity = PlasticityParameters{};
    found.bonds.plasticity->hardening = JohnsonCook{};
  }
  std::vector<ElasticConstants> elastic;
  for (const BodyFigures& figures : found.figures) elastic.push_back(figures.elastic);
  std::vector<std::vector<BodyFigures>> shown;
  const auto pull_bars = [&](const YieldLaw& law) {
    const auto start = Clock::now();
    CalibrationTrial trial{true, slow_and_cold(found.bonds, law), found.figures, 0};
    const std::vector<TensionCurve> curves = bench.tension(trial.bonds, elastic, test);
    for (std::size_t k = 0; k < curves.size(); ++k) {
      trial.figures[k].tension = {};
      trial.figures[k].stresses = stresses_of(curves[k], target);
    }
    shown.push_back(trial.figures);
    trial.seconds = seconds_since(start);
    note(std::move(trial));
    return mean_stresses(shown.back());
  };
  const HardeningSearch search =
      find_hardening(target, request.targets.young_modulus, found.bonds.plasticity->hardening,
                     request.tension_tests, pull_bars);
  found.bonds.plasticity->hardening = search.law;
  found.figures = shown[search.test];
  found.misses = misses_of(target, search, found.bonds.plasticity->section);
}

}  // namespace solidem
