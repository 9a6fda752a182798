// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/relative_conductivity.hpp"

#include <algorithm>
#include <cmath>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "model/error.hpp"

namespace solidem {

namespace {

int bar_axis(const Domain& domain) {
  if (domain.axis >= 0) return domain.axis;
  const Vector extent = domain.upper - domain.lower;
  int longest = -1;
  for (int axis = 0; axis < 3; ++axis)
    if (!domain.periodic[static_cast<std::size_t>(axis)] &&
        (longest < 0 || component(extent, axis) > component(extent, longest)))
      longest = axis;
  return longest;
}

/// Steady temperatures with the elements of `fixed` (NaN: free) held.
Eigen::VectorXd steady(const ConductionGeometry& geometry, const Specimen& specimen,
                       const Eigen::VectorXd& fixed) {
  const auto size = static_cast<Eigen::Index>(specimen.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size);
  const auto is_free = [&](Eigen::Index i) { return std::isnan(fixed[i]); };
  const auto add = [&](Eigen::Index i, Eigen::Index j, double conductance) {
    if (!is_free(i)) return;
    entries.emplace_back(i, i, conductance);
    if (is_free(j))
      entries.emplace_back(i, j, -conductance);
    else
      load[i] += conductance * fixed[j];
  };
  for (const Pair& pair : specimen.bonds) {
    const HeatPath path = geometry.path(specimen, pair);
    add(pair.i, pair.j, path.area / path.distance);
    add(pair.j, pair.i, path.area / path.distance);
  }
  for (Eigen::Index i = 0; i < size; ++i)
    if (!is_free(i)) {
      entries.emplace_back(i, i, 1.0);
      load[i] = fixed[i];
    }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-12);
  solver.compute(matrix);
  Eigen::VectorXd start = fixed.unaryExpr([](double t) { return std::isnan(t) ? 0.5 : t; });
  Eigen::VectorXd temperature = solver.solveWithGuess(load, start);
  if (solver.info() != Eigen::Success)
    throw InputError(
        "[conduction] law = \"platonic-calibrated\": the steady bar test found no "
        "solution; give area_factor");
  return temperature;
}

}  // namespace

double relative_conductivity(const ConductionGeometry& geometry, const Specimen& specimen) {
  const Domain& domain = specimen.domain;
  if (domain.shape == "imported")
    throw InputError(
        "[conduction] law = \"platonic-calibrated\": the specimen's file does not say what shape "
        "its "
        "body has, which the steady bar test needs; give [specimen] shape and its measures, or "
        "area_factor");
  if (!domain.has_walls() || domain.is_sphere())
    throw InputError(
        "[conduction] law = \"platonic-calibrated\": the steady bar test needs a body with one "
        "section from end to end, not a sphere, a mesh, several bodies or one with cuts; give "
        "area_factor");
  const int axis = bar_axis(domain);
  if (axis < 0 || domain.periodic[static_cast<std::size_t>(axis)])
    throw InputError(
        "[conduction] law = \"platonic-calibrated\": a body that is periodic along its "
        "length has no ends for the steady bar test; give area_factor");
  const double low = component(domain.lower, axis), high = component(domain.upper, axis);
  const double layer = 2 * mean_radius(specimen);
  const auto place = [&](Eigen::Index i) {
    return component(specimen.position[static_cast<std::size_t>(i)], axis);
  };
  const auto size = static_cast<Eigen::Index>(specimen.size());
  Eigen::VectorXd fixed = Eigen::VectorXd::Constant(size, std::nan(""));
  for (Eigen::Index i = 0; i < size; ++i) {
    if (place(i) - low <= layer) fixed[i] = 0;
    if (high - place(i) <= layer) fixed[i] = 1;
  }
  const Eigen::VectorXd temperature = steady(geometry, specimen, fixed);

  // The middle half: its mean flux, by what each pair carries over the length that it spans there,
  // and its gradient, by a line through the temperatures.
  const double from = low + 0.25 * (high - low), to = high - 0.25 * (high - low);
  double carried = 0;
  std::vector<bool> conducts(specimen.size(), false);
  for (const Pair& pair : specimen.bonds) {
    conducts[static_cast<std::size_t>(pair.i)] = conducts[static_cast<std::size_t>(pair.j)] = true;
    const double a = place(pair.i), b = place(pair.j);
    const double span = std::clamp(b, from, to) - std::clamp(a, from, to);
    const HeatPath path = geometry.path(specimen, pair);
    carried += path.area / path.distance * (temperature[pair.j] - temperature[pair.i]) * span;
  }
  const double flux = carried / (to - from) / domain.cross_section(axis);
  double count = 0, sum_x = 0, sum_t = 0, sum_xx = 0, sum_xt = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    const double x = place(i), t = temperature[i];
    if (x < from || x > to || !conducts[static_cast<std::size_t>(i)]) continue;
    ++count, sum_x += x, sum_t += t, sum_xx += x * x, sum_xt += x * t;
  }
  const double gradient = (count * sum_xt - sum_x * sum_t) / (count * sum_xx - sum_x * sum_x);
  if (!(flux > 0) || !(gradient > 0))
    throw InputError(
        "[conduction] law = \"platonic-calibrated\": no heat passes from end to end "
        "along " +
        std::string(1, "xyz"[axis]) +
        "; expected a body of several layers of bonded elements, or area_factor");
  return flux / gradient;
}

}  // namespace solidem
