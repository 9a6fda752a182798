// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_APP_WITH_PREFIX_HPP
#define SOLIDEM_APP_WITH_PREFIX_HPP

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "output/svg_plot.hpp"

namespace solidem {

/// A value of so many digits for people, with the prefix of its unit that suits it.
inline std::string with_prefix(double value, const char* unit, int digits = 5) {
  if (value == 0) return fmt::format("0 {}", unit);
  const UnitPrefix prefix = unit_prefix(std::abs(value));
  return fmt::format("{:.{}g} {}{}", value / prefix.factor, digits, prefix.symbol, unit);
}

}  // namespace solidem

#endif
