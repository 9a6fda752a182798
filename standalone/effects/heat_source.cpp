// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_source.hpp"

#include <algorithm>
#include <cmath>

#include "effects/effect_kind.hpp"
#include "effects/heat_places.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"

namespace solidem {

HeatSource::HeatSource(const HeatSourceParameters& parameters,
                       const std::vector<std::int32_t>& elements, std::vector<double> volume,
                       const Specimen& specimen)
    : HeatLoad("heat_source." + parameters.name),
      parameters_(parameters),
      volume_(std::move(volume)),
      centre_(specimen.position.data()) {
  for (const std::int32_t e : elements) fixed_.push_back({e, volume_[static_cast<std::size_t>(e)]});
  if (!parameters_.shape) {
    volume_ = {};  // a region is known once and for all
    return;
  }
  constexpr double pi = 3.14159265358979323846;
  double largest = 0;
  for (const double v : volume_) {
    radius_.push_back(std::cbrt(0.75 * v / pi));
    largest = std::max(largest, radius_.back());
  }
  const auto [lower, upper] = parameters_.shape->bounds();
  lower_ = lower - Vector{largest, largest, largest};
  upper_ = upper + Vector{largest, largest, largest};
}

void HeatSource::heated(double time, std::vector<ElementValue>& volumes) const {
  if (!parameters_.shape) {
    volumes.insert(volumes.end(), fixed_.begin(), fixed_.end());
    return;
  }
  const Vector position{parameters_.position[0](time), parameters_.position[1](time),
                        parameters_.position[2](time)};
  for (std::size_t i = 0; i < volume_.size(); ++i) {
    const Vector p = centre_[i] - position;
    if (!(volume_[i] > 0) || p.x < lower_.x || p.x > upper_.x || p.y < lower_.y || p.y > upper_.y ||
        p.z < lower_.z || p.z > upper_.z)
      continue;
    const double fraction =
        fraction_inside(parameters_.shape->signed_distance(p, radius_[i]) / radius_[i]);
    if (fraction > 0) volumes.push_back({static_cast<std::int32_t>(i), fraction * volume_[i]});
  }
}

void HeatSource::powers(double time, const double* /*temperature*/,
                        std::vector<ElementValue>& powers) const {
  const std::size_t first = powers.size();
  heated(time, powers);
  double density = parameters_.power(time);
  if (!parameters_.is_density) {
    double volume = 0;
    for (std::size_t k = first; k < powers.size(); ++k) volume += powers[k].value;
    density = volume > 0 ? density / volume : 0;
  }
  for (std::size_t k = first; k < powers.size(); ++k) powers[k].value *= density;
}

bool HeatSource::reaches(double time) const {
  std::vector<ElementValue> volumes;
  heated(time, volumes);
  return !volumes.empty();
}

bool HeatSource::is_steady() const {
  const bool rests = std::all_of(parameters_.position.begin(), parameters_.position.end(),
                                 [](const TimeFunction& f) { return f.is_constant(); });
  return parameters_.power.is_constant() && (parameters_.region || rests);
}

void HeatSource::start(const Model& model, double duration) {
  constexpr int looks = 400;
  for (int k = 0; k <= looks; ++k)
    if (reaches(duration * k / looks)) return;
  throw InputError("[[heat_sources]] \"" + parameters_.name +
                   "\": outside the body at all times of the run; expected a shape that meets the "
                   "body, which lies between " +
                   bounds(model.specimen()));
}

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
              if (read.parts.front().is_cut_out)
                value.refuse("begins with a cut-out", "a solid before what is cut out of it");
            }
            target = read;
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

/// A source as it is read: where it starts and how it moves become its path.
struct ReadSource {
  HeatSourceParameters source;
  Region region;
  Vector centre{}, velocity{};
};

std::vector<Key> source_keys(ReadSource& p, Reading& reading) {
  const Rule path = {"a table {time, position}",
                     [&p](const Value& value) { p.source.position = read_path(Section(value)); }};
  return {must_have("name", name(p.source.name, reading.taken)).means("names its columns"),
          may_have("power_density", function(p.source.power, dimension::power_density))
              .without("either this"),
          may_have("power", function(p.source.power, dimension::power))
              .means("of the whole source")
              .without("or this"),
          may_have("region", region(p.region, reading.regions)).without("either this"),
          may_have("shape", shape(p.source.shape))
              .means("around the source's centre")
              .without("or this"),
          may_have("centre", vector(p.centre, dimension::length))
              .means("of the shape, at the start")
              .without("needed with a shape, or a path"),
          may_have("velocity", vector(p.velocity, dimension::velocity)).without("zero"),
          may_have("path", path)
              .means("of the shape's centre, linear between the times, held outside")
              .without("or this")};
}

void finish_source(const Section& section, ReadSource& p) {
  section.exactly_one_of({"power_density", "power"});
  section.exactly_one_of({"region", "shape"});
  p.source.is_density = section.has("power_density");
  if (section.has("region")) {
    p.source.region = p.region;
    for (const char* key : {"centre", "velocity", "path"})
      if (section.has(key)) section.refuse(key, "a region stays where it is", "a shape beside it");
    return;
  }
  section.exactly_one_of({"centre", "path"});
  section.at_most_one_of({"velocity", "path"});
  if (!section.has("path")) p.source.position = straight(p.centre, p.velocity);
}

std::unique_ptr<Effect> make_source(const HeatSourceParameters& source, Assembly& assembly) {
  std::vector<std::int32_t> elements;
  if (source.region)
    elements = select_conducting(assembly, "heat_source." + source.name, *source.region);
  // What no heat could leave again takes none: it would only grow hotter and hotter.
  std::vector<double> volume = assembly.geometry.volume;
  const std::vector<int> neighbours = assembly.model.conductors().coordination();
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (neighbours[i] == 0) volume[i] = 0;
  return std::make_unique<HeatSource>(source, elements, std::move(volume), assembly.specimen());
}

void plan_sources(const Setup& setup, Plan& plan) {
  for (const HeatSourceParameters& source : setup.all<HeatSourceParameters>())
    plan.effects.push_back(
        {"heat source " + source.name, "[[heat_sources]]", "", Phase::heat,
         [source](Assembly& assembly) { return make_source(source, assembly); }});
}

}  // namespace

EffectKind heat_sources_kind() {
  EffectKind kind;
  kind.section = "heat_sources";
  kind.is_list = true;
  kind.needs = Provides::heat;
  kind.is_named = [](const Setup& setup) { return !setup.all<HeatSourceParameters>().empty(); };
  kind.read = [](const Value& value, Reading& reading) {
    tables([&](const Section& section) {
      ReadSource read;
      section.read(source_keys(read, reading));
      finish_source(section, read);
      reading.setup.all<HeatSourceParameters>().push_back(read.source);
    }).read(value);
  };
  kind.visit_keys = [](const VisitKeys& visit) {
    EmptyReading empty;
    ReadSource read;
    visit("heat_sources", source_keys(read, empty.reading));
  };
  kind.plan = plan_sources;
  kind.example =
      "[[heat_sources]]\nname = \"spot\"\nshape = { kind = \"sphere\", radius = \"0.6 mm\" }\n"
      "centre = [\"1 mm\", \"1 mm\", \"1 mm\"]\nvelocity = [\"1 m/s\", \"0 m/s\", \"0 m/s\"]\n"
      "power = \"1 kW\"\n";
  return kind;
}

}  // namespace solidem
