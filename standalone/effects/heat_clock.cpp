// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_clock.hpp"

#include <cmath>

namespace solidem {

std::optional<Step> HeatClock::pass(const Step& motion) {
  if (waiting_ == 0) since_ = motion.time;
  ++waiting_;
  passed_ += motion.time_step;
  constexpr double same = 1e-6;  // of a step: less is round-off
  const bool ends = std::fabs(motion.time + motion.time_step - duration_) < same * motion.time_step;
  if (waiting_ < every_ && !ends) return {};
  const Step step{since_, passed_, passed_};
  waiting_ = 0;
  passed_ = 0;
  return step;
}

void HeatClock::adapt(double change, const Step& motion) {
  constexpr double safety = 0.8, most_growth = 2, most_steps = 1e9;
  const double growth = change > 0 ? safety * *largest_change_ / change : most_growth;
  const double longest = std::min(most_steps, longest_ / motion.time_step);
  const double wanted =
      std::min(static_cast<double>(every_) * std::min(growth, most_growth), longest);
  every_ = static_cast<std::int64_t>(std::max(1.0, std::floor(wanted)));
}

}  // namespace solidem
