// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/heat/explicit_euler.hpp"

#include <cmath>
#include <limits>

namespace solidem {

bool ExplicitEuler::step(HeatBody& body, const HeatState& from, double h, double,
                         std::vector<double>& received) {
  received.resize(body.size());
  for (std::size_t i = 0; i < received.size(); ++i) received[i] = h * from.power[i];
  return true;
}

double ExplicitEuler::error(HeatBody& body, const HeatState& from, const HeatState& to, double h,
                            const std::vector<double>&) {
  return largest_of_free(body, [&](std::size_t i) {
    return 0.5 * h * (to.power[i] - from.power[i]) / body.capacity(to, i);
  });
}

double ExplicitEuler::longest_step(HeatBody& body, const HeatState& from) const {
  return 0.9 * body.stable_step(from);
}

double ExplicitEuler::work(HeatBody&, const HeatState&, double) {
  return 1;
}

}  // namespace solidem
