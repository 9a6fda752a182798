// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/energy_gained.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace solidem {

namespace {
constexpr double noticeable = 0.02;
}

std::optional<std::string> note_on_gained_energy(const HistoryRow& row, double round_off) {
  double largest = 0;
  for (const auto& [name, value] : row.values) {
    if (name != "energy_balance") {
      largest = std::max(largest, std::abs(value));  // the energies stand before their balance
      continue;
    }
    if (value <= std::max(noticeable * largest, round_off)) return std::nullopt;
    return fmt::format(
        "{:.3g} J came from nothing (energy_balance), beside {:.3g} J in the largest form of "
        "energy: steps were too long for what elements met; take a smaller time_step_ratio",
        value, largest);
  }
  return std::nullopt;
}

}  // namespace solidem
