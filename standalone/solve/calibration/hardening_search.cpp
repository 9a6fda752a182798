// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/hardening_search.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/Core>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace solidem {

namespace {

/// What bodies of touching elements bear in the flow, over what their bonds bear times E of the
/// body over that of the bonds. Where the first test begins.
constexpr double usual_gain = 2;
/// Holds parameters where they are that the points of a curve do not tell.
constexpr double inertia = 5e-3;
/// Logarithm of a yield strain over another.
constexpr double farther_than_any = 100;
/// Tests in a row that bring nothing, after which a search ends.
constexpr std::size_t patience = 3;

/// What a search may change: all that the law names and that is not 0.
template <class Law>
std::vector<double*> shape_of(Law& law) {
  std::vector<double*> shape;
  for (const auto& parameter : Law::parameters())
    if (law.*parameter.member > 0) shape.push_back(&(law.*parameter.member));
  return shape;
}
std::vector<double*> shape_of(JohnsonCook& law) {
  return {&law.yield_strain, &law.hardening_strain, &law.hardening_exponent};
}
std::vector<double*> shape_of(YieldLaw& any) {
  return std::visit([](auto& law) { return shape_of(law); }, any);
}

/// Parameters of a law that rises from one yield strain to another within a plastic strain; of a
/// law that is not known here the yield strain alone.
template <class Law>
void start(Law& law, double first, double /*last*/, double /*plastic*/) {
  law.yield_strain = first;
}
void start(LinearHardening& law, double first, double last, double plastic) {
  law.yield_strain = first;
  law.hardening_ratio = (last - first) / plastic;
}
void start(VoceHardening& law, double first, double last, double plastic) {
  law.yield_strain = first;
  law.saturation_strain = last - first;
  law.plastic_scale = 0.3 * plastic;
}
void start(JohnsonCook& law, double first, double last, double plastic) {
  law.yield_strain = 0.8 * first;
  law.hardening_exponent = 0.3;
  law.hardening_strain = (last - law.yield_strain) / std::pow(plastic, law.hardening_exponent);
}

YieldLaw started(YieldLaw any, const std::vector<double>& plastic,
                 const std::vector<double>& yield) {
  const double first = yield.front(), last = std::max(yield.back(), 1.01 * first);
  std::visit([&](auto& law) { start(law, first, last, plastic.back()); }, any);
  return any;
}

/// The yield strain at rest and cold.
double yield_strain(const YieldLaw& any, double plastic_strain) {
  return std::visit(
      [&](const auto& law) { return law.limit(plastic_strain, YieldState<double>{}); }, any);
}

/// Logarithms of the parameters, and a law with others.
Eigen::VectorXd coordinates(YieldLaw law) {
  const std::vector<double*> shape = shape_of(law);
  Eigen::VectorXd at(static_cast<Eigen::Index>(shape.size()));
  for (std::size_t k = 0; k < shape.size(); ++k)
    at[static_cast<Eigen::Index>(k)] = std::log(*shape[k]);
  return at;
}
YieldLaw moved(YieldLaw law, const Eigen::VectorXd& to) {
  const std::vector<double*> shape = shape_of(law);
  for (std::size_t k = 0; k < shape.size(); ++k)
    *shape[k] = std::exp(to[static_cast<Eigen::Index>(k)]);
  return law;
}

bool goes_together(const YieldLaw& any) {
  return std::visit([](const auto& law) { return law.complaint() == nullptr; }, any);
}

/// What a law misses, as Eigen's least squares ask for it. Parameters that do not go together miss
/// by more than any others.
struct Misses {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  // NOLINTNEXTLINE(readability-identifier-naming): Eigen's names
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const YieldLaw& law;
  const Eigen::VectorXd from;
  const std::vector<double>& plastic;
  const std::vector<double>& yield;

  int inputs() const { return static_cast<int>(from.size()); }
  int values() const { return static_cast<int>(plastic.size()) + inputs(); }
  int operator()(const Eigen::VectorXd& at, Eigen::VectorXd& misses) const {
    const YieldLaw trial = moved(law, at);
    if (!goes_together(trial)) {
      misses.setConstant(farther_than_any);
      return 0;
    }
    const auto count = static_cast<Eigen::Index>(plastic.size());
    for (std::size_t k = 0; k < plastic.size(); ++k)
      misses[static_cast<Eigen::Index>(k)] = std::log(yield_strain(trial, plastic[k]) / yield[k]);
    misses.tail(misses.size() - count) = inertia * (at - from);
    return 0;
  }
};

double worst_miss(const CurveTarget& target, const std::vector<double>& stresses) {
  double worst = 0;
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    const double miss = std::abs(stresses[k] / target.points[k].stress - 1);
    worst = std::isnan(miss) ? HUGE_VAL : std::max(worst, miss);
  }
  return worst;
}

std::vector<double> over(std::vector<double> values, const std::vector<double>& divisors) {
  for (std::size_t k = 0; k < values.size(); ++k) values[k] /= divisors[k];
  return values;
}

}  // namespace

std::vector<HardeningParameter> hardening_parameters(const YieldLaw& law) {
  YieldLaw own = law;
  const std::vector<double*> shape = shape_of(own);
  std::vector<HardeningParameter> list;
  std::visit(
      [&](auto& known) {
        for (const auto& parameter : known.parameters())
          if (const double* value = &(known.*parameter.member);
              std::find(shape.begin(), shape.end(), value) != shape.end())
            list.push_back({parameter.name, *value});
      },
      own);
  return list;
}

YieldLaw slow_and_cold(const YieldLaw& law) {
  YieldLaw bare = law;
  if (auto* johnson_cook = std::get_if<JohnsonCook>(&bare)) {
    JohnsonCook only;
    only.yield_strain = johnson_cook->yield_strain;
    only.hardening_strain = johnson_cook->hardening_strain;
    only.hardening_exponent = johnson_cook->hardening_exponent;
    *johnson_cook = only;
  }
  return bare;
}

YieldLaw fitted(const YieldLaw& law, const std::vector<double>& plastic_strains,
                const std::vector<double>& yield_strains) {
  Eigen::VectorXd at = coordinates(law);
  Eigen::NumericalDiff<Misses> misses(Misses{law, at, plastic_strains, yield_strains});
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Misses>> search(misses);
  search.minimize(at);
  return moved(law, at);
}

HardeningSearch find_hardening(const CurveTarget& target, double young_modulus,
                               const YieldLaw& form, int most_tests, const CurveTest& test) {
  std::vector<double> plastic, wanted;
  for (const FlowPoint& point : target.points) {
    plastic.push_back(lasting_strain(point, young_modulus));
    wanted.push_back(point.stress / young_modulus);
  }
  std::vector<double> gain(wanted.size(), usual_gain);
  YieldLaw law = started(form, plastic, over(wanted, gain));
  HardeningSearch best;
  for (std::size_t n = 0; n < static_cast<std::size_t>(most_tests); ++n) {
    law = fitted(law, plastic, over(wanted, gain));
    const std::vector<double> stresses = test(law);
    const double worst = worst_miss(target, stresses);
    if (n == 0 || worst < best.worst) best = {law, stresses, worst, n};
    if (worst <= target.tolerance || n >= best.test + patience) break;
    for (std::size_t k = 0; k < gain.size(); ++k)
      if (const double shown = stresses[k] / young_modulus / yield_strain(law, plastic[k]);
          shown > 0)
        gain[k] = shown;
  }
  return best;
}

}  // namespace solidem
