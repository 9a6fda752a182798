// SPDX-License-Identifier: GPL-2.0-or-later
//
// Elasticity first: the Poisson ratio of a network of beams depends on the shape of the beams
// alone, so it is the root of a function of one parameter; its modulus is proportional to that of
// the beams. Then plasticity: σ_0.2 follows the yield strain, the peak stress the hardening (and
// the yield strain), the rupture strain that of the beams (and the hardening). Each round of tests
// corrects all three.
#include "engine/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/LU>

#include "effects/beam_parameters.hpp"
#include "engine/curve_calibration.hpp"
#include "engine/tension_bench.hpp"
#include "model/error.hpp"
#include "model/seconds_since.hpp"
#include "specimen/bonds.hpp"

namespace solidem {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Where the search for beams begins that the scene says nothing of. Yielding starts in the most
/// loaded beams, long before σ_0.2: the yield strain is about half of σ_0.2 / E.
constexpr double yield_strain_fraction = 0.53;
constexpr double usual_hardening = 0.007;
constexpr double rupture_strain_fraction = 1.3;

std::vector<double> poisson_ratios(const std::vector<ElasticConstants>& constants) {
  std::vector<double> ratios;
  for (const ElasticConstants& c : constants) ratios.push_back(c.poisson_ratio);
  return ratios;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// The same beams of another material, G / E kept.
BeamParameters scaled(BeamParameters beams, double factor) {
  beams.young_modulus *= factor;
  beams.shear_modulus *= factor;
  if (beams.anisotropy) {
    Anisotropy& grain = *beams.anisotropy;
    grain.radial_modulus *= factor;
    grain.tangential_modulus *= factor;
    if (grain.transverse_shear_modulus) *grain.transverse_shear_modulus *= factor;
  }
  return beams;
}

BeamParameters with_poisson_ratio(BeamParameters beams, double poisson_ratio) {
  beams.shear_modulus = beams.young_modulus / (2 * (1 + poisson_ratio));
  return beams;
}

/// A round of dynamic tests: logarithms of yield strain, hardening and rupture strain of the beams,
/// and of σ_0.2, peak stress and rupture strain of the body, each over its target.
struct Round {
  Vector3d parameters, figures;
};

/// How these figures follow these parameters, roughly: of bars of AA2024 with 300 to 5000 elements.
Matrix3d first_slopes() {
  Matrix3d slopes;
  slopes << 1, 0.02, 0,  //
      0.8, 0.2, 0.3,     //
      0, 0.4, 1.2;
  return slopes;
}

constexpr double longest_step = 0.4;
constexpr double shortest_lesson = 0.05;

/// A calibration on its way.
class Search {
 public:
  Search(const CalibrationRequest& request, const BondParameters& start,
         const std::vector<Material>& materials, const std::optional<Gauge>& gauge,
         const std::vector<Specimen>& specimens,
         const std::function<void(const CalibrationTrial&)>& tell)
      : request_(request), materials_(materials), bench_(specimens, gauge), tell_(tell) {
    found_.bonds = start;
  }

  Calibration run() {
    find_elasticity();
    if (request_.targets.curve)
      find_curve(request_, curve_test(tension_test(), *request_.targets.curve), bench_, found_,
                 [this](CalibrationTrial trial) { note(std::move(trial)); });
    else if (!request_.targets.is_elastic())
      find_plasticity();
    return std::move(found_);
  }

 private:
  // --- elasticity

  /// The variable of the search for ν: the logarithm of the radius ratio, in which ν is nearly
  /// straight, or the Poisson ratio of the beams.
  BeamParameters beams_at(double variable) const {
    BeamParameters beams = found_.bonds.beams;
    if (request_.poisson_by == PoissonParameter::poisson_ratio)
      return with_poisson_ratio(beams, variable);
    beams.radius_ratio = std::exp(variable);
    return beams;
  }

  std::vector<ElasticConstants> test_elasticity(const BeamParameters& beams) {
    const auto start = Clock::now();
    std::vector<ElasticConstants> constants = bench_.elasticity(beams);
    CalibrationTrial trial{false, found_.bonds, {}, 0};
    trial.bonds.beams = beams;
    for (const ElasticConstants& c : constants) trial.figures.push_back({c, {}});
    note(std::move(trial), start);
    return constants;
  }

  void find_elasticity() {
    if (request_.targets.poisson_ratio) find_poisson_ratio();
    if (found_.trials.empty()) test_elasticity(found_.bonds.beams);
    // The best trial stands last but for a search that ended on another one.
    const CalibrationTrial& best = *std::find_if(
        found_.trials.begin(), found_.trials.end(), [&](const CalibrationTrial& trial) {
          return trial.bonds.beams.radius_ratio == found_.bonds.beams.radius_ratio &&
                 trial.bonds.beams.shear_modulus == found_.bonds.beams.shear_modulus;
        });
    std::vector<double> moduli;
    for (const BodyFigures& figures : best.figures) moduli.push_back(figures.elastic.young_modulus);
    const double factor = request_.targets.young_modulus / mean(moduli);
    found_.figures = best.figures;
    for (BodyFigures& figures : found_.figures) figures.elastic.young_modulus *= factor;
    found_.bonds.beams = scaled(found_.bonds.beams, factor);
  }

  void find_poisson_ratio() {
    const double target = *request_.targets.poisson_ratio;
    const BeamParameters& beams = found_.bonds.beams;
    const bool by_radius = request_.poisson_by == PoissonParameter::radius_ratio;
    RootRange range{-0.9, 0.5};
    double start = beams.young_modulus / (2 * beams.shear_modulus) - 1;
    double slope = -0.05;  // a first guess; tests correct it
    if (by_radius) {
      range = {std::log(request_.radius_ratio.lower), std::log(request_.radius_ratio.upper)};
      start = std::log(beams.radius_ratio);
      slope = -0.13;
    }
    start = std::clamp(start, range.lower, range.upper);
    const RootSearch search = find_root(
        [&](double variable) {
          return mean(poisson_ratios(test_elasticity(beams_at(variable)))) - target;
        },
        range, start, slope, request_.tolerances.poisson_ratio);
    if (!search.found) refuse_poisson_ratio(search);
    found_.bonds.beams = beams_at(search.best.at);
    find_slope(search);
  }

  /// dν over the parameter, from the two trials nearest to the root.
  void find_slope(const RootSearch& search) {
    const RootTrial* other = nullptr;
    for (const RootTrial& trial : search.trials)
      if (trial.at != search.best.at &&
          (other == nullptr ||
           std::abs(trial.at - search.best.at) < std::abs(other->at - search.best.at)))
        other = &trial;
    if (other == nullptr) return;
    const bool by_radius = request_.poisson_by == PoissonParameter::radius_ratio;
    const double a = by_radius ? std::exp(search.best.at) : search.best.at;
    const double b = by_radius ? std::exp(other->at) : other->at;
    found_.poisson_slope = (other->value - search.best.value) / (b - a);
  }

  /// Says what is reachable, and what else would move ν, measured on the first specimen.
  [[noreturn]] void refuse_poisson_ratio(const RootSearch& search) {
    const double target = *request_.targets.poisson_ratio;
    const bool by_radius = request_.poisson_by == PoissonParameter::radius_ratio;
    const char* name = by_radius ? "radius_ratio" : "poisson_ratio of the beams";
    const auto [low, high] = std::minmax_element(
        search.trials.begin(), search.trials.end(),
        [](const RootTrial& a, const RootTrial& b) { return a.value < b.value; });
    const auto shown = [&](double variable) { return by_radius ? std::exp(variable) : variable; };
    std::string text = fmt::format(
        "[calibration] poisson_ratio = {:.4g}: out of reach: {} from {:.3g} to {:.3g} gives "
        "{:.4f} (at {:.3g}) to {:.4f} (at {:.3g})",
        target, name, by_radius ? request_.radius_ratio.lower : -0.9,
        by_radius ? request_.radius_ratio.upper : 0.5, target + low->value, shown(low->at),
        target + high->value, shown(high->at));
    const BeamParameters best = beams_at(search.best.at);
    text += fmt::format("; nearest with {} = {:.3g}. Of the first specimen ({:.4f} there):", name,
                        shown(search.best.at), first_poisson_ratio(best, bench_.first()));
    for (const double tolerance : {0.0, 0.05})
      if (tolerance != bench_.first().bond_tolerance) {
        Specimen other = bench_.first();
        make_bonds(other, tolerance);
        text += fmt::format(" [bonds] tolerance = {:g} gives {:.4f};", tolerance,
                            first_poisson_ratio(best, other));
      }
    if (by_radius && best.law != BeamParameters::Law::spring)
      for (const double ratio : {-0.5, 0.5})
        text += fmt::format(" poisson_ratio = {:g} of the beams gives {:.4f};", ratio,
                            first_poisson_ratio(with_poisson_ratio(best, ratio), bench_.first()));
    if (!by_radius)
      for (const double ratio : {request_.radius_ratio.lower, request_.radius_ratio.upper}) {
        BeamParameters other = best;
        other.radius_ratio = ratio;
        text += fmt::format(" radius_ratio = {:g} gives {:.4f};", ratio,
                            first_poisson_ratio(other, bench_.first()));
      }
    throw InputError(text + " expected a target within reach");
  }

  double first_poisson_ratio(const BeamParameters& beams, const Specimen& specimen) const {
    return elastic_constants(beams, specimen, bench_.first_bar()).poisson_ratio;
  }

  // --- plasticity

  TensionTest tension_test() const {
    const CalibrationTargets& targets = request_.targets;
    TensionTest test{};
    test.materials = materials_;
    test.speed = request_.speed.value_or(
        1e-3 * std::sqrt(targets.young_modulus / materials_.front().density));
    const double yield = targets.yield_stress.value_or(targets.peak_stress.value_or(0));
    test.fine_elongation = 3 * (0.002 + yield / targets.young_modulus);
    test.longest_elongation = test.fine_elongation;
    if (targets.rupture_strain)
      test.longest_elongation = std::max(test.fine_elongation, 2 * (*targets.rupture_strain)[1]);
    else if (targets.peak_stress)
      test.longest_elongation = std::max(test.fine_elongation, 0.4);
    return test;
  }

  /// The parameters that are sought: those of one law each.
  LinearHardening& hardening() {
    if (auto* law = std::get_if<LinearHardening>(&found_.bonds.plasticity->hardening)) return *law;
    throw InputError("[plasticity] hardening = \"" + name_of(found_.bonds.plasticity->hardening) +
                     "\": only that of the law \"linear\" can be found; expected that one, or no "
                     "target of yield or of peak stress");
  }
  StrainLimit& rupture() {
    if (auto* law = std::get_if<StrainLimit>(&found_.bonds.rupture->law)) return *law;
    throw InputError("[rupture] law = \"" + name_of(found_.bonds.rupture->law) +
                     "\": only the strain of \"strain-limit\" can be found; expected that one, "
                     "or no target of rupture strain");
  }

  void choose_start() {
    const CalibrationTargets& targets = request_.targets;
    BondParameters& bonds = found_.bonds;
    if (!bonds.plasticity && (targets.yield_stress || targets.peak_stress)) {
      bonds.plasticity = PlasticityParameters{};
      hardening().yield_strain =
          yield_strain_fraction *
          targets.yield_stress.value_or(0.7 * targets.peak_stress.value_or(0)) /
          targets.young_modulus;
    }
    if (targets.peak_stress && hardening().hardening_ratio == 0)
      hardening().hardening_ratio = usual_hardening;
    if (targets.rupture_strain) {
      if (!bonds.rupture) bonds.rupture = RuptureParameters{};
      if (!rupture_strain(bonds))
        rupture().strain = rupture_strain_fraction * 0.5 *
                           ((*targets.rupture_strain)[0] + (*targets.rupture_strain)[1]);
    }
  }

  void find_plasticity() {
    choose_start();
    const TensionTest test = tension_test();
    std::vector<ElasticConstants> elastic;
    for (const BodyFigures& figures : found_.figures) elastic.push_back(figures.elastic);
    double least = 0;
    Calibration best = found_;
    for (int round = 0; round < request_.tension_tests; ++round) {
      const auto start = Clock::now();
      const std::vector<TensionCurve> curves = bench_.tension(found_.bonds, elastic, test);
      for (std::size_t k = 0; k < curves.size(); ++k) found_.figures[k].tension = curves[k].figures;
      note({true, found_.bonds, found_.figures, 0}, start);
      const double worst = worst_miss();
      if (round == 0 || worst < least) {
        least = worst;
        best.bonds = found_.bonds;
        best.figures = found_.figures;
      }
      if (worst <= 1 || !correct()) break;
    }
    found_.bonds = best.bonds;
    found_.figures = best.figures;
    if (least > 1) tell_misses();
  }

  Spread figure(std::optional<double> TensionFigures::*member) const {
    std::vector<std::optional<double>> values;
    for (const BodyFigures& figures : found_.figures) values.push_back(figures.tension.*member);
    return spread(values);
  }

  /// How far a figure is from its target, in tolerances.
  double miss(const std::optional<double>& target, const Spread& figure, double tolerance) const {
    if (!target) return 0;
    if (figure.count < bench_.size()) return 1e3;  // some specimens did not show it
    return std::abs(figure.mean / *target - 1) / tolerance;
  }

  double rupture_miss(const Spread& figure) const {
    if (!request_.targets.rupture_strain) return 0;
    if (figure.count < bench_.size()) return 1e3;
    const auto [low, high] = *request_.targets.rupture_strain;
    if (low == high) return miss(low, figure, request_.tolerances.rupture_strain);
    if (figure.mean < low || figure.mean > high) return 2;
    return 0;
  }

  double worst_miss() const {
    const CalibrationTargets& targets = request_.targets;
    return std::max({miss(targets.yield_stress, figure(&TensionFigures::yield_stress),
                          request_.tolerances.yield_stress),
                     miss(targets.peak_stress, figure(&TensionFigures::peak_stress),
                          request_.tolerances.peak_stress),
                     rupture_miss(figure(&TensionFigures::rupture_strain))});
  }

  /// Sets the parameters of the next round: Newton's step in the logarithms of all, with slopes
  /// that the rounds correct (Broyden, Math. Comp. 19, 577 (1965)). False when nothing is left to
  /// change.
  bool correct() {
    const CalibrationTargets& targets = request_.targets;
    Round now{Vector3d::Zero(), Vector3d::Zero()};
    std::array<bool, 3> sought{false, false, false};
    const auto seek = [&](int k, double parameter, double shown, double target, bool is_sought) {
      now.parameters[k] = std::log(parameter);
      now.figures[k] = std::log(shown / target);
      sought[static_cast<std::size_t>(k)] = is_sought;
    };
    const Spread yield = figure(&TensionFigures::yield_stress);
    const Spread peak = figure(&TensionFigures::peak_stress);
    const Spread rupture = figure(&TensionFigures::rupture_strain);
    if (targets.yield_stress && yield.count > 0)
      seek(0, hardening().yield_strain, yield.mean, *targets.yield_stress, true);
    if (targets.peak_stress && peak.count > 0)
      seek(1, hardening().hardening_ratio, peak.mean, *targets.peak_stress, true);
    if (targets.rupture_strain) {
      const auto [low, high] = *targets.rupture_strain;
      const double shown = rupture.count < bench_.size() ? 2 * high : rupture.mean;
      rupture_is_sought_ = rupture_is_sought_ || low == high || shown < low || shown > high;
      seek(2, this->rupture().strain, shown, 0.5 * (low + high), rupture_is_sought_);
    }
    learn(now);
    Matrix3d slopes = slopes_;
    for (int k = 0; k < 3; ++k)
      if (!sought[static_cast<std::size_t>(k)]) {
        slopes.row(k) = Vector3d::Unit(k).transpose();
        now.figures[k] = 0;
      }
    Vector3d step = -slopes.fullPivLu().solve(now.figures);
    if (!step.allFinite() || step.isZero()) return false;
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest > longest_step) step *= longest_step / largest;
    if (sought[0]) hardening().yield_strain *= std::exp(step[0]);
    if (sought[1]) hardening().hardening_ratio *= std::exp(step[1]);
    if (sought[2]) this->rupture().strain *= std::exp(step[2]);
    return true;
  }

  /// Corrects the slopes by what the last step did; a step shorter than the scatter of what breaks
  /// when teaches nothing.
  void learn(const Round& now) {
    if (last_) {
      const Vector3d step = now.parameters - last_->parameters;
      const Vector3d change = now.figures - last_->figures;
      if (step.norm() > shortest_lesson)
        slopes_ += (change - slopes_ * step) * step.transpose() / step.squaredNorm();
    }
    last_ = now;
  }

  void tell_misses() {
    const CalibrationTargets& targets = request_.targets;
    const auto tell = [&](const char* name, const std::optional<double>& target,
                          std::optional<double> TensionFigures::*member, double tolerance) {
      const Spread reached = figure(member);
      if (miss(target, reached, tolerance) <= 1) return;
      found_.misses.push_back(fmt::format("{} = {:.5g}: {}", name, *target, reach(member)));
    };
    tell("yield_stress", targets.yield_stress, &TensionFigures::yield_stress,
         request_.tolerances.yield_stress);
    tell("peak_stress", targets.peak_stress, &TensionFigures::peak_stress,
         request_.tolerances.peak_stress);
    if (rupture_miss(figure(&TensionFigures::rupture_strain)) > 1) {
      const auto [low, high] = *targets.rupture_strain;
      found_.misses.push_back(fmt::format("rupture_strain = {:.4g} … {:.4g}: {}", low, high,
                                          reach(&TensionFigures::rupture_strain)));
    }
  }

  /// What the rounds gave, at their two extremes, with the parameters that gave it.
  std::string reach(std::optional<double> TensionFigures::*member) const {
    const CalibrationTrial *lowest = nullptr, *highest = nullptr;
    double low = 0, high = 0;
    for (const CalibrationTrial& trial : found_.trials) {
      std::vector<std::optional<double>> values;
      for (const BodyFigures& figures : trial.figures) values.push_back(figures.tension.*member);
      const Spread shown = spread(values);
      if (!trial.is_dynamic || shown.count == 0) continue;
      if (lowest == nullptr || shown.mean < low) lowest = &trial, low = shown.mean;
      if (highest == nullptr || shown.mean > high) highest = &trial, high = shown.mean;
    }
    if (lowest == nullptr) return "no specimen showed it in any round";
    const auto with = [](const CalibrationTrial& trial) {
      std::string text;
      if (const LinearHardening* law = linear_hardening(trial.bonds))
        text = fmt::format("yield_strain {:.4g}, hardening_ratio {:.4g}", law->yield_strain,
                           law->hardening_ratio);
      if (const std::optional<double> strain = rupture_strain(trial.bonds))
        text += fmt::format("{}rupture strain {:.4g}", text.empty() ? "" : ", ", *strain);
      return text;
    };
    return fmt::format("the rounds gave {:.5g} ({}) to {:.5g} ({})", low, with(*lowest), high,
                       with(*highest));
  }

  // --- both

  void note(CalibrationTrial trial, Clock::time_point start) {
    trial.seconds = seconds_since(start);
    note(std::move(trial));
  }

  void note(CalibrationTrial trial) {
    if (tell_) tell_(trial);
    found_.trials.push_back(std::move(trial));
  }

  const CalibrationRequest& request_;
  const std::vector<Material>& materials_;
  TensionBench bench_;
  const std::function<void(const CalibrationTrial&)>& tell_;
  Calibration found_;
  Matrix3d slopes_ = first_slopes();
  std::optional<Round> last_;
  bool rupture_is_sought_ = false;
};

}  // namespace

