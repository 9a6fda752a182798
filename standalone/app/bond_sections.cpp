// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bond_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "effects/beam_parameters.hpp"

namespace solidem {

namespace {

std::string array_of(const Vector& v) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x, v.y, v.z);
}

std::string anisotropy_section(const BeamParameters& beams) {
  const Anisotropy& grain = *beams.anisotropy;
  std::string text = fmt::format(
      "\n[beams.anisotropy]\ngrain = {}\nradial = {}\ntangential_modulus = \"{:.8g} Pa\"\n"
      "radial_modulus = \"{:.8g} Pa\"\nexponent = {:.8g}\n",
      array_of(grain.axes.longitudinal), array_of(grain.axes.radial), grain.tangential_modulus,
      grain.radial_modulus, grain.exponent);
  if (grain.transverse_shear_modulus)
    text +=
        fmt::format("transverse_shear_modulus = \"{:.8g} Pa\"\n", *grain.transverse_shear_modulus);
  return text;
}

std::string fibres_section(const Fibres& fibres) {
  return fmt::format(
      "\n[beams.fibres]\ndirection = {}\nreach = {:.8g}\nalignment = {:.8g}\n"
      "stiffness_ratio = {:.8g}\n",
      array_of(fibres.rule.direction), fibres.rule.reach, fibres.rule.alignment,
      fibres.stiffness_ratio);
}

std::string unit_of(LawUnit unit) {
  return unit == LawUnit::temperature ? " K" : " 1/s";
}

/// Parameters of a law of bonds, but for those without limit.
template <class AnyLaw>
std::string parameter_lines(const AnyLaw& any) {
  std::string text;
  std::visit(
      [&](const auto& law) {
        for (const auto& parameter : law.parameters())
          if (const double value = law.*parameter.member; std::isfinite(value))
            text += parameter.unit == LawUnit::number
                        ? fmt::format("{} = {:.8g}\n", parameter.name, value)
                        : fmt::format("{} = \"{:.8g}{}\"\n", parameter.name, value,
                                      unit_of(parameter.unit));
      },
      any);
  return text;
}

}  // namespace

double poisson_ratio_of(const BeamParameters& beams) {
  return beams.young_modulus / (2 * beams.shear_modulus) - 1;
}

std::string bond_sections(const BondParameters& bonds) {
  const BeamParameters& beams = bonds.beams;
  std::string text = fmt::format("[beams]\nlaw = \"{}\"\nyoung_modulus = \"{:.8g} Pa\"\n",
                                 name_of(beams.law), beams.young_modulus);
  if (beams.law != BeamParameters::Law::spring)
    text += fmt::format("poisson_ratio = {:.6g}\n", poisson_ratio_of(beams));
  if (beams.law == BeamParameters::Law::timoshenko)
    text += fmt::format("shear_coefficient = {:.6g}\n", beams.shear_coefficient);
  text += fmt::format("radius_ratio = {:.8g}\nradius_from = \"{}\"\n", beams.radius_ratio,
                      beams.radius_from == BeamParameters::RadiusFrom::pair ? "pair" : "mean");
  if (beams.anisotropy) text += anisotropy_section(beams);
  if (beams.fibres) text += fibres_section(*beams.fibres);
  if (bonds.plasticity) {
    const PlasticityParameters& plasticity = *bonds.plasticity;
    text += fmt::format("\n[plasticity]\nlaw = \"{}\"\nsection = \"{}\"\nhardening = \"{}\"\n{}",
                        name_of(plasticity.law), name_of(plasticity.section),
                        name_of(plasticity.hardening), parameter_lines(plasticity.hardening));
    if (plasticity.rate_time)
      text += fmt::format("rate_time = \"{:.8g} s\"\n", *plasticity.rate_time);
  }
  if (bonds.rupture) {
    text +=
        fmt::format("\n[rupture]\nlaw = \"{}\"\nsection = \"{}\"\n{}", name_of(bonds.rupture->law),
                    name_of(bonds.rupture->section), parameter_lines(bonds.rupture->law));
    if (bonds.rupture->minimal_bonds > 0)
      text += fmt::format("minimal_bonds = {}\n", bonds.rupture->minimal_bonds);
  }
  return text;
}

}  // namespace solidem
