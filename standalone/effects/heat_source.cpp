// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_source.hpp"

#include "effects/effect_kind.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heat_places.hpp"
#include "effects/moving_shape.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"

namespace solidem {

HeatSource::HeatSource(const HeatSourceParameters& parameters, std::vector<ElementValue> fixed)
    : HeatLoad("heat_source." + parameters.name),
      parameters_(parameters),
      fixed_(std::move(fixed)) {}

HeatSource::HeatSource(const HeatSourceParameters& parameters, std::unique_ptr<HeatSpread> spread)
    : HeatLoad("heat_source." + parameters.name),
      parameters_(parameters),
      spread_(std::move(spread)) {}

HeatSource::~HeatSource() = default;

void HeatSource::heated(double time, std::vector<ElementValue>& volumes) const {
  if (spread_ != nullptr)
    spread_->at(time, volumes);
  else
    volumes.insert(volumes.end(), fixed_.begin(), fixed_.end());
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
  return parameters_.power.is_constant() && (spread_ == nullptr || spread_->rests());
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

/// A source as it is read: where it starts and how it moves become its path.
struct ReadSource {
  HeatSourceParameters source;
  Region region;
  ReadPath path;
};

std::vector<Key> source_keys(ReadSource& p, Reading& reading) {
  std::vector<Key> keys{
      must_have("name", name(p.source.name, reading.taken)).means("names its columns"),
      may_have("power_density", function(p.source.power, dimension::power_density))
          .without("either this"),
      may_have("power", function(p.source.power, dimension::power))
          .means("of the whole source, into what of it lies in the body")
          .without("or this"),
      may_have("region", region(p.region, reading.regions)).without("either this"),
      may_have("shape", shape(p.source.shape))
          .means("around the source's centre")
          .without("or this")};
  for (const Key& key : path_keys(p.path)) keys.push_back(key);
  return keys;
}

void finish_source(const Section& section, ReadSource& p) {
  section.exactly_one_of({"power_density", "power"});
  section.exactly_one_of({"region", "shape"});
  p.source.is_density = section.has("power_density");
  if (!section.has("region")) {
    p.source.position = finish_path(section, p.path);
    return;
  }
  p.source.region = p.region;
  for (const std::string& key : path_key_names())
    if (section.has(key)) section.refuse(key, "a region stays where it is", "a shape beside it");
}

/// What the elements of a region stand for.
std::vector<ElementValue> volumes_of(const HeatSourceParameters& source, Assembly& assembly) {
  std::vector<ElementValue> volumes;
  const std::vector<double> takes = which_conduct(assembly);
  const std::vector<std::int32_t> elements =
      select_conducting(assembly, "[[heat_sources]] \"" + source.name + "\"", *source.region);
  assembly.selections["heat_source." + source.name] = elements;
  for (const std::int32_t e : elements) {
    const auto i = static_cast<std::size_t>(e);
    volumes.push_back({e, takes[i] * assembly.geometry.volume[i]});
  }
  return volumes;
}

/// A source heats as much of what an element stands for as of its cell lies inside.
std::unique_ptr<HeatSpread> spread_of(const HeatSourceParameters& source, Assembly& assembly) {
  const Shape& shape = *source.shape;
  HeatedPart part{shape.bounds(), shape.smallest_extent(),
                  [shape](const Polyhedron& solid, const Vector& position) {
                    return volume_inside(solid, shape, position);
                  }};
  check_images(assembly, "[[heat_sources]] \"" + source.name + "\" shape", part);
  const Domain& domain = assembly.specimen().domain;
  const auto [lower, upper] = HeatSpread::swept(part, source.position, domain);
  std::vector<CellSolid> solids = heat_solids(assembly, lower, upper);
  std::vector<double> cell(assembly.model.elements(), 0.0), share = which_conduct(assembly);
  for (const CellSolid& of : solids)
    cell[static_cast<std::size_t>(of.element)] += (of.is_taken_away ? -1 : 1) * volume(of.solid);
  for (std::size_t i = 0; i < share.size(); ++i)
    if (cell[i] > 0) share[i] *= assembly.geometry.volume[i] / cell[i];
  return std::make_unique<HeatSpread>(std::move(solids), std::move(part), source.position,
                                      std::move(share), assembly.specimen());
}

std::unique_ptr<Effect> make_source(const HeatSourceParameters& source, Assembly& assembly) {
  if (source.region) return std::make_unique<HeatSource>(source, volumes_of(source, assembly));
  return std::make_unique<HeatSource>(source, spread_of(source, assembly));
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
