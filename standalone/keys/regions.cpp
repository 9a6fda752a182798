// SPDX-License-Identifier: GPL-2.0-or-later
#include "keys/regions.hpp"

#include <algorithm>

#include "keys/rules.hpp"

namespace solidem {

namespace {

const char* const any_region =
    "a region: {axis, side, depth or layers}, {lower, upper}, {set}, {body} or {all = true}";

Key body_key(std::string& target, const NamedRegions& named) {
  const Rule any = text(target);
  return may_have("body", {"the name of a [[body]]", [&target, &named, any](const Value& value) {
                             any.read(value);
                             const auto& known = named.bodies;
                             if (std::find(known.begin(), known.end(), target) != known.end())
                               return;
                             value.refuse(
                                 "no such body" + did_you_mean(target, known),
                                 known.empty() ? "a scene with [[body]]" : "one of " + join(known));
                           }});
}

void read_face(const Section& section, Region& region, const NamedRegions& named) {
  region.kind = Region::Kind::face;
  section.read({must_have("axis", axis(region.axis)),
                must_have("side", choice<bool>(region.high_side, {{"low", false}, {"high", true}})),
                may_have("depth", quantity(region.depth, dimension::length, positive)),
                may_have("layers", number(region.layers, positive)), body_key(region.body, named)},
               "a region at a face");
  section.exactly_one_of({"depth", "layers"});
}

/// Three lengths, "any" where the box is open.
Rule bound(Vector& target) {
  return triple("a length such as \"0.5 mm\" or \"any\"", [&target](const Value& entry, int k) {
    const toml::node& node = entry.node();
    if (node.is_string() && node.as_string()->get() == "any") return;  // stays infinite
    component(target, k) = read_quantity(entry, dimension::length, anything);
  });
}

void read_box(const Section& section, Region& region, const NamedRegions& named) {
  region.kind = Region::Kind::box;
  section.read({may_have("lower", bound(region.lower)), may_have("upper", bound(region.upper)),
                body_key(region.body, named)},
               "a region by a box");
  for (int k = 0; k < 3; ++k)
    if (component(region.upper, k) <= component(region.lower, k))
      section.refuse("upper", std::string("not above lower along ") + "xyz"[k],
                     "upper > lower along every axis");
}

void read_named(const Section& section, Region& region, const NamedRegions& named) {
  std::string name;
  section.read({must_have("set", text(name))}, "a region by a set");
  const auto found = named.of_scene.find(name);
  if (found != named.of_scene.end()) {
    region = found->second;
    return;
  }
  if (!named.specimen_is_file || name.empty()) {
    std::vector<std::string> names;
    for (const auto& entry : named.of_scene) names.push_back(entry.first);
    section.refuse("set", "no such set" + did_you_mean(name, names),
                   names.empty() ? "a set defined in [sets]" : "one of [sets]: " + join(names));
  }
  region.kind = Region::Kind::set;
  region.set = name;
}

void read_all(const Section& section, Region& region, const NamedRegions& named) {
  bool all = true;
  section.read({may_have("all", flag(all)), body_key(region.body, named)},
               "a region of all elements");
  if (!all) section.refuse("all", "a region of nothing", "all = true");
  region.kind = Region::Kind::all;
}

Region read_region(const Value& value, const NamedRegions& named) {
  if (!value.node().is_table()) value.refuse("not a region", any_region);
  const Section section(value);
  const auto has_one_of = [&section](const std::vector<std::string>& keys) {
    return std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return section.has(key); });
  };
  Region region;
  if (has_one_of({"set"}))
    read_named(section, region, named);
  else if (has_one_of({"lower", "upper"}))
    read_box(section, region, named);
  else if (has_one_of({"axis", "side", "depth", "layers"}))
    read_face(section, region, named);
  else if (has_one_of({"all", "body"}))
    read_all(section, region, named);
  else
    value.refuse("not a region", any_region);
  return region;
}

}  // namespace

Rule region(Region& target, const NamedRegions& named) {
  return {any_region,
          [&target, &named](const Value& value) { target = read_region(value, named); }};
}

Rule sets_section(NamedRegions& named) {
  return table([&named](const Section& section) {
    const NamedRegions of_file{{}, named.specimen_is_file, named.bodies};
    std::map<std::string, Region> regions;
    section.for_each([&](const std::string& name, const Value& value) {
      regions[name] = read_region(value, of_file);
    });
    named.of_scene = std::move(regions);
  });
}

}  // namespace solidem
