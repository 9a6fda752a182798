// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/exposed_surface.hpp"

#include <algorithm>
#include <map>

#include "effects/beam_parameters.hpp"
#include "laws/constants.hpp"

namespace solidem {

namespace {

constexpr int bonds_in_a_row = 3;

/// The faces of all walls; none where walls are not known or the elements do not reach them.
std::vector<WallFace> wall_faces(const ConductionGeometry& geometry) {
  std::vector<WallFace> faces;
  for (const auto& [name, of_wall] : geometry.walls) {
    if (of_wall.empty()) return {};
    faces.insert(faces.end(), of_wall.begin(), of_wall.end());
  }
  return faces;
}

}  // namespace

const std::string ExposedSurface::word = "exposed";

ExposedSurface::ExposedSurface(const Assembly& assembly)
    : model_(assembly.model),
      may_grow_(assembly.setup.get<RuptureParameters>().has_value()),
      at_start_(wall_faces(assembly.geometry)) {
  const Specimen& specimen = assembly.specimen();
  std::vector<Openness> open;
  if (at_start_.empty() || may_grow_) {
    surroundings_.emplace(specimen);
    open = surroundings_->openness();
  }
  if (at_start_.empty()) {
    const std::vector<double> area = surroundings_->areas(open);
    for (std::size_t i = 0; i < area.size(); ++i)
      if (area[i] > 0)
        at_start_.push_back({static_cast<std::int32_t>(i), area[i], specimen.radius[i]});
  }
  for (const WallFace& face : at_start_) area_ += face.area;
  if (!may_grow_) return;
  for (std::size_t i = 0; i < open.size(); ++i)
    closed_.push_back(surroundings_->vector_area(i, open[i]));
  laid_open_.resize(specimen.size());
  grown_.resize(specimen.size());
  was_joined_.resize(surroundings_->near().neighbour.size());
  apart_.resize(was_joined_.size());
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    const std::vector<std::int32_t> with = joined({static_cast<std::int32_t>(i)}, bonds_in_a_row);
    surroundings_->for_each_near(i, [&](std::size_t other, std::size_t entry) {
      was_joined_[entry] =
          std::binary_search(with.begin(), with.end(), static_cast<std::int32_t>(other)) ? 1 : 0;
    });
  }
}

HeatedFaces ExposedSurface::part(const std::vector<std::int32_t>& elements) {
  Part part{std::vector<char>(model_.elements(), 0), std::make_shared<std::vector<WallFace>>()};
  for (const std::int32_t e : elements) part.holds[static_cast<std::size_t>(e)] = 1;
  fill(part);
  HeatedFaces faces{part.faces, *part.faces, !may_grow_};
  if (may_grow_)
    for (const std::int32_t e : elements) {
      // No vector area is larger than that of a hemisphere.
      const double radius = model_.specimen().radius[static_cast<std::size_t>(e)];
      const double blown = Surroundings::blow_up * radius;
      faces.largest.push_back({e, pi * blown * blown, radius});
    }
  parts_.push_back(std::move(part));
  return faces;
}

void ExposedSurface::fill(const Part& part) const {
  part.faces->clear();
  for (const WallFace& face : at_start_)
    if (part.holds[static_cast<std::size_t>(face.element)] != 0) part.faces->push_back(face);
  for (std::size_t i = 0; i < grown_.size(); ++i)
    if (part.holds[i] != 0 && grown_[i] > 0)
      part.faces->push_back({static_cast<std::int32_t>(i), grown_[i], model_.specimen().radius[i]});
}

