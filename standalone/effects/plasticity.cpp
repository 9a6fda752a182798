// SPDX-License-Identifier: GPL-2.0-or-later
//
// [plasticity]: what it asks of the beams, which flow (effects/beams.hpp).
#include "effects/beam_parameters.hpp"
#include "effects/bond_law_keys.hpp"
#include "effects/effect_kind.hpp"

namespace solidem {

namespace {

using Law = PlasticityParameters::Law;

Key flow_rule_key(PlasticityParameters& p) {
  return may_have("law", choice<Law>(p.law, choices_of(flow_rules)))
      .means(
          "radial return yields again when the stress comes back to the yield stress, in either "
          "direction; the scaled offset only beyond the largest strain before; associated flow as "
          "radial return, normal to the yield surface");
}

std::vector<Key> own_keys(PlasticityParameters& p) {
  return {flow_rule_key(p), section_key(p.section),
          may_have("rate_time", quantity(p.rate_time, dimension::time, positive))
              .means("of laws that look at the rate of flow: over which that of a bond is averaged")
              .without("a hundred times what sound takes through the stiffest bond")};
}

void read_plasticity(const Value& value, Reading& reading) {
  table([&](const Section& section) {
    PlasticityParameters p;
    const auto& beams = reading.setup.get<BeamParameters>();
    read_bond_law<YieldLaws>(section, "hardening", own_keys(p), beams, p.hardening);
    if (p.law == Law::associated && p.section != JudgedSection::middle)
      section.refuse("section", "associated flow is of the resultants at mid-length",
                     "section = \"middle\", or another law");
    if (p.rate_time && !follows_rate(p.hardening))
      section.refuse("rate_time", "this law does not look at the rate of flow",
                     "hardening = \"johnson-cook\" with a rate_sensitivity");
    if (!beams) return;  // refused as a whole
    reading.setup.get<PlasticityParameters>() = p;
  }).read(value);
}

}  // namespace

EffectKind plasticity_kind() {
  EffectKind kind;
  kind.section = "plasticity";
  kind.beside = {"beams"};
  kind.problem_alone = "there are no beams";
  kind.example =
      "[plasticity]\n"
      "yield_strain = 0.001\n"
      "hardening_ratio = 0.05\n";
  kind.is_named = [](const Setup& setup) { return setup.get<PlasticityParameters>().has_value(); };
  kind.read = read_plasticity;
  kind.visit_keys = [](const VisitKeys& visit) {
    PlasticityParameters p;
    visit_law_keys<YieldLaws>("plasticity", "hardening", own_keys(p), visit);
  };
  kind.explain = [](const Setup& setup, const Specimen&, nlohmann::ordered_json& values) {
    const PlasticityParameters& p = *setup.get<PlasticityParameters>();
    values["law"] = name_of(p.law);
    values["section"] = name_of(p.section);
    values["hardening"] = name_of(p.hardening);
    add_parameters(values, p.hardening);
    if (p.rate_time) values["rate_time"] = *p.rate_time;
  };
  return kind;
}

}  // namespace solidem
