// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[grips]] and [[initial_velocities]].
#include <algorithm>
#include <memory>

#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

/// What one of displacement, velocity and force imposes along x, y and z.
Rule controls(std::array<AxisControl, 3>& axes, AxisControl::Kind kind,
              const Dimension& dimension) {
  const std::string expected = describe(dimension, anything) + ", a function of time, or \"free\"";
  return triple(expected, [&axes, kind, dimension, expected](const Value& entry, int k) {
    const toml::node& node = entry.node();
    if (node.is_string() && node.as_string()->get() == "free") return;
    AxisControl& control = axes[static_cast<std::size_t>(k)];
    if (control.kind != AxisControl::Kind::free)
      entry.refuse(std::string("the grip is controlled twice along ") + "xyz"[k],
                   "\"free\" in all but one of displacement, velocity and force");
    control = {kind, read_function(entry, dimension, anything)};
  });
}

GripParameters read_grip(const Section& section, const NamedRegions& named,
                         std::set<std::string>& taken) {
  using Kind = AxisControl::Kind;
  GripParameters grip;
  section.read(
      {must_have("name", name(grip.name, taken)), must_have("region", region(grip.region, named)),
       may_have("displacement", controls(grip.axis, Kind::displacement, dimension::length)),
       may_have("velocity", controls(grip.axis, Kind::velocity, dimension::velocity)),
       may_have("force", controls(grip.axis, Kind::force, dimension::force)),
       may_have("rotation",
                choice<bool>(grip.rotation_fixed, {{"fixed", true}, {"free", false}}))});
  const bool holds_an_axis =
      std::any_of(grip.axis.begin(), grip.axis.end(),
                  [](const AxisControl& control) { return control.kind != Kind::free; });
  if (!holds_an_axis && !grip.rotation_fixed)
    section.refuse("the grip does nothing",
                   "a displacement, velocity or force, or rotation = \"fixed\"");
  return grip;
}

}  // namespace

Rule grips_section(std::vector<GripParameters>& grips, const NamedRegions& named) {
  const auto taken = std::make_shared<std::set<std::string>>();
  return tables([&grips, &named, taken](const Section& section) {
    grips.push_back(read_grip(section, named, *taken));
  });
}

Rule initial_velocities_section(std::vector<InitialVelocity>& velocities,
                                const NamedRegions& named) {
  return tables([&velocities, &named](const Section& section) {
    InitialVelocity initial;
    section.read({must_have("region", region(initial.region, named)),
                  may_have("velocity", vector(initial.velocity, dimension::velocity)),
                  may_have("stretching", vector(initial.stretching, dimension::rate))});
    if (!section.has("velocity") && !section.has("stretching"))
      section.refuse("nothing says how the elements move", "velocity or stretching, or both");
    velocities.push_back(initial);
  });
}

}  // namespace solidem
