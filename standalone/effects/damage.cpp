// SPDX-License-Identifier: GPL-2.0-or-later
#include "effects/damage.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/central_force_parameters.hpp"
#include "effects/cracked_bonds.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"

namespace solidem {

Damage::Damage(const DamageParameters& parameters, CentralForces& forces, Model& model)
    : parameters_(parameters), forces_(forces), model_(model) {
  if (parameters_.minimal_neighbours > 0 || parameters_.leaves_out_free_faces)
    had_ = forces_.neighbours_within_range();
  if (parameters_.leaves_out_free_faces)
    std::copy(had_.begin(), had_.end(), model.data(columns::neighbours_at_start));
  find_crack_faces();
}

void Damage::find_crack_faces() {
  if (parameters_.crack_threshold) forces_.find_crack_faces(*parameters_.crack_threshold);
}

void Damage::advance(Model& /*model*/, const Step& /*step*/) {
  ++steps_;
  const bool looks = parameters_.crack_threshold && steps_ % parameters_.every == 0;
  const bool removes =
      parameters_.minimal_neighbours > 0 && steps_ % parameters_.removal_every == 0;
  if (!looks && !removes) return;
  forces_.keep_neighbours();
  if (removes) remove_isolated();
  if (looks) find_crack_faces();
}

void Damage::remove_isolated() {
  const std::vector<int> have = forces_.neighbours_within_range();
  for (std::size_t i = 0; i < have.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    if (have[i] >= std::min(parameters_.minimal_neighbours, had_[i]) || is_removed(element))
      continue;
    removed_.insert(std::upper_bound(removed_.begin(), removed_.end(), element), element);
    forces_.exclude(element);
    model_.data(columns::inverse_mass)[i] = 0;
    for (int axis = 0; axis < 3; ++axis)
      model_.data(columns::velocity)[Model::at(columns::velocity, i, axis)] = 0;
  }
}

bool Damage::is_removed(std::int32_t element) const {
  return std::binary_search(removed_.begin(), removed_.end(), element);
}

void Damage::observe(const Model& model, Observation& observation) const {
  if (parameters_.crack_threshold) {
    const double* barycentre = model.data(columns::barycentre);
    double crack_faces = 0;
    for (std::size_t i = 0; i < model.elements(); ++i) {
      const double* b = barycentre + 4 * i;
      if (b[0] != 0 || b[1] != 0 || b[2] != 0) ++crack_faces;
    }
    observation.add("crack_faces", crack_faces);
  }
  if (parameters_.minimal_neighbours > 0)
    observation.add("removed", static_cast<double>(removed_.size()));
}

void Damage::show(const Model& model, Frame& frame) const {
  const std::size_t elements = model.elements();
  if (tells_crack_faces()) {
    std::vector<double> crack_face;
    for (std::size_t i = 0; i < elements; ++i) {
      const double* b = model.data(columns::barycentre) + 4 * i;
      crack_face.push_back(b[0] != 0 || b[1] != 0 || b[2] != 0 ? 1 : 0);
    }
    frame.add("crack_face", crack_face);
  }
  if (!removes()) return;
  std::vector<double> removed(elements, 0);
  for (const std::int32_t element : removed_) removed[static_cast<std::size_t>(element)] = 1;
  frame.add("removed", removed);
}

void Damage::summarise(const Model& /*model*/, Summary& summary) const {
  summary["elements_removed"] = removed();
}

void Damage::state(Archive& archive) {
  archive(steps_, removed_);
  if (!archive.is_reading()) return;
  for (const std::int32_t element : removed_)
    model_.data(columns::inverse_mass)[static_cast<std::size_t>(element)] = 0;
}

namespace {

std::vector<Key> damage_keys(DamageParameters& p, Reading& /*reading*/) {
  return {
      may_have("crack_threshold", number(p.crack_threshold, positive))
          .means("C; without it no cracks are told")
          .without("none"),
      may_have("every", integer(p.every, 1)).means("steps between two looks for crack faces"),
      may_have("minimal_neighbours", integer(p.minimal_neighbours, 1, 1000))
          .means("elements that keep fewer within range, and fewer than at the start, are taken "
                 "out: they stand still and act on nobody")
          .without("none is taken out"),
      may_have("removal_every", integer(p.removal_every, 1)).means("steps between two such looks"),
      may_have("free_faces",
               choice<bool>(p.leaves_out_free_faces, {{"cracks", false}, {"left_out", true}}))
          .means("`\"left_out\"`: only elements that have fewer neighbours than at the start stand "
                 "on faces of cracks"),
      may_have("range", number(p.range, Range{1, 10}))
          .means("with beams: α, elements nearer than α (R_i + R_j) are neighbours; central forces "
                 "have their own")
          .without("1.2")};
}

void finish_damage(const Section& section, DamageParameters& /*p*/, Reading& reading) {
  if (!section.has("crack_threshold") && !section.has("minimal_neighbours"))
    section.refuse("nothing says what is damaged",
                   "crack_threshold or minimal_neighbours, or both");
  if (section.has("every") && !section.has("crack_threshold"))
    section.refuse("every", "no crack faces are looked for", "crack_threshold beside it");
  if (section.has("removal_every") && !section.has("minimal_neighbours"))
    section.refuse("removal_every", "no element is removed", "minimal_neighbours beside it");
  if (section.has("free_faces") && !section.has("crack_threshold"))
    section.refuse("free_faces", "no crack faces are looked for", "crack_threshold beside it");
  if (section.has("range") && !reading.setup.get<BeamParameters>())
    section.refuse("range", "neighbours are those of the central forces",
                   "no such key; range of [central_forces]");
}

std::unique_ptr<Effect> make_cracked_bonds(const DamageParameters& damage, Assembly& assembly) {
  return std::make_unique<CrackedBonds>(damage, assembly.need<Beams>(), assembly.need<Rupture>(),
                                        assembly.model);
}

void plan_damage(const Setup& setup, Plan& plan) {
  const auto& damage = setup.get<DamageParameters>();
  if (!damage) return;
  if (setup.get<RuptureParameters>()) {
    plan.effects.push_back(
        {"damage", "[damage]", "", Phase::change_pairs,
         [damage = *damage](Assembly& assembly) { return make_cracked_bonds(damage, assembly); }});
    return;
  }
  if (damage->leaves_out_free_faces) plan.ask("damage", {&columns::neighbours_at_start});
  plan.effects.push_back({"damage", "[damage]", damage->crack_threshold ? "find_crack_faces" : "",
                          Phase::after_move, [damage = *damage](Assembly& assembly) {
                            return std::make_unique<Damage>(damage, assembly.need<CentralForces>(),
                                                            assembly.model);
                          }});
}

}  // namespace

EffectKind damage_kind() {
  EffectKind kind = single_kind<DamageParameters>("damage", damage_keys, finish_damage);
  kind.beside = {"central_forces", "rupture"};
  kind.problem_alone = "no pair can part";
  kind.plan = plan_damage;
  kind.example =
      "[damage]\n"
      "crack_threshold = 0.4\n"
      "minimal_neighbours = 3\n"
      "removal_every = 10\n";
  return kind;
}

}  // namespace solidem
