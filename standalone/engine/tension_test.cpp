// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/tension_test.hpp"

#include <algorithm>
#include <cmath>

#include "effects/beam_parameters.hpp"
#include "effects/grip_parameters.hpp"
#include "effects/initial_velocities.hpp"
#include "engine/simulation.hpp"

namespace solidem {

namespace {

constexpr double proof_strain = 0.002;
constexpr double fraction_left_at_rupture = 0.5;

GripParameters grip(const char* name, const TensileBar& bar, bool high_side, double speed) {
  GripParameters grip;
  grip.name = name;
  grip.region.kind = Region::Kind::face;
  grip.region.axis = bar.gauge.axis;
  grip.region.high_side = high_side;
  grip.region.depth = bar.grip_depth;
  grip.axis[static_cast<std::size_t>(bar.gauge.axis)] = {AxisControl::Kind::velocity,
                                                         TimeFunction::constant(speed)};
  grip.rotation_fixed = false;
  return grip;
}

/// Length between the ends that are held.
double free_length(const Domain& domain, const TensileBar& bar) {
  return component(domain.upper - domain.lower, bar.gauge.axis) - 2 * bar.grip_depth;
}

/// Every centre moves as in a uniform stretching of the bar, the middle of which has half the
/// speed.
InitialVelocity steady_stretching(const Domain& domain, const TensionTest& test) {
  const double rate = test.speed / free_length(domain, test.bar);
  const double thinning = -rate * test.elastic.poisson_ratio;
  InitialVelocity initial;
  initial.velocity = {};
  initial.stretching = {thinning, thinning, thinning};
  component(initial.velocity, test.bar.gauge.axis) = 0.5 * test.speed;
  component(initial.stretching, test.bar.gauge.axis) = rate;
  return initial;
}

Setup setup_of(const BondParameters& bonds, const Specimen& specimen, const TensionTest& test) {
  Setup setup;
  setup.materials = test.materials;
  setup.get<BeamParameters>() = bonds.beams;
  setup.get<PlasticityParameters>() = bonds.plasticity;
  setup.get<RuptureParameters>() = bonds.rupture;
  setup.get<ContactParameters>() = bonds.contact;
  setup.all<GripParameters>() = {grip("low", test.bar, false, 0),
                                 grip("high", test.bar, true, test.speed)};
  setup.gauge = test.bar.gauge;
  setup.all<InitialVelocity>() = {steady_stretching(specimen.domain, test)};
  setup.run.steps = 1;  // the test decides when it ends
  setup.run.time_step_ratio = test.time_step_ratio;
  return setup;
}

double find(const HistoryRow& row, const char* name) {
  for (const auto& [key, value] : row.values)
    if (key == name) return value;
  return std::nan("");
}

/// Where a line through two points has the ordinate zero, as a fraction of the way.
double crossing(double before, double after) {
  return before / (before - after);
}

}  // namespace

TensionFigures figures_of(const std::vector<TensionPoint>& points, double young_modulus) {
  TensionFigures figures;
  const auto beyond = [&](const TensionPoint& p) {
    return p.stress - young_modulus * (p.strain - proof_strain);
  };
  double peak = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const TensionPoint& p = points[k];
    peak = std::max(peak, p.stress);
    if (k == 0) continue;
    const TensionPoint& q = points[k - 1];
    const double left = fraction_left_at_rupture * peak;
    if (p.stress < left && q.stress >= left) {  // the fall is no yield
      figures.rupture_strain =
          q.elongation + crossing(q.stress - left, p.stress - left) * (p.elongation - q.elongation);
      break;
    }
    if (!figures.yield_stress && beyond(q) > 0 && beyond(p) <= 0)
      figures.yield_stress = q.stress + crossing(beyond(q), beyond(p)) * (p.stress - q.stress);
  }
  if (peak > 0) figures.peak_stress = peak;
  return figures;
}

TensionCurve pull(const BondParameters& bonds, const Specimen& specimen, const TensionTest& test) {
  Simulation simulation(setup_of(bonds, specimen, test), specimen);
  const double elongation_per_step =
      std::abs(test.speed) * simulation.time_step().value / free_length(specimen.domain, test.bar);
  const double sign = std::copysign(1.0, test.speed);
  TensionCurve curve;
  double peak = 0;
  while (true) {
    const HistoryRow row = simulation.observe();
    const TensionPoint point{elongation_per_step * static_cast<double>(simulation.step()),
                             sign * find(row, "gauge.strain"), sign * find(row, "gauge.stress")};
    curve.points.push_back(point);
    peak = std::max(peak, point.stress);
    const bool is_broken = peak > 0 && simulation.step() > 0 && point.elongation > proof_strain &&
                           point.stress < fraction_left_at_rupture * peak;
    if (is_broken || point.elongation >= test.longest_elongation ||
        point.strain >= test.longest_strain)
      break;
    const double interval = point.elongation < test.fine_elongation ? 1e-4 : 1e-3;
    simulation.advance(std::max<std::int64_t>(1, std::llround(interval / elongation_per_step)));
  }
  curve.figures = figures_of(curve.points, test.elastic.young_modulus);
  return curve;
}

}  // namespace solidem