Spread spread(const std::vector<std::optional<double>>& values) {
  Spread result;
  for (const std::optional<double>& value : values)
    if (value) result.mean += *value, ++result.count;
  if (result.count == 0) return result;
  result.mean /= static_cast<double>(result.count);
  double squares = 0;
  for (const std::optional<double>& value : values)
    if (value) squares += (*value - result.mean) * (*value - result.mean);
  if (result.count > 1)
    result.deviation = std::sqrt(squares / static_cast<double>(result.count - 1));
  return result;
}

std::vector<std::pair<std::string, Spread>> spreads(const std::vector<BodyFigures>& figures) {
  std::vector<std::optional<double>> values[5];
  for (const BodyFigures& body : figures) {
    values[0].emplace_back(body.elastic.young_modulus);
    values[1].emplace_back(body.elastic.poisson_ratio);
    values[2].push_back(body.tension.yield_stress);
    values[3].push_back(body.tension.peak_stress);
    values[4].push_back(body.tension.rupture_strain);
  }
  const char* names[] = {"young_modulus", "poisson_ratio", "yield_stress", "peak_stress",
                         "rupture_strain"};
  std::vector<std::pair<std::string, Spread>> result;
  for (int k = 0; k < 5; ++k)
    if (const Spread of_all = spread(values[k]); of_all.count > 0)
      result.emplace_back(names[k], of_all);
  return result;
}

std::vector<Spread> curve_spreads(const std::vector<BodyFigures>& figures) {
  std::vector<Spread> spreads;
  for (std::size_t k = 0; k < figures.front().stresses.size(); ++k) {
    std::vector<std::optional<double>> values;
    for (const BodyFigures& body : figures)
      values.push_back(std::isnan(body.stresses[k]) ? std::nullopt
                                                    : std::optional<double>(body.stresses[k]));
    spreads.push_back(spread(values));
  }
  return spreads;
}

Calibration calibrate(const CalibrationRequest& request, const BondParameters& start,
                      const std::vector<Material>& materials, const std::optional<Gauge>& gauge,
                      const std::vector<Specimen>& specimens,
                      const std::function<void(const CalibrationTrial&)>& tell) {
  return Search(request, start, materials, gauge, specimens, tell).run();
}

}  // namespace solidem
