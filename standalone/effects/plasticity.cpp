// SPDX-License-Identifier: GPL-2.0-or-later
//
// [plasticity]: what it asks of the beams, which flow (effects/beams.hpp).
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"

namespace solidem {

namespace {

using Law = PlasticityParameters::Law;

std::vector<Key> plasticity_keys(PlasticityParameters& p, Reading& /*reading*/) {
  return {
      may_have("law", choice<Law>(p.law, {{"radial-return", Law::radial_return},
                                          {"scaled-offset", Law::scaled_offset}}))
          .means("radial return yields again when the stress comes back to the yield stress, in "
                 "either direction; the scaled offset only beyond the largest strain before"),
      may_have("yield_stress", quantity(p.yield_stress, dimension::modulus, positive))
          .without("either this"),
      may_have("yield_strain", number(p.yield_strain, positive))
          .means("σ_y / E")
          .without("or this"),
      may_have("hardening_modulus", quantity(p.hardening_modulus, dimension::modulus, not_negative))
          .means("growth of the yield stress with the plastic strain")
          .without("at most one; 0"),
      may_have("hardening_ratio", number(p.hardening_ratio, not_negative))
          .means("the same over E")
          .without("")};
}

void finish_plasticity(const Section& section, PlasticityParameters& p, Reading& reading) {
  section.exactly_one_of({"yield_stress", "yield_strain"});
  section.at_most_one_of({"hardening_modulus", "hardening_ratio"});
  const auto& beams = reading.setup.get<BeamParameters>();
  if (!beams) return;  // refused as a whole
  if (beams->precision == BeamParameters::Precision::mixed)
    section.refuse("beams in mixed precision are elastic", "precision = \"double\" in [beams]");
  if (p.yield_stress) p.yield_strain = *p.yield_stress / beams->young_modulus;
  if (p.hardening_modulus) p.hardening_ratio = *p.hardening_modulus / beams->young_modulus;
}

}  // namespace

EffectKind plasticity_kind() {
  EffectKind kind =
      single_kind<PlasticityParameters>("plasticity", plasticity_keys, finish_plasticity);
  kind.beside = "beams";
  kind.problem_alone = "there are no beams";
  kind.example =
      "[plasticity]\n"
      "yield_strain = 0.001\n"
      "hardening_ratio = 0.05\n";
  return kind;
}

}  // namespace solidem
