// SPDX-License-Identifier: GPL-2.0-or-later
//
// [[temperatures]], [[heat_fluxes]], [[convections]] and [[heat_sources]].
#include <memory>

#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

namespace {

Rule wall(std::string& place) {
  return {"the name of a wall of the body such as \"x_low\" or \"side\"",
          [&place](const Value& value) {
            place = read_text(value, "the name of a wall such as \"x_low\"");
          }};
}

Shape::Part read_part(const Value& value) {
  using Kind = Shape::Kind;
  const Section section(value);
  Shape::Part part;
  const Key kind = must_have("kind", choice<Kind>(part.kind, {{"sphere", Kind::sphere},
                                                              {"cylinder", Kind::cylinder},
                                                              {"box", Kind::box}}));
  section.read_one(kind);
  std::vector<Key> keys = {kind, may_have("offset", vector(part.offset, dimension::length)),
                           may_have("cut_out", flag(part.is_cut_out))};
  const Key radius = must_have("radius", quantity(part.radius, dimension::length, positive));
  if (part.kind == Kind::box) {
    keys.push_back(must_have("size", vector(part.size, dimension::length, positive)));
  } else {
    keys.push_back(radius);
  }
  if (part.kind == Kind::cylinder) {
    keys.push_back(may_have("axis", axis(part.axis)));
    keys.push_back(may_have("length", quantity(part.length, dimension::length, positive)));
  }
  section.read(keys, "a shape of this kind");
  return part;
}

Rule shape(std::optional<Shape>& place) {
  const std::string expected =
      "{ kind = \"sphere\", \"cylinder\" or \"box\", ... }, or an array of these";
  return {expected, [&place, expected](const Value& value) {
            Shape read;
            if (value.node().is_table()) {
              read.parts.push_back(read_part(value));
            } else {
              for (const Value& entry : value.entries(-1, expected))
                read.parts.push_back(read_part(entry));
              if (read.parts.empty()) value.refuse("empty", expected);
              if (read.parts.front().is_cut_out)
                value.refuse("begins with a cut-out", "a solid before what is cut out of it");
            }
            place = read;
          }};
}

/// A path that starts at a place and goes on straight at a velocity.
std::array<TimeFunction, 3> straight(const Vector& start, const Vector& velocity) {
  // A table that ends so late (30 years) that no run comes there.
  constexpr double late = 1e9;
  std::array<TimeFunction, 3> path;
  for (int k = 0; k < 3; ++k) {
    const double from = component(start, k), speed = component(velocity, k);
    path[static_cast<std::size_t>(k)] = speed == 0
                                            ? TimeFunction::constant(from)
                                            : TimeFunction{{0, late}, {from, from + speed * late}};
  }
  return path;
}

HeatSourceParameters read_source(const Section& section, const NamedRegions& named,
                                 std::set<std::string>& taken) {
  HeatSourceParameters source;
  Vector centre{}, velocity{};
  const Rule path = {"a table {time, position}", [&source](const Value& value) {
                       source.position = read_path(Section(value));
                     }};
  Region where;
  section.read({must_have("name", name(source.name, taken)),
                may_have("power_density", function(source.power, dimension::power_density)),
                may_have("power", function(source.power, dimension::power)),
                may_have("region", region(where, named)), may_have("shape", shape(source.shape)),
                may_have("centre", vector(centre, dimension::length)),
                may_have("velocity", vector(velocity, dimension::velocity)),
                may_have("path", path)});
  section.exactly_one_of({"power_density", "power"});
  section.exactly_one_of({"region", "shape"});
  source.is_density = section.has("power_density");
  if (section.has("region")) {
    source.region = where;
    for (const char* key : {"centre", "velocity", "path"})
      if (section.has(key)) section.refuse(key, "a region stays where it is", "a shape beside it");
    return source;
  }
  section.exactly_one_of({"centre", "path"});
  section.at_most_one_of({"velocity", "path"});
  if (!section.has("path")) source.position = straight(centre, velocity);
  return source;
}

}  // namespace

Rule temperatures_section(std::vector<ImposedTemperatureParameters>& temperatures,
                          const NamedRegions& named) {
  const auto taken = std::make_shared<std::set<std::string>>();
  return tables([&temperatures, &named, taken](const Section& section) {
    ImposedTemperatureParameters imposed;
    section.read(
        {must_have("name", name(imposed.name, *taken)),
         may_have("region", region(imposed.region, named)), may_have("wall", wall(imposed.wall)),
         must_have("value", function(imposed.temperature, dimension::temperature, not_negative))});
    section.exactly_one_of({"region", "wall"});
    temperatures.push_back(imposed);
  });
}

Rule heat_fluxes_section(std::vector<HeatFluxParameters>& fluxes) {
  const auto taken = std::make_shared<std::set<std::string>>();
  return tables([&fluxes, taken](const Section& section) {
    HeatFluxParameters read;
    section.read({must_have("name", name(read.name, *taken)), must_have("wall", wall(read.wall)),
                  must_have("flux", function(read.flux, dimension::heat_flux))});
    fluxes.push_back(read);
  });
}

Rule convections_section(std::vector<ConvectionParameters>& convections) {
  const auto taken = std::make_shared<std::set<std::string>>();
  return tables([&convections, taken](const Section& section) {
    ConvectionParameters read;
    section.read({must_have("name", name(read.name, *taken)), must_have("wall", wall(read.wall)),
                  must_have("coefficient",
                            function(read.coefficient, dimension::heat_transfer, not_negative)),
                  must_have("temperature",
                            function(read.temperature, dimension::temperature, not_negative))});
    convections.push_back(read);
  });
}

Rule heat_sources_section(std::vector<HeatSourceParameters>& sources, const NamedRegions& named) {
  const auto taken = std::make_shared<std::set<std::string>>();
  return tables([&sources, &named, taken](const Section& section) {
    sources.push_back(read_source(section, named, *taken));
  });
}

}  // namespace solidem
