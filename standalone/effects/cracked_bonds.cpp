// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/cracked_bonds.hpp"

#include <algorithm>

#include "effects/central_force_parameters.hpp"
#include "laws/crack_face.hpp"

namespace solidem {

namespace {

constexpr double usual_range = 1.2;    // NeighbourActionRadius of Terreros 2013, annex E.2
constexpr double skin_of_radii = 0.3;  // seldom searched, and few listed in vain
constexpr std::size_t least_blocks = 40;

Vector position_of(const Model& model, std::size_t element) {
  const double* row = model.positions()[element];
  return {row[0], row[1], row[2]};
}

bool is_on_face(const Vector& barycentre) {
  return dot(barycentre, barycentre) > 0;
}

}  // namespace

CrackedBonds::CrackedBonds(const DamageParameters& parameters, const Beams& beams, Rupture& rupture,
                           Model& model)
    : parameters_(parameters),
      beams_(beams),
      rupture_(rupture),
      model_(model),
      range_(parameters.range.value_or(usual_range)),
      skin_(skin_of_radii * mean_radius(model.specimen())),
      around_(model.elements()),
      barycentre_(model.elements()) {
  look_around();
  for (const Surroundings& around : around_) had_.push_back(around.count);
}

void CrackedBonds::keep_neighbours() {
  const std::size_t elements = model_.elements();
  bool is_outdated = listed_at_.empty();
  for (std::size_t i = 0; i < elements && !is_outdated; ++i) {
    const Vector moved = position_of(model_, i) - listed_at_[i];
    is_outdated = dot(moved, moved) > 0.25 * skin_ * skin_;
  }
  if (!is_outdated) return;
  listed_at_.clear();
  for (std::size_t i = 0; i < elements; ++i) listed_at_.push_back(position_of(model_, i));
  const Specimen& specimen = model_.specimen();
  listed_ = find_neighbours(specimen.domain, listed_at_, specimen.radius, range_, skin_);
}

CrackedBonds::Surroundings CrackedBonds::surroundings(std::size_t element) const {
  const Specimen& specimen = model_.specimen();
  const Vector own = position_of(model_, element);
  Surroundings around;
  for (std::size_t k = listed_.first[element]; k < listed_.first[element + 1]; ++k) {
    const auto j = static_cast<std::size_t>(listed_.neighbour[k]);
    if (rupture_.is_removed(listed_.neighbour[k])) continue;
    Vector chord = position_of(model_, j) - own;
    if (!listed_.image.empty()) chord += image_shift(specimen.domain, listed_.image[k]);
    const double range = range_ * (specimen.radius[element] + specimen.radius[j]);
    if (dot(chord, chord) >= range * range) continue;
    around.sum += chord;
    ++around.count;
  }
  return around;
}

void CrackedBonds::look_around() {
  keep_neighbours();
  const std::size_t elements = model_.elements();
  for_blocks((elements + lanes - 1) / lanes, least_blocks,
             [&](std::size_t first, std::size_t last) {
               for (std::size_t i = first * lanes; i < std::min(last * lanes, elements); ++i)
                 around_[i] = surroundings(i);
             });
  if (!parameters_.crack_threshold) return;
  for (std::size_t i = 0; i < elements; ++i) {
    const double bound = *parameters_.crack_threshold * model_.specimen().radius[i];
    const double count = around_[i].count;
    barycentre_[i] = parameters_.leaves_out_free_faces && !had_.empty()
                         ? crack_face_barycentre(around_[i].sum, count, bound, double(had_[i]))
                         : crack_face_barycentre(around_[i].sum, count, bound);
  }
}

std::vector<Pair> CrackedBonds::torn_bonds() const {
  std::vector<Pair> torn;
  model_.slots().for_each([&](std::int32_t i, std::int32_t j, std::size_t row, int lane) {
    if (i > j) return;
    const Vector& face_i = barycentre_[static_cast<std::size_t>(i)];
    const Vector& face_j = barycentre_[static_cast<std::size_t>(j)];
    if (!is_on_face(face_i) || !is_on_face(face_j)) return;
    const Beams::Bond bond = beams_.bond(model_, i, j, row, lane);
    if (on_opposite_faces(face_i, face_j, bond.chord) && dot(bond.load().force, bond.chord) > 0)
      torn.push_back({i, j});
  });
  return torn;
}

std::vector<std::int32_t> CrackedBonds::isolated() const {
  std::vector<std::int32_t> elements;
  for (std::size_t i = 0; i < around_.size(); ++i)
    if (around_[i].count < std::min(parameters_.minimal_neighbours, had_[i]))
      elements.push_back(static_cast<std::int32_t>(i));
  return elements;
}

void CrackedBonds::advance(Model& /*model*/, const Step& step) {
  ++steps_;
  const bool looks = parameters_.crack_threshold && steps_ % parameters_.every == 0;
  const bool removes =
      parameters_.minimal_neighbours > 0 && steps_ % parameters_.removal_every == 0;
  if (!looks && !removes) return;
  look_around();
  if (looks) rupture_.break_bonds(torn_bonds(), step);
  if (removes) rupture_.remove_elements(isolated(), step);
}

void CrackedBonds::observe(const Model& /*model*/, Observation& observation) const {
  if (parameters_.crack_threshold)
    observation.add("crack_faces", static_cast<double>(std::count_if(
                                       barycentre_.begin(), barycentre_.end(), is_on_face)));
  if (parameters_.minimal_neighbours > 0)
    observation.add("removed", static_cast<double>(rupture_.removed()));
}

void CrackedBonds::show(const Model& /*model*/, Frame& frame) const {
  if (!parameters_.crack_threshold) return;
  std::vector<double> crack_face;
  for (const Vector& barycentre : barycentre_) crack_face.push_back(is_on_face(barycentre) ? 1 : 0);
  frame.add("crack_face", crack_face);
}

void CrackedBonds::state(Archive& archive) {
  archive(steps_, barycentre_);
}

}  // namespace solidem
