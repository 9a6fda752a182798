// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate_curve.hpp"

#include <fmt/format.h>

#include <cmath>

namespace solidem {

namespace {

using Json = nlohmann::ordered_json;

/// A point that some specimen reached; what not all did is no mean.
bool is_reached(const Spread& stress, std::size_t specimens) {
  return stress.count == specimens;
}

double miss_of(const Spread& stress, const FlowPoint& wanted) {
  return stress.mean / wanted.stress - 1;
}

}  // namespace

std::string text_of_curve(const CurveTarget& target, const std::vector<BodyFigures>& figures) {
  const std::vector<Spread> stresses = curve_spreads(figures);
  std::string text;
  double worst = -1;
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    if (!is_reached(stresses[k], figures.size()))
      return fmt::format("  never at a strain of {:.4g}", target.points[k].strain);
    const double miss = miss_of(stresses[k], target.points[k]);
    if (std::abs(miss) <= worst) continue;
    worst = std::abs(miss);
    text = fmt::format("  {:+.1f} % at a strain of {:.4g}", 100 * miss, target.points[k].strain);
  }
  return text;
}

void print_curve(const CurveTarget& target, const std::vector<BodyFigures>& figures,
                 const Voice& tell) {
  const std::vector<Spread> stresses = curve_spreads(figures);
  tell("\n{:>10} {:>12} {:>12} {:>10}\n", "strain", "wanted, MPa", "reached, MPa", "miss");
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    const FlowPoint& wanted = target.points[k];
    tell("{:>10.4g} {:>12.5g}", wanted.strain, wanted.stress / 1e6);
    if (!is_reached(stresses[k], figures.size())) {
      tell(" {:>12}\n", "never");
      continue;
    }
    tell(" {:>12.5g} {:>+8.2f} %", stresses[k].mean / 1e6, 100 * miss_of(stresses[k], wanted));
    if (figures.size() > 1) tell("  ± {:.2g} MPa", stresses[k].deviation / 1e6);
    tell("\n");
  }
}

Json curve_json(const CurveTarget& target, const std::vector<BodyFigures>& figures) {
  const std::vector<Spread> stresses = curve_spreads(figures);
  Json points = Json::array();
  for (std::size_t k = 0; k < stresses.size(); ++k) {
    Json point = {{"strain", target.points[k].strain},
                  {"wanted", target.points[k].stress},
                  {"reached", nullptr}};
    if (is_reached(stresses[k], figures.size())) {
      point["reached"] = stresses[k].mean;
      point["miss"] = miss_of(stresses[k], target.points[k]);
      if (figures.size() > 1) point["deviation"] = stresses[k].deviation;
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace solidem
