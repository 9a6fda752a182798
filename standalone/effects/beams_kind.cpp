// SPDX-License-Identifier: GPL-2.0-or-later
//
// [beams] with [beams.anisotropy] and [beams.fibres]: keys, plan, making.
#include <cmath>
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/beam_material_keys.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/beams.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/effect_kind.hpp"
#include "keys/rules.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// Makes the radial axis perpendicular to the grain to the last bit, if it is within a thousandth.
bool square_up(GrainAxes<double>& axes) {
  const double along = dot(axes.radial, axes.longitudinal);
  if (std::abs(along) > 1e-3) return false;
  const Vector across = axes.radial - along * axes.longitudinal;
  axes.radial = (1 / norm(across)) * across;
  return true;
}

/// Some direction across the grain, where all of them are alike.
Vector any_radial(const Vector& grain) {
  Vector least{};
  const double size[] = {std::abs(grain.x), std::abs(grain.y), std::abs(grain.z)};
  component(least, size[0] <= size[1] && size[0] <= size[2] ? 0 : size[1] <= size[2] ? 1 : 2) = 1;
  const Vector across = cross(cross(grain, least), grain);
  return (1 / norm(across)) * across;
}

std::vector<Key> anisotropy_keys(Anisotropy& p) {
  return {
      must_have("grain", direction(p.axes.longitudinal)).means("direction L"),
      may_have("radial", direction(p.axes.radial))
          .means("direction R, at right angles to the grain")
          .without("all directions across the grain alike"),
      must_have("tangential_modulus", quantity(p.tangential_modulus, dimension::modulus, positive))
          .means("E of beams along T"),
      may_have("radial_modulus", quantity(p.radial_modulus, dimension::modulus, positive))
          .means("E of beams along R")
          .without("needed with radial"),
      may_have("transverse_shear_modulus",
               quantity(p.transverse_shear_modulus, dimension::modulus, positive))
          .means("G of beams across the grain")
          .without("G keeps its ratio to E"),
      may_have("exponent", number(p.exponent, positive)).means("p of |cos θ|^p")};
}

Rule anisotropy_section(BeamParameters& beams) {
  return table([&beams](const Section& section) {
    Anisotropy grain;
    section.read(anisotropy_keys(grain));
    if (section.has("radial") != section.has("radial_modulus"))
      section.refuse(section.has("radial") ? "radial" : "radial_modulus",
                     "one of radial and radial_modulus without the other",
                     "both, or neither: all directions across the grain are alike");
    if (!section.has("radial")) {
      grain.axes.radial = any_radial(grain.axes.longitudinal);
      grain.radial_modulus = grain.tangential_modulus;
    } else if (!square_up(grain.axes)) {
      section.refuse("radial", "not perpendicular to the grain",
                     "a direction at right angles to grain");
    }
    if (section.has("transverse_shear_modulus") && beams.law == BeamParameters::Law::spring)
      section.refuse("transverse_shear_modulus", "a spring has no shear modulus",
                     "no such key beside law = \"spring\"");
    beams.anisotropy = grain;
  });
}

std::vector<Key> fibre_keys(Fibres& p) {
  return {
      may_have("direction", direction(p.rule.direction))
          .without("the grain; needed without `[beams.anisotropy]`"),
      may_have("reach", number(p.rule.reach, Range{1, 10, false, true}))
          .means("fibres join elements with d ≤ reach · (R_i + R_j); more than 1 + tolerance of "
                 "the bonds"),
      may_have("alignment", number(p.rule.alignment, Range{0, 1, true, false}))
          .means("|cos| of the angle to the direction is above this"),
      may_have("stiffness_ratio", number(p.stiffness_ratio, positive))
          .means("moduli of a fibre over those of `[beams]`")};
}

Rule fibres_section(BeamParameters& beams) {
  return table([&beams](const Section& section) {
    Fibres fibres;
    section.read(fibre_keys(fibres));
    if (!section.has("direction")) {
      if (!beams.anisotropy)
        section.refuse("direction", "nothing says along what",
                       "direction = [x, y, z], or a section [beams.anisotropy] with its grain");
      fibres.rule.direction = beams.anisotropy->axes.longitudinal;
    }
    beams.fibres = fibres;
  });
}

using Law = BeamParameters::Law;
using RadiusFrom = BeamParameters::RadiusFrom;

std::vector<Key> beams_keys(BeamParameters& p, Reading& reading) {
  return {
      may_have("law", choice<Law>(p.law, {{"euler-bernoulli", Law::euler_bernoulli},
                                          {"timoshenko", Law::timoshenko},
                                          {"spring", Law::spring}}))
          .means("a Timoshenko beam shears as well; a spring resists a change of length alone, and "
                 "elements do not turn"),
      must_have("young_modulus", quantity(p.young_modulus, dimension::modulus, positive))
          .means("E of the beams"),
      may_have("poisson_ratio", number(p.poisson_ratio, Range{-1, 0.5, false, true}))
          .means("ν of the beams: G = E / (2 (1 + ν)); not for springs")
          .without("either this"),
      may_have("shear_modulus", quantity(p.shear_modulus, dimension::modulus, positive))
          .means("G of the beams; not for springs")
          .without("or this"),
      may_have("shear_coefficient", number(p.shear_coefficient, Range{0, 1, false, true}))
          .means("fraction of the section that bears shear, of Timoshenko beams"),
      must_have("radius_ratio", number(p.radius_ratio, positive))
          .means("radius of a beam as a multiple of"),
      may_have("radius_from", choice<RadiusFrom>(p.radius_from, {{"mean", RadiusFrom::mean},
                                                                 {"pair", RadiusFrom::pair}}))
          .means("the specimen's mean radius, or (R_i + R_j) / 2"),
      may_have("anisotropy", anisotropy_section(p))
          .means("beams that follow a grain, see below")
          .without("all directions alike"),
      may_have("fibres", fibres_section(p))
          .means("bonds beyond contact along a direction, see below")
          .without("none"),
      may_have("material", beam_materials_section(p, reading.regions))
          .means("beams of regions that are of another material, see below")
          .without("none"),
      may_have("interface", beam_interfaces_section(p))
          .means("beams between elements of two materials, see below")
          .without("each in series of its two materials")};
}

