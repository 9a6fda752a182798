// SPDX-License-Identifier: GPL-2.0-or-later
//
// [contact]: keys, plan, making.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "effects/assembly.hpp"
#include "effects/beam_parameters.hpp"
#include "effects/conduction_parameters.hpp"
#include "effects/contact.hpp"
#include "effects/contact_conduction.hpp"
#include "effects/effect_kind.hpp"
#include "effects/free_motion.hpp"
#include "effects/heat_load_parameters.hpp"
#include "keys/rules.hpp"
#include "laws/constants.hpp"
#include "laws/linear_contact.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

using Overlap = ContactLaw::InitialOverlap;

/// Finds the forces of contacts, once elements have moved.
class ContactLook : public Effect {
 public:
  explicit ContactLook(ElementContacts& contacts) : contacts_(contacts) {}
  void advance(Model& /*model*/, const Step& step) override { contacts_.look(step); }

 private:
  ElementContacts& contacts_;
};

std::vector<Key> keys_of(ContactParameters& p, ContactLaw& law) {
  return {
      may_have("stiffness_ratio", number(p.stiffness_ratio, positive))
          .means("k_n over E S / l of the bond that the two had or would have; with `[beams]`"),
      may_have("normal_stiffness", quantity(law.normal_stiffness, dimension::stiffness, positive))
          .means("k_n of every contact, in the place of `stiffness_ratio`")
          .without("without `[beams]` either this"),
      may_have("young_modulus", quantity(law.young_modulus, dimension::modulus, positive))
          .means("E of k_n = 2 E R_i R_j / (R_i + R_j), as YADE's FrictMat has it, in the place of "
                 "`stiffness_ratio`")
          .without("or this"),
      may_have("tangential_stiffness_ratio", number(law.tangential_stiffness_ratio, positive))
          .means("k_t / k_n"),
      may_have("friction", number(law.friction, not_negative))
          .means("Coulomb's μ; 0: surfaces are smooth"),
      may_have("restitution", number(law.restitution, Range{0, 1, false, true}))
          .means("e, relative velocity after over before of two that meet head-on"),
      may_have("initial_overlap",
               choice<Overlap>(law.initial_overlap,
                               {{"refused", Overlap::refused}, {"kept", Overlap::kept}}))
          .means("of elements of different bodies; kept: they touch where they stand, free of "
                 "load"),
      may_have("rebonding_pressure", quantity(p.rebonding_pressure, dimension::modulus, positive))
          .means("force over section of the bond above which a new one is made, free of load; "
                 "with `[rupture]`, not with `\"scaled-offset\"`")
          .without("never")};
}

ContactLaw law_of(const Setup& setup) {
  return setup.get<ContactLaw>().value_or(ContactLaw{});
}

std::vector<Key> contact_keys(ContactParameters& p, Reading& reading) {
  return keys_of(p, reading.setup.get<ContactLaw>().emplace());
}

/// Volume of a sphere, m³.
double ball(double radius) {
  return 4.0 / 3 * pi * radius * radius * radius;
}

/// The strain of a contact under the pressure at which it becomes a bond, of the softest beams; 0
/// where none does.
double rebonding_strain(const ContactParameters& contact,
                        const std::optional<BeamParameters>& beams) {
  if (!contact.rebonding_pressure || !beams) return 0;
  double modulus = beams->young_modulus;
  if (const auto& grain = beams->anisotropy)
    modulus = std::min({modulus, grain->tangential_modulus, grain->radial_modulus});
  return *contact.rebonding_pressure / (contact.stiffness_ratio * modulus);
}

void check_stiffness(const Section& section, bool has_beams) {
  const auto given = [&](const char* key) { return section.has(key) ? 1 : 0; };
  const int own = given("normal_stiffness") + given("young_modulus");
  if (own + given("stiffness_ratio") > 1)
    section.refuse(section.has("normal_stiffness") ? "normal_stiffness" : "young_modulus",
                   "the stiffness is given twice",
                   "one of stiffness_ratio, normal_stiffness and young_modulus");
  if (own == 0 && !has_beams)
    section.refuse("without beams nothing says how stiff contacts are",
                   "normal_stiffness or young_modulus; or a section [beams]");
}

void check_rebonding(const Section& section, const ContactParameters& p, const Setup& setup) {
  if (!p.rebonding_pressure) return;
  if (!setup.get<RuptureParameters>())
    section.refuse("rebonding_pressure", "no bond ever breaks", "a section [rupture]");
  if (!law_of(setup).is_stiff_as_bonds())
    section.refuse("rebonding_pressure", "bonds are made anew where contacts are as stiff as bonds",
                   "stiffness_ratio in the place of normal_stiffness or young_modulus");
  if (rebonding_strain(p, setup.get<BeamParameters>()) >= 1)
    section.refuse("rebonding_pressure", "no contact can bear so much: its elements would meet",
                   "less than stiffness_ratio times Young's modulus of the beams");
  const auto& plasticity = setup.get<PlasticityParameters>();
  if (plasticity && plasticity->law == PlasticityParameters::Law::scaled_offset)
    section.refuse("bonds by the law scaled-offset cannot be made anew",
                   "law = \"radial-return\" in [plasticity], or no rebonding_pressure");
}

