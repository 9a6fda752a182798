// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/orthotropic_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>

#include "effects/beam_parameters.hpp"
#include "effects/beam_properties.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// What is sought, as multiples of the start: the logarithm of each is a coordinate of the search.
struct Parameter {
  double lower, upper;  ///< where it makes sense
  std::function<double&(BeamParameters&)> of;
};

/// The parameters that the beams have. Moduli across the grain are sought as shares of E_L, so that
/// E_L scales them all.
std::vector<Parameter> parameters_of(const BeamParameters& beams) {
  using B = BeamParameters;
  std::vector<Parameter> list{
      {1e-300, 1e300, [](B& b) -> double& { return b.young_modulus; }},
      {1e-3, 1e2, [](B& b) -> double& { return b.anisotropy->radial_modulus; }},
      {1e-3, 1e2, [](B& b) -> double& { return b.anisotropy->tangential_modulus; }},
      {0.5, 32, [](B& b) -> double& { return b.anisotropy->exponent; }},
      {0.05, 1, [](B& b) -> double& { return b.radius_ratio; }}};
  if (beams.fibres)
    list.push_back({1e-2, 1e3, [](B& b) -> double& { return b.fibres->stiffness_ratio; }});
  return list;
}

/// Beams of which all moduli are shares of E_L, and back.
BeamParameters relative(BeamParameters beams) {
  Anisotropy& grain = *beams.anisotropy;
  grain.radial_modulus /= beams.young_modulus;
  grain.tangential_modulus /= beams.young_modulus;
  if (grain.transverse_shear_modulus) *grain.transverse_shear_modulus /= beams.young_modulus;
  beams.shear_modulus /= beams.young_modulus;
  return beams;
}
BeamParameters absolute(BeamParameters beams) {
  Anisotropy& grain = *beams.anisotropy;
  grain.radial_modulus *= beams.young_modulus;
  grain.tangential_modulus *= beams.young_modulus;
  if (grain.transverse_shear_modulus) *grain.transverse_shear_modulus *= beams.young_modulus;
  beams.shear_modulus *= beams.young_modulus;
  return beams;
}

Eigen::Matrix<double, 9, 1> as_vector(const NineConstants& nine) {
  return Eigen::Map<const Eigen::Matrix<double, 9, 1>>(nine.data());
}

Matrix6 sum(const Matrix6& a, double factor, const Matrix6& b) {
  Matrix6 result = a;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) result[i][j] += factor * b[i][j];
  return result;
}

/// How the nine constants of a stiffness change with it.
Eigen::Matrix<double, 9, 1> constants_rate(const Matrix6& stiffness, const Matrix6& rate) {
  double largest = 0, fastest = 1e-300;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j) {
      largest = std::max(largest, std::abs(stiffness[i][j]));
      fastest = std::max(fastest, std::abs(rate[i][j]));
    }
  const double step = 1e-6 * largest / fastest;
  const auto at = [&](double s) {
    return as_vector(nine_constants(orthotropic_constants(sum(stiffness, s, rate))));
  };
  return (at(step) - at(-step)) / (2 * step);
}

/// The mean constants of the specimens under one set of beams, and their derivatives by the
/// logarithms of the parameters.
struct Evaluation {
  BeamParameters beams;  ///< relative
  std::vector<EffectiveStiffness> measured;
  std::vector<OrthotropicConstants> reached;
  Eigen::Matrix<double, 9, 1> mean;
  Eigen::Matrix<double, 9, Eigen::Dynamic> rate;
};

class OrthotropicSearch {
 public:
  OrthotropicSearch(const OrthotropicRequest& request, const BeamParameters& start,
                    const std::vector<Specimen>& specimens)
      : request_(request), specimens_(specimens), parameters_(parameters_of(start)) {}

  /// `near`: an evaluation nearby, or null.
  Evaluation evaluate(const BeamParameters& beams, const Evaluation* near) const {
    Evaluation result;
    result.beams = beams;
    result.mean.setZero();
    const auto count = static_cast<Eigen::Index>(parameters_.size());
    result.rate = Eigen::Matrix<double, 9, Eigen::Dynamic>::Zero(9, count);
    const double fraction = 1.0 / static_cast<double>(specimens_.size());
    for (std::size_t k = 0; k < specimens_.size(); ++k) {
      const BeamNetwork network = beam_network(absolute(beams), specimens_[k]);
      result.measured.push_back(effective_stiffness(network, beams.anisotropy->axes,
                                                    near ? &near->measured[k] : nullptr));
      const EffectiveStiffness& measured = result.measured.back();
      result.reached.push_back(orthotropic_constants(measured.stiffness));
      result.mean += fraction * as_vector(nine_constants(result.reached.back()));
      for (Eigen::Index p = 0; p < count; ++p)
        result.rate.col(p) +=
            fraction * constants_rate(measured.stiffness,
                                      stiffness_rate(network, measured,
                                                     rigidity_rate(beams, specimens_[k],
                                                                   static_cast<std::size_t>(p))));
    }
    return result;
  }

  /// Weighted residuals of the targets, and their derivatives by the mean constants.
  void residuals(const Eigen::Matrix<double, 9, 1>& mean, Eigen::Matrix<double, 9, 1>& residual,
                 Eigen::Matrix<double, 9, 1>& slope) const {
    residual.setZero();
    slope.setZero();
    for (int c = 0; c < 9; ++c) {
      const auto& target = request_.target[static_cast<std::size_t>(c)];
      if (!target) continue;
      const double weight = request_.weight[static_cast<std::size_t>(c / 3)];
      residual[c] = weight * (c < 6 ? std::log(mean[c] / *target) : mean[c] / *target - 1);
      slope[c] = weight / (c < 6 ? mean[c] : *target);
    }
  }
  double misfit(const Evaluation& evaluation) const {
    Eigen::Matrix<double, 9, 1> residual, slope;
    residuals(evaluation.mean, residual, slope);
    return residual.norm();
  }

