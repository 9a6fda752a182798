// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/calibration/root_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/error.hpp"

namespace solidem {

namespace {

constexpr int most_secants = 4;       // without a bracket; then the range is looked through
constexpr int most_refinements = 60;  // halving alone needs no more for a double

class Search {
 public:
  Search(const std::function<double(double)>& function, double tolerance)
      : function_(function), tolerance_(tolerance) {}

  /// The function at a place, computed once.
  RootTrial at(double place) {
    for (const RootTrial& trial : result_.trials)
      if (trial.at == place) return trial;
    const RootTrial trial{place, function_(place)};
    if (result_.trials.empty() || std::abs(trial.value) < std::abs(result_.best.value))
      result_.best = trial;
    result_.trials.push_back(trial);
    return trial;
  }

  bool is_near_enough() const {
    return !result_.trials.empty() && std::abs(result_.best.value) <= tolerance_;
  }

  /// Two neighbouring trials of opposite sign, the pair nearest to the start of the search.
  std::optional<std::pair<RootTrial, RootTrial>> bracket() const {
    std::vector<RootTrial> sorted = result_.trials;
    std::sort(sorted.begin(), sorted.end(),
              [](const RootTrial& a, const RootTrial& b) { return a.at < b.at; });
    std::optional<std::pair<RootTrial, RootTrial>> nearest;
    const double start = result_.trials.front().at;
    double least = 0;
    for (std::size_t k = 0; k + 1 < sorted.size(); ++k) {
      if ((sorted[k].value > 0) == (sorted[k + 1].value > 0)) continue;
      const double far = std::abs(0.5 * (sorted[k].at + sorted[k + 1].at) - start);
      if (nearest && far >= least) continue;
      nearest = {sorted[k], sorted[k + 1]};
      least = far;
    }
    return nearest;
  }

  /// Secants until they end, bracket a root or leave the range for good.
  void extrapolate(RootRange range, double start, double slope) {
    RootTrial last = at(start);
    for (int k = 0; k < most_secants && !is_near_enough() && !bracket(); ++k) {
      const double step = slope != 0 ? -last.value / slope : 0;
      const double place = std::clamp(last.at + step, range.lower, range.upper);
      if (!std::isfinite(place) || place == last.at) return;
      const RootTrial next = at(place);
      slope = (next.value - last.value) / (next.at - last.at);
      last = next;
    }
  }

  void scan(RootRange range) {
    constexpr int pieces = 6;
    for (const int k : {0, pieces, 3, 2, 4, 1, 5}) {
      if (is_near_enough() || bracket()) return;
      at(k == pieces ? range.upper : range.lower + (range.upper - range.lower) * k / pieces);
    }
  }

  /// Secants between the ends of a bracket; an end that stays counts half.
  void refine(RootTrial a, RootTrial b) {
    int kept = 0;
    for (int k = 0; k < most_refinements && !is_near_enough(); ++k) {
      double place = (a.at * b.value - b.at * a.value) / (b.value - a.value);
      if (!(place > std::min(a.at, b.at) && place < std::max(a.at, b.at)))
        place = 0.5 * (a.at + b.at);
      const std::size_t before = result_.trials.size();
      const RootTrial next = at(place);
      if (result_.trials.size() == before) return;  // the bracket is as narrow as numbers are
      if ((next.value > 0) == (a.value > 0)) {
        a = next;
        if (kept > 0) b.value *= 0.5;
        kept = 1;
      } else {
        b = next;
        if (kept < 0) a.value *= 0.5;
        kept = -1;
      }
    }
  }

  RootSearch end() {
    result_.found = is_near_enough();
    return std::move(result_);
  }

 private:
  const std::function<double(double)>& function_;
  double tolerance_;
  RootSearch result_;
};

}  // namespace

RootSearch find_root(const std::function<double(double)>& function, RootRange range, double start,
                     double slope, double tolerance) {
  if (!(range.lower < range.upper) || !(range.lower <= start && start <= range.upper))
    throw InputError("a root is sought from " + std::to_string(start) + " in the range " +
                     std::to_string(range.lower) + " … " + std::to_string(range.upper) +
                     "; expected lower < upper and a start between them");
  Search search(function, tolerance);
  search.extrapolate(range, start, slope);
  if (!search.is_near_enough() && !search.bracket()) search.scan(range);
  if (const auto bracket = search.bracket(); bracket && !search.is_near_enough())
    search.refine(bracket->first, bracket->second);
  return search.end();
}

}  // namespace solidem
