// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/static_grips.hpp"

#include <algorithm>

#include "effects/grip_parameters.hpp"

namespace solidem {

void impose(const GripParameters& grip, const std::vector<std::int32_t>& elements,
            const std::vector<double>& mass, double time, GripConditions& conditions) {
  using Kind = AxisControl::Kind;
  double total = 0;
  for (const std::int32_t e : elements) total += mass[static_cast<std::size_t>(e)];
  for (const std::int32_t e : elements) {
    ElementLoad load{e, {}, {}};
    for (int axis = 0; axis < 3; ++axis) {
      const AxisControl& control = grip.axis[static_cast<std::size_t>(axis)];
      if (control.kind == Kind::displacement)
        conditions.constraints.push_back({e, axis, control.function(time)});
      if (control.kind == Kind::velocity)
        conditions.constraints.push_back({e, axis, control.function.integral(time)});
      if (control.kind == Kind::force)
        component(load.force, axis) =
            control.function(time) * mass[static_cast<std::size_t>(e)] / total;
    }
    if (dot(load.force, load.force) > 0) conditions.loads.push_back(load);
    for (int degree = 3; degree < 6 && grip.rotation_fixed; ++degree)
      conditions.constraints.push_back({e, degree, 0.0});
  }
}

GripAction grip_action(const std::vector<std::int32_t>& elements, const GripConditions& conditions,
                       const Specimen& specimen, const Equilibrium& equilibrium) {
  const double fraction = 1 / static_cast<double>(elements.size());
  GripAction action;
  Vector middle{};
  for (const std::int32_t e : elements) {
    middle += fraction * specimen.position[static_cast<std::size_t>(e)];
    action.displacement += fraction * equilibrium.displacement[static_cast<std::size_t>(e)];
  }
  const auto act = [&](std::int32_t e, const Vector& force, const Vector& moment) {
    const auto i = static_cast<std::size_t>(e);
    const Vector place = specimen.position[i] + equilibrium.displacement[i];
    action.force += force;
    action.moment += moment + cross(place - middle, force);
  };
  for (const std::int32_t e : elements)
    act(e, equilibrium.reaction[static_cast<std::size_t>(e)],
        equilibrium.reaction_moment[static_cast<std::size_t>(e)]);
  for (const ElementLoad& load : conditions.loads)
    if (std::find(elements.begin(), elements.end(), load.element) != elements.end())
      act(load.element, load.force, load.moment);
  return action;
}

}  // namespace solidem
