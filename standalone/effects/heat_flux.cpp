// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/heat_flux.hpp"

#include <algorithm>

#include "effects/effect_kind.hpp"
#include "effects/exposed_surface.hpp"
#include "effects/heat_load_parameters.hpp"
#include "effects/heat_places.hpp"
#include "effects/moving_shape.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"
#include "specimen/made_bodies.hpp"

namespace solidem {

void HeatFlux::powers(double time, const double* /*temperature*/,
                      std::vector<ElementValue>& powers) const {
  std::vector<ElementValue> areas;
  const double lit = spread_ != nullptr ? spread_->at(time, areas) : 0;
  if (spread_ == nullptr)
    for (const WallFace& face : *faces_.now) areas.push_back({face.element, face.area});
  double sum = 0;
  for (const ElementValue& area : areas) sum += area.value;
  double flux = parameters_.flux(time);
  // The heat on what cannot pass it on goes into the others that are lit.
  if (parameters_.is_power)
    flux /= sum;
  else if (spread_ != nullptr)
    flux *= lit / sum;
  for (const ElementValue& area : areas) powers.push_back({area.element, flux * area.value});
}

void HeatFlux::start(const Model& model, double duration) {
  if (spread_ == nullptr) return;
  constexpr int looks = 400;
  std::vector<ElementValue> areas;
  for (int k = 0; k <= looks; ++k)
    if (spread_->at(duration * k / looks, areas) > 0) return;
  throw InputError("[[heat_fluxes]] \"" + parameters_.name + "\": meets the wall " +
                   parameters_.wall +
                   " at no time of the run; expected a shape or spot that does; the body lies "
                   "between " +
                   bounds(model.specimen()));
}

namespace {

/// A flux as it is read.
struct ReadFlux {
  HeatFluxParameters flux;
  ReadPath path;
};

std::vector<Key> flux_keys(ReadFlux& p, Reading& reading) {
  std::vector<Key> keys{
      must_have("name", name(p.flux.name, reading.taken)).means("names its columns"),
      must_have("wall", wall(p.flux.wall)),
      may_have("region", region(p.flux.region, reading.regions))
          .means(region_of_exposed)
          .without("all of it"),
      may_have("flux", function(p.flux.flux, dimension::heat_flux))
          .means("into the body; of a Gaussian spot, its peak")
          .without("either this"),
      may_have("power", function(p.flux.flux, dimension::power))
          .means("into the body, all of it, while the heated part meets the wall")
          .without("or this"),
      may_have("shape", shape(p.flux.shape))
          .means("heats the part of the wall inside")
          .without("the whole wall"),
      may_have("spot_radius", quantity(p.flux.spot_radius, dimension::length, positive))
          .means("of a Gaussian spot: flux = peak times exp(-2 r^2 / radius^2) up to two radii")
          .without("no spot")};
  for (const Key& key : path_keys(p.path)) keys.push_back(key);
  return keys;
}

void finish_flux(const Section& section, ReadFlux& p) {
  section.exactly_one_of({"flux", "power"});
  section.at_most_one_of({"shape", "spot_radius"});
  p.flux.is_power = section.has("power");
  check_exposed_region(section, p.flux.wall);
  for (const char* part : {"shape", "spot_radius"})
    if (section.has(part) && p.flux.wall == ExposedSurface::word)
      section.refuse(part, "the exposed surface is known by its elements alone",
                     "a region, or the name of a wall");
  if (p.flux.shape || p.flux.spot_radius) {
    p.flux.position = finish_path(section, p.path);
    return;
  }
  for (const std::string& key : path_key_names())
    if (section.has(key))
      section.refuse(key, "a whole wall stays where it is", "shape or spot_radius beside it");
}

/// The part of a wall that lies in a shape: volumes of slabs about its faces, over their thickness.
HeatedPart part_in(const Shape& shape, double thickness) {
  return {shape.bounds(), shape.smallest_extent(),
          [shape, thickness](const Polyhedron& slab, const Vector& position) {
            return volume_inside(slab, shape, position) / thickness;
          }};
}

HeatedPart gaussian_part(double radius) {
  const Vector reach{2 * radius, 2 * radius, 2 * radius};
  return {{-reach, reach}, radius, [radius](const Polyhedron& slab, const Vector& position) {
            return gaussian_over(slab.faces[0], position, radius);
          }};
}

/// Refuses walls on which a part cannot be told.
void check_wall(const HeatFluxParameters& flux, const Assembly& assembly) {
  const std::string target = "[[heat_fluxes]] \"" + flux.name + "\": ";
  if (!has_cells(assembly.specimen()))
    throw InputError(target +
                     "a part of a wall cannot be told on a body whose outline is not known (" +
                     assembly.specimen().domain.shape + "); expected the whole wall");
  const std::vector<Wall> walls = walls_of_shapes(assembly.specimen());
  const bool is_flat = std::any_of(walls.begin(), walls.end(), [&](const Wall& wall) {
    return wall.name == flux.wall && !(wall.radius > 0);
  });
  if (flux.spot_radius && !is_flat)
    throw InputError(target + "spot_radius: the wall " + flux.wall +
                     " is curved or more than one plane; expected a flat wall, or a shape");
}

std::unique_ptr<HeatSpread> spread_of(const HeatFluxParameters& flux, Assembly& assembly) {
  check_wall(flux, assembly);
  const Specimen& specimen = assembly.specimen();
  // Thin against elements and shapes; the volumes of slabs keep enough digits.
  const double extent = flux.shape ? flux.shape->smallest_extent() : *flux.spot_radius;
  const double thickness = 1e-4 * std::min(extent, mean_radius(specimen));
  HeatedPart part = flux.shape ? part_in(*flux.shape, thickness) : gaussian_part(*flux.spot_radius);
  check_images(assembly, "[[heat_fluxes]] \"" + flux.name + "\": the heated part", part);
  return std::make_unique<HeatSpread>(wall_slabs(specimen, flux.wall, thickness), std::move(part),
                                      flux.position, which_conduct(assembly), specimen);
}

std::unique_ptr<Effect> make_flux(const HeatFluxParameters& flux, Assembly& assembly) {
  HeatedFaces faces = faces_of(assembly, "heat_fluxes", flux.name, flux.wall, flux.region);
  if (flux.shape || flux.spot_radius)
    return std::make_unique<HeatFlux>(flux, spread_of(flux, assembly));
  return std::make_unique<HeatFlux>(flux, std::move(faces));
}

void plan_fluxes(const Setup& setup, Plan& plan) {
  for (const HeatFluxParameters& flux : setup.all<HeatFluxParameters>()) {
    plan_exposed_surface(flux.wall, "[[heat_fluxes]]", plan);
    plan.effects.push_back({"heat flux " + flux.name, "[[heat_fluxes]]", "", Phase::heat,
                            [flux](Assembly& assembly) { return make_flux(flux, assembly); }});
  }
}

}  // namespace

EffectKind heat_fluxes_kind() {
  EffectKind kind;
  kind.section = "heat_fluxes";
  kind.is_list = true;
  kind.needs = Provides::heat;
  kind.is_named = [](const Setup& setup) { return !setup.all<HeatFluxParameters>().empty(); };
  kind.read = [](const Value& value, Reading& reading) {
    tables([&](const Section& section) {
      ReadFlux read;
      section.read(flux_keys(read, reading));
      finish_flux(section, read);
      reading.setup.all<HeatFluxParameters>().push_back(read.flux);
    }).read(value);
  };
  kind.visit_keys = [](const VisitKeys& visit) {
    EmptyReading empty;
    ReadFlux read;
    visit("heat_fluxes", flux_keys(read, empty.reading));
  };
  kind.plan = plan_fluxes;
  kind.example =
      "[[heat_fluxes]]\n"
      "name = \"lamp\"\n"
      "wall = \"y_high\"\n"
      "flux = \"1 MW/m^2\"\n";
  return kind;
}

}  // namespace solidem