void finish_contact(const Section& section, ContactParameters& p, Reading& reading) {
  const auto& beams = reading.setup.get<BeamParameters>();
  check_stiffness(section, beams.has_value());
  check_rebonding(section, p, reading.setup);
  if (law_of(reading.setup).friction > 0 && beams && beams->law == BeamParameters::Law::spring)
    section.refuse("friction", "elements that springs join do not turn",
                   "no friction, or beams of another law");
}

/// Heat of loose elements passes through contacts, and is not given to places that they leave.
void check_heat_of_loose(const Setup& setup) {
  const auto& conduction = setup.get<ConductionParameters>();
  if (!conduction) return;
  if (!setup.get<ContactConductionParameters>())
    throw InputError(
        "[conduction] loose elements move away from those that they gave heat to at the start; "
        "expected a section [contact_conduction], or [beams] beside [contact], or no [conduction]");
  if (conduction->law != ConductionParameters::Law::platonic)
    throw InputError(
        "[conduction] law: loose elements exchange heat through contacts alone; expected "
        "\"platonic\", for which each has the volume of its sphere");
  const auto refuse_if = [](bool stays, const std::string& section, const std::string& name) {
    if (stays)
      throw InputError("[[" + section + "]] \"" + name +
                       "\": loose elements move away from where it is; expected a body with "
                       "[beams], or heat in a region of elements");
  };
  for (const auto& flux : setup.all<HeatFluxParameters>())
    refuse_if(true, "heat_fluxes", flux.name);
  for (const auto& fluid : setup.all<ConvectionParameters>())
    refuse_if(true, "convections", fluid.name);
  for (const auto& imposed : setup.all<ImposedTemperatureParameters>())
    refuse_if(!imposed.wall.empty(), "temperatures", imposed.name);
  for (const auto& source : setup.all<HeatSourceParameters>())
    refuse_if(source.shape.has_value(), "heat_sources", source.name);
}

void plan_contact(const Setup& setup, Plan& plan) {
  const auto& contact = setup.get<ContactParameters>();
  if (!contact) return;
  const ContactLaw law = law_of(setup);
  if (elements_are_loose(setup)) {
    check_heat_of_loose(setup);
    if (setup.gauge)
      throw InputError(
          "[gauge] the elements are loose, so that there is no body to measure; "
          "expected a section [beams], or no [gauge]");
    plan.effects.push_back(
        {"free motion", "[contact]", "", Phase::move, [law](Assembly& assembly) {
           const Specimen& specimen = assembly.specimen();
           for (std::size_t i = 0; i < specimen.size(); ++i) {
             const std::size_t m = assembly.material.empty() ? 0 : assembly.material[i];
             assembly.mass[i] = assembly.setup.materials[m].density * ball(specimen.radius[i]);
           }
           return std::make_unique<FreeMotion>(
               assembly.mass, law.stiffness(mean_radius(specimen), mean_radius(specimen)),
               assembly.model);
         }});
    plan.ask("free motion", FreeMotion::columns(law.friction > 0));
  }
  plan.effects.push_back(
      {"contact", "[contact]", "", Phase::push, [contact = *contact, law](Assembly& assembly) {
         return std::make_unique<ElementContacts>(
             contact, law, rebonding_strain(contact, assembly.setup.get<BeamParameters>()),
             assembly.find<Beams>(), assembly.find<Rupture>(), assembly.model);
       }});
  plan.effects.push_back(
      {"contact at the new poses", "[contact]", "", Phase::after_move, [](Assembly& assembly) {
         auto& contacts = assembly.need<ElementContacts>();
         contacts.follow(assembly.all<Grip>());
         return std::make_unique<ContactLook>(contacts);
       }});
}

}  // namespace

EffectKind contact_kind() {
  EffectKind kind = single_kind<ContactParameters>("contact", contact_keys, finish_contact);
  kind.provides = Provides::motion;
  kind.conflicts = {{"central_forces", "central forces push elements apart already",
                     "either [contact] or [central_forces]"}};
  kind.explain = [](const Setup& setup, const Specimen&, nlohmann::ordered_json& values) {
    ContactParameters p = *setup.get<ContactParameters>();
    ContactLaw law = law_of(setup);
    add_values(keys_of(p, law), values);
    values["damping_ratio"] = restitution_damping_ratio(law.restitution);
  };
  kind.plan = plan_contact;
  kind.example =
      "[contact]\n"
      "young_modulus = \"70 GPa\"\n"
      "friction = 0.3\n"
      "restitution = 0.8\n"
      "initial_overlap = \"kept\"\n";
  return kind;
}

}  // namespace solidem
