// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/moving_shape.hpp"

#include "keys/rules.hpp"

namespace solidem {

namespace {

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

}  // namespace

Rule shape(std::optional<Shape>& target) {
  const std::string expected =
      "{ kind = \"sphere\", \"cylinder\" or \"box\", ... }, or an array of these";
  return {expected, [&target, expected](const Value& value) {
            Shape read;
            if (value.node().is_table()) {
              read.parts.push_back(read_part(value));
            } else {
              for (const Value& entry : value.entries(-1, expected))
                read.parts.push_back(read_part(entry));
              if (read.parts.empty()) value.refuse("empty", expected);
            }
            if (read.parts.front().is_cut_out)
              value.refuse("begins with a cut-out", "a solid before what is cut out of it");
            target = read;
          }};
}

std::vector<Key> path_keys(ReadPath& path) {
  const Rule table = {"a table {time, position}",
                      [&path](const Value& value) { path.table = read_path(Section(value)); }};
  return {may_have("centre", vector(path.centre, dimension::length))
              .means("of the shape, at the start")
              .without("needed with a shape, or a path"),
          may_have("velocity", vector(path.velocity, dimension::velocity)).without("zero"),
          may_have("path", table)
              .means("of the shape's centre, linear between the times, held outside")
              .without("or this")};
}

const std::vector<std::string>& path_key_names() {
  static const std::vector<std::string> names{"centre", "velocity", "path"};
  return names;
}

std::array<TimeFunction, 3> finish_path(const Section& section, const ReadPath& path) {
  section.exactly_one_of({"centre", "path"});
  section.at_most_one_of({"velocity", "path"});
  return section.has("path") ? path.table : straight(path.centre, path.velocity);
}

}  // namespace solidem