  /// The beams one damped step further.
  BeamParameters step(const Evaluation& from, double damping) const {
    Eigen::Matrix<double, 9, 1> residual, slope;
    residuals(from.mean, residual, slope);
    const Eigen::MatrixXd jacobian = slope.asDiagonal() * from.rate;
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal().array() += damping;
    const Eigen::VectorXd change = -normal.ldlt().solve(jacobian.transpose() * residual);
    BeamParameters beams = from.beams;
    for (std::size_t p = 0; p < parameters_.size(); ++p) {
      double& value = parameters_[p].of(beams);
      const double most = p == 0 ? 20 : 1;  // all else is proportional to E_L
      const double log_step = std::clamp(change[static_cast<Eigen::Index>(p)], -most, most);
      value = std::clamp(value * std::exp(log_step), parameters_[p].lower, parameters_[p].upper);
    }
    return beams;
  }

 private:
  /// Of each bond by the logarithm of a parameter.
  std::vector<BeamRigidity<double>> rigidity_rate(const BeamParameters& beams,
                                                  const Specimen& specimen,
                                                  std::size_t parameter) const {
    const double step = 1e-5;
    const auto at = [&](double s) {
      BeamParameters moved = beams;
      parameters_[parameter].of(moved) *= std::exp(s);
      return beam_network(absolute(moved), specimen).rigidity;
    };
    std::vector<BeamRigidity<double>> rate = at(step);
    const std::vector<BeamRigidity<double>> low = at(-step);
    for (std::size_t b = 0; b < rate.size(); ++b)
      rate[b] = {(rate[b].axial - low[b].axial) / (2 * step),
                 (rate[b].bending - low[b].bending) / (2 * step),
                 (rate[b].shear - low[b].shear) / (2 * step),
                 (rate[b].torsion - low[b].torsion) / (2 * step)};
    return rate;
  }

  const OrthotropicRequest& request_;
  const std::vector<Specimen>& specimens_;
  std::vector<Parameter> parameters_;
};

std::vector<std::string> misses_of(const OrthotropicRequest& request, const NineConstants& mean) {
  std::vector<std::string> misses;
  for (std::size_t c = 0; c < 9; ++c) {
    if (!request.target[c]) continue;
    const double target = *request.target[c], error = mean[c] / target - 1;
    if (std::abs(error) <= request.tolerance) continue;
    const double unit = c < 6 ? 1e9 : 1;
    misses.push_back(fmt::format(
        "{} = {:.4g}{}: nearest beside the other targets {:.4g} ({:+.0f} %)", constant_names[c],
        target / unit, c < 6 ? " GPa" : "", mean[c] / unit, 100 * error));
  }
  return misses;
}

}  // namespace

NineConstants nine_constants(const OrthotropicConstants& constants) {
  const auto& [e, g, nu, coupling] = constants;
  (void)coupling;
  return {e[0], e[1], e[2], g[0], g[1], g[2], nu[0], nu[1], nu[2]};
}

OrthotropicCalibration calibrate_orthotropic(
    const OrthotropicRequest& request, const BeamParameters& start,
    const std::vector<Specimen>& specimens,
    const std::function<void(const OrthotropicTrial&)>& tell) {
  if (!start.anisotropy)
    throw InputError("[calibration] nothing has a grain; expected a section [beams.anisotropy]");
  if (std::none_of(request.target.begin(), request.target.end(),
                   [](const auto& target) { return target.has_value(); }))
    throw InputError(
        "[calibration] no target is given; expected young_moduli, shear_moduli or poisson_ratios");
  const OrthotropicSearch search(request, start, specimens);
  OrthotropicCalibration result{};
  const auto note = [&](const Evaluation& evaluation) {
    result.trials.push_back(
        {absolute(evaluation.beams), evaluation.reached, search.misfit(evaluation)});
    if (tell) tell(result.trials.back());
  };
  Evaluation best = search.evaluate(relative(start), nullptr);
  note(best);
  // A long valley may lie before the lowest place: one short step is no reason to stop.
  double damping = 1e-2;
  int stalled = 0;
  for (int iteration = 0; iteration < request.iterations && stalled < 3; ++iteration) {
    const double before = search.misfit(best);
    if (before < 0.1 * request.tolerance) break;
    Evaluation next = search.evaluate(search.step(best, damping), &best);
    note(next);
    const double gain = before - search.misfit(next);
    stalled = gain > 2e-3 * before ? 0 : stalled + 1;
    if (gain > 0) best = std::move(next);
    damping = gain > 0 ? std::max(damping / 5, 1e-8) : damping * 10;
  }

  result.beams = absolute(best.beams);
  const auto count = static_cast<double>(specimens.size());
  for (std::size_t c = 0; c < 9; ++c) {
    result.mean[c] = best.mean[static_cast<Eigen::Index>(c)];
    double squares = 0;
    for (const OrthotropicConstants& own : best.reached)
      squares += std::pow(nine_constants(own)[c] - result.mean[c], 2);
    result.deviation[c] = count > 1 ? std::sqrt(squares / (count - 1)) : 0;
  }
  for (const OrthotropicConstants& own : best.reached)
    result.coupling = std::max(result.coupling, own.coupling);
  result.misses = misses_of(request, result.mean);
  return result;
}

}  // namespace solidem