std::vector<std::int32_t> ExposedSurface::joined(const std::vector<std::int32_t>& from,
                                                 int bonds) const {
  const Slots& slots = model_.slots();
  std::vector<std::int32_t> all = from, last = from;
  for (int k = 0; k < bonds; ++k) {
    std::vector<std::int32_t> next;
    for (const std::int32_t e : last) {
      const auto block = static_cast<std::size_t>(e) / lanes,
                 lane = static_cast<std::size_t>(e) % lanes;
      for (std::size_t row = slots.first_row()[block]; row < slots.first_row()[block + 1]; ++row)
        next.push_back(slots.neighbours()[row * lanes + lane]);
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    all.insert(all.end(), next.begin(), next.end());
    last = std::move(next);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool ExposedSurface::follow_bonds() {
  const std::vector<BondChange>& changes = model_.bond_changes();
  if (!may_grow_ || seen_ == changes.size()) return false;
  // Who was joined by way of a bond that is broken now is joined to one of its ends by fewer.
  std::vector<std::int32_t> ends;
  std::map<std::int32_t, std::vector<std::int32_t>> across;
  for (; seen_ < changes.size(); ++seen_) {
    const Pair pair = changes[seen_].pair;
    ends.insert(ends.end(), {pair.i, pair.j});
    across[pair.i].push_back(pair.j);
    across[pair.j].push_back(pair.i);
  }
  std::vector<std::int32_t> near = ends;
  for (int bond = 1; bond < bonds_in_a_row; ++bond) {
    std::vector<std::int32_t> next = joined(near, 1);
    for (const std::int32_t e : near)
      if (const auto found = across.find(e); found != across.end())
        next.insert(next.end(), found->second.begin(), found->second.end());
    near = std::move(next);
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return look_at(near);
}

bool ExposedSurface::look_at(const std::vector<std::int32_t>& elements) {
  std::vector<std::size_t> changed;
  for (const std::int32_t e : elements) {
    const auto i = static_cast<std::size_t>(e);
    const std::vector<std::int32_t> with = joined({e}, bonds_in_a_row);
    bool any = false;
    surroundings_->for_each_near(i, [&](std::size_t other, std::size_t entry) {
      const bool is_apart =
          was_joined_[entry] != 0 &&
          !std::binary_search(with.begin(), with.end(), static_cast<std::int32_t>(other));
      any = any || is_apart != (apart_[entry] != 0);
      apart_[entry] = is_apart ? 1 : 0;
    });
    if (!any) continue;
    laid_open_[i] = surroundings_->vector_area(i, surroundings_->openness(i, apart_)) - closed_[i];
    changed.push_back(i);
    surroundings_->for_each_near(i,
                                 [&](std::size_t other, std::size_t) { changed.push_back(other); });
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const std::size_t i : changed) measure(i);
  if (changed.empty()) return false;
  area_ = 0;
  for (const WallFace& face : at_start_) area_ += face.area;
  for (const double grown : grown_) area_ += grown;
  for (const Part& part : parts_) fill(part);
  return true;
}

void ExposedSurface::measure(std::size_t element) {
  const Vector sum = surroundings_->around(element, laid_open_, apart_);
  const double length = norm(sum);
  grown_[element] = length > 0 ? std::max(0.0, dot(laid_open_[element], sum) / length) : 0;
}

void ExposedSurface::observe(const Model& /*model*/, Observation& observation) const {
  observation.add("exposed_area", area_);
}

void ExposedSurface::state(Archive& archive) {
  if (!may_grow_) return;
  archive(area_);
  if (!archive.is_reading()) return;
  std::vector<std::int32_t> all(model_.elements());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
  look_at(all);
  seen_ = model_.bond_changes().size();
}

void plan_exposed_surface(const std::string& wall, const std::string& section, Plan& plan) {
  const std::string name = "exposed surface";
  const bool is_planned =
      std::any_of(plan.effects.begin(), plan.effects.end(),
                  [&](const PlannedEffect& effect) { return effect.name == name; });
  if (wall != ExposedSurface::word || is_planned) return;
  plan.effects.push_back({name, section, "", Phase::heat, [](Assembly& assembly) {
                            return std::make_unique<ExposedSurface>(assembly);
                          }});
}

}  // namespace solidem
