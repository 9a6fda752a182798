// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/changing_conductors.hpp"

#include <algorithm>
#include <cmath>

#include "effects/conduction_parameters.hpp"

namespace solidem {

namespace {

/// Mean area of the faces of each element through which it is bonded, m²; 0 without any.
std::vector<double> mean_bonded_face(const ConductionGeometry& geometry, const Slots& bonds) {
  std::vector<double> area(bonds.elements(), 0.0), count(bonds.elements(), 0.0);
  for (std::size_t k = 0; k < geometry.faces.size(); ++k) {
    const Pair face = geometry.faces[k];
    if (!bonds.find(face.i, face.j)) continue;
    for (const std::int32_t element : {face.i, face.j}) {
      area[static_cast<std::size_t>(element)] += geometry.face_paths[k].area;
      count[static_cast<std::size_t>(element)] += 1;
    }
  }
  for (std::size_t i = 0; i < area.size(); ++i) area[i] /= std::max(1.0, count[i]);
  return area;
}

}  // namespace

ChangingConductors::ChangingConductors(ConductionParameters::BrokenBonds broken_bonds,
                                       ConductionGeometry geometry, const Model& model)
    : broken_bonds_(broken_bonds),
      geometry_(std::move(geometry)),
      initial_(model.conductors().pairs()),
      area_anew_(geometry_.transmission_area.empty() ? mean_bonded_face(geometry_, model.slots())
                                                     : geometry_.transmission_area),
      seen_(model.bond_changes().size()) {}

ChangingConductors::Change ChangingConductors::follow(const Model& model) {
  Change change;
  const std::vector<BondChange>& changes = model.bond_changes();
  for (; seen_ < changes.size(); ++seen_) {
    const auto& [kind, pair, length] = changes[seen_];
    const std::size_t before = anew_.size();
    const bool switched = kind == BondChange::Kind::made ? join(pair, length) : part(pair);
    change.new_pairs = change.new_pairs || anew_.size() > before;
    if (switched) change.switched.push_back(pair);
  }
  return change;
}

bool ChangingConductors::join(Pair pair, double distance) {
  const bool conducts_again = insulating_.erase(pair) > 0;
  if (is_initial(pair)) return conducts_again;
  anew_[pair] = distance;
  return true;
}

bool ChangingConductors::part(Pair pair) {
  if (broken_bonds_ == ConductionParameters::BrokenBonds::conduct) return false;
  const bool conducts = is_initial(pair) || anew_.count(pair) > 0;
  return conducts && insulating_.insert(pair).second;
}

std::vector<Pair> ChangingConductors::pairs() const {
  std::vector<Pair> all = initial_;
  for (const auto& [pair, distance] : anew_) all.push_back(pair);
  std::sort(all.begin(), all.end());
  return all;
}

HeatPath ChangingConductors::path(const Specimen& specimen, Pair pair) const {
  const auto anew = anew_.find(pair);
  HeatPath path = anew == anew_.end()
                      ? geometry_.path(specimen, pair)
                      : HeatPath{std::sqrt(area_anew_[static_cast<std::size_t>(pair.i)] *
                                           area_anew_[static_cast<std::size_t>(pair.j)]),
                                 anew->second};
  if (insulating_.count(pair) != 0) path.area = 0;
  return path;
}

bool ChangingConductors::is_initial(Pair pair) const {
  return std::binary_search(initial_.begin(), initial_.end(), pair);
}

void ChangingConductors::state(Archive& archive, const Model& model) {
  archive(anew_, insulating_);
  if (archive.is_reading()) seen_ = model.bond_changes().size();
}

}  // namespace solidem