void finish_beams(const Section& section, BeamParameters& p, Reading& /*reading*/) {
  if (section.has("shear_coefficient") && p.law != Law::timoshenko)
    section.refuse("shear_coefficient", "only Timoshenko beams shear",
                   "law = \"timoshenko\" beside it");
  finish_beam_materials(section, p);
  if (p.law == Law::spring) {
    for (const char* key : {"poisson_ratio", "shear_modulus"})
      if (section.has(key))
        section.refuse(key, "a spring has no shear modulus", "no such key beside law = \"spring\"");
    return;
  }
  section.exactly_one_of({"poisson_ratio", "shear_modulus"});
  if (p.poisson_ratio) p.shear_modulus = p.young_modulus / (2 * (1 + *p.poisson_ratio));
}

const char* flow_in_words(const BeamDemands& demands) {
  const FlowRule rule = demands.plasticity ? demands.plasticity->law : FlowRule::radial_return;
  if (rule == FlowRule::scaled_offset) return ", scaled offset";
  return rule == FlowRule::associated ? ", associated flow" : ", radial return";
}

std::string beam_kernel(const BeamDemands& demands, bool periodic) {
  std::string kernel = demands.has_rotation() ? "move_beams" : "move_beams, springs";
  if (demands.watch() == Watch::remembering) kernel += flow_in_words(demands);
  if (demands.watch() == Watch::watched) kernel += ", brittle";
  if (demands.needs(periodic).differ) kernel += ", a rigidity for each bond";
  if (periodic) kernel += ", periodic";
  return kernel;
}

void plan_beams(const Setup& setup, Plan& plan) {
  const auto& beams = setup.get<BeamParameters>();
  if (!beams) return;
  const BeamDemands demands = demands_of(setup);
  check_limits_of_materials(*beams, demands.plasticity.has_value(), demands.rupture.has_value());
  if (demands.feels_temperature() && !setup.get<ConductionParameters>())
    throw InputError(
        "[plasticity] melting_temperature: nothing has a temperature; add a section [conduction], "
        "or leave out melting_temperature and reference_temperature: bonds are cold then");
  std::string reason = "[beams]";
  if (beams->anisotropy) reason += " [beams.anisotropy]";
  if (beams->fibres) reason += " [beams.fibres]";
  if (!beams->materials.empty()) reason += " [[beams.material]]";
  if (demands.plasticity) reason += " [plasticity]";
  plan.effects.push_back({"beams", reason, beam_kernel(demands, plan.periodic), Phase::move,
                          [demands](Assembly& assembly) {
                            return std::make_unique<Beams>(demands, assembly.mass, assembly.model);
                          }});
  plan.ask("beams", Beams::columns(demands, plan.periodic));
}

using Json = nlohmann::ordered_json;

Json to_json(const Vector& v) {
  return {v.x, v.y, v.z};
}

Json to_json(const Anisotropy& grain) {
  const auto& shear = grain.transverse_shear_modulus;
  return {{"grain", to_json(grain.axes.longitudinal)},
          {"radial", to_json(grain.axes.radial)},
          {"radial_modulus", grain.radial_modulus},
          {"tangential_modulus", grain.tangential_modulus},
          {"transverse_shear_modulus", shear ? Json(*shear) : Json(nullptr)},
          {"exponent", grain.exponent}};
}

Json to_json(const Fibres& fibres) {
  return {{"direction", to_json(fibres.rule.direction)},
          {"reach", fibres.rule.reach},
          {"alignment", fibres.rule.alignment},
          {"stiffness_ratio", fibres.stiffness_ratio}};
}

}  // namespace

EffectKind beams_kind() {
  EffectKind kind = single_kind<BeamParameters>("beams", beams_keys, finish_beams);
  kind.provides = Provides::motion;
  kind.plan = plan_beams;
  kind.example =
      "[beams]\n"
      "young_modulus = \"200 GPa\"\n"
      "poisson_ratio = 0.3\n"
      "radius_ratio = 0.5\n";
  kind.visit_keys = [keys = kind.visit_keys](const VisitKeys& visit) {
    Anisotropy grain;
    Fibres fibres;
    keys(visit);
    visit("beams.anisotropy", anisotropy_keys(grain));
    visit("beams.fibres", fibre_keys(fibres));
    EmptyReading empty;
    BeamMaterial material;
    BeamInterface interface;
    std::vector<std::string> between;
    std::optional<double> stress;
    visit("[beams.material]",
          beam_material_keys(material, stress, empty.reading.taken, empty.regions));
    visit("[beams.interface]", beam_interface_keys(interface, stress, between));
  };
  kind.explain = [values = kind.explain](const Setup& setup, const Specimen& specimen, Json& json) {
    const BeamParameters& beams = *setup.get<BeamParameters>();
    values(setup, specimen, json);
    json["mean_radius"] = mean_radius(specimen);
    if (beams.anisotropy) json["anisotropy"] = to_json(*beams.anisotropy);
    if (beams.fibres) json["fibres"] = to_json(*beams.fibres);
    explain_beam_materials(beams, json);
  };
  return kind;
}

}  // namespace solidem
