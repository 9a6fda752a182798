// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/energy_guard.hpp"

#include <algorithm>

namespace solidem {

namespace {

// Velocities are half a step behind and the integrator swings a little about the energy.
constexpr double factor = 2;
// Looking costs as much as some steps: not again before there is more to vouch for.
constexpr double growth_before_next_look = 1.1;

}  // namespace

std::optional<double> EnergyGuard::paid_too_little(const EnergyInMotion& motion,
                                                   const std::function<double()>& stored) const {
  double paid = std::max(largest_, motion.put_in);
  const double moving = motion.kinetic + motion.spent;
  const auto suffices = [&] { return moving <= factor * paid + round_off_; };
  if (stored) paid -= initially_stored_;
  if (suffices()) return {};
  if (stored) {
    if (moving <= growth_before_next_look * vouched_) return {};
    paid += std::max(0.0, initially_stored_ - stored());
    if (suffices()) {
      vouched_ = moving;
      return {};
    }
  }
  return paid;
}

void EnergyGuard::note(double put_in) {
  largest_ = std::max(largest_, put_in);
}

}  // namespace solidem
