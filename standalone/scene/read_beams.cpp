// SPDX-License-Identifier: GPL-2.0-or-later
//
// [beams], [plasticity], [rupture] and [contact].
#include "effects/beam_properties.hpp"
#include "scene/rules.hpp"
#include "scene/sections.hpp"

namespace solidem {

Rule beams_section(std::optional<BeamParameters>& beams) {
  return table([&beams](const Section& section) {
    using Law = BeamParameters::Law;
    using RadiusFrom = BeamParameters::RadiusFrom;
    using Precision = BeamParameters::Precision;
    BeamParameters parameters;
    double poisson_ratio = 0;
    section.read(
        {may_have("law", choice<Law>(parameters.law, {{"euler-bernoulli", Law::euler_bernoulli},
                                                      {"timoshenko", Law::timoshenko},
                                                      {"spring", Law::spring}})),
         must_have("young_modulus",
                   quantity(parameters.young_modulus, dimension::modulus, positive)),
         may_have("poisson_ratio", number(poisson_ratio, Range{-1, 0.5, false, true})),
         may_have("shear_modulus",
                  quantity(parameters.shear_modulus, dimension::modulus, positive)),
         may_have("shear_coefficient",
                  number(parameters.shear_coefficient, Range{0, 1, false, true})),
         must_have("radius_ratio", number(parameters.radius_ratio, positive)),
         may_have("radius_from",
                  choice<RadiusFrom>(parameters.radius_from,
                                     {{"mean", RadiusFrom::mean}, {"pair", RadiusFrom::pair}})),
         may_have("precision",
                  choice<Precision>(parameters.precision,
                                    {{"double", Precision::whole}, {"mixed", Precision::mixed}})),
         may_have("anisotropy", anisotropy_section(parameters)),
         may_have("fibres", fibres_section(parameters))});
    if (section.has("shear_coefficient") && parameters.law != Law::timoshenko)
      section.refuse("shear_coefficient", "only Timoshenko beams shear",
                     "law = \"timoshenko\" beside it");
    if (parameters.precision == Precision::mixed &&
        (parameters.law != Law::euler_bernoulli || !beams_are_alike(parameters)))
      section.refuse("precision", "only Euler-Bernoulli beams that are all alike",
                     "precision = \"double\", or radius_from = \"mean\" and no grain or fibres");
    if (parameters.law == Law::spring) {
      for (const char* key : {"poisson_ratio", "shear_modulus"})
        if (section.has(key))
          section.refuse(key, "a spring has no shear modulus",
                         "no such key beside law = \"spring\"");
    } else {
      section.exactly_one_of({"poisson_ratio", "shear_modulus"});
      if (section.has("poisson_ratio"))
        parameters.shear_modulus = parameters.young_modulus / (2 * (1 + poisson_ratio));
    }
    beams = parameters;
  });
}

Rule plasticity_section(std::optional<PlasticityParameters>& plasticity,
                        const std::optional<BeamParameters>& beams) {
  return table([&plasticity, &beams](const Section& section) {
    using Law = PlasticityParameters::Law;
    PlasticityParameters parameters;
    double yield_stress = 0, hardening_modulus = 0;
    section.read(
        {may_have("law", choice<Law>(parameters.law, {{"radial-return", Law::radial_return},
                                                      {"scaled-offset", Law::scaled_offset}})),
         may_have("yield_stress", quantity(yield_stress, dimension::modulus, positive)),
         may_have("yield_strain", number(parameters.yield_strain, positive)),
         may_have("hardening_modulus",
                  quantity(hardening_modulus, dimension::modulus, not_negative)),
         may_have("hardening_ratio", number(parameters.hardening_ratio, not_negative))});
    section.exactly_one_of({"yield_stress", "yield_strain"});
    section.at_most_one_of({"hardening_modulus", "hardening_ratio"});
    if (!beams) return;  // refused as a whole
    if (section.has("yield_stress")) parameters.yield_strain = yield_stress / beams->young_modulus;
    if (section.has("hardening_modulus"))
      parameters.hardening_ratio = hardening_modulus / beams->young_modulus;
    plasticity = parameters;
  });
}

Rule rupture_section(std::optional<RuptureParameters>& rupture,
                     const std::optional<BeamParameters>& beams) {
  return table([&rupture, &beams](const Section& section) {
    RuptureParameters parameters;
    double stress = 0;
    section.read({may_have("stress", quantity(stress, dimension::modulus, positive)),
                  may_have("strain", number(parameters.strain, positive)),
                  may_have("minimal_bonds", integer(parameters.minimal_bonds, 0))});
    if (!section.has("stress") && !section.has("strain"))
      section.refuse("nothing says when a bond breaks", "stress or strain, or both");
    if (!beams) return;
    if (section.has("stress")) parameters.elastic_strain = stress / beams->young_modulus;
    rupture = parameters;
  });
}

Rule contact_section(std::optional<ContactParameters>& contact) {
  return table([&contact](const Section& section) {
    ContactParameters parameters;
    section.read({may_have("stiffness_ratio", number(parameters.stiffness_ratio, positive)),
                  may_have("rebonding_pressure",
                           quantity(parameters.rebonding_pressure, dimension::modulus, positive))});
    contact = parameters;
  });
}

}  // namespace solidem
