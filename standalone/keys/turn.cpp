// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/turn.hpp"

#include <cmath>

#include "keys/rules.hpp"

namespace solidem {

namespace {

Rule axis_of_turn(Vector& target) {
  const std::string expected = "three numbers [x, y, z], not all zero";
  return {expected, [&target, expected](const Value& value) {
            const std::vector<Value> entries = value.entries(3, expected);
            for (int k = 0; k < 3; ++k)
              component(target, k) = read_number(entries[static_cast<std::size_t>(k)], anything);
            const double length = norm(target);
            if (!(length > 0) || !std::isfinite(length)) value.refuse("no direction", expected);
            target = (1 / length) * target;
          }};
}

}  // namespace

Rule turn(Quaternion<double>& target) {
  const std::string expected = "a turn { axis = [x, y, z], angle = \"30 degree\" }";
  return {expected, [&target, expected](const Value& value) {
            if (!value.node().is_table()) value.refuse("not a turn", expected);
            Vector axis{};
            double angle = 0;
            Section(value).read({must_have("axis", axis_of_turn(axis)),
                                 must_have("angle", quantity(angle, dimension::angle))},
                                "a turn");
            target = {std::cos(0.5 * angle), std::sin(0.5 * angle) * axis};
          }};
}

}  // namespace solidem
