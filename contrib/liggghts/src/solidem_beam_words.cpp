// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#include "solidem_beam_words.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <variant>
#include <vector>

#include "error.h"
#include "force.h"

namespace LAMMPS_NS {

namespace {

// The words of one bond_coeff command, taken one after the other.
class Words {
 public:
  Words(LAMMPS* liggghts, int narg, char** arg)
      : liggghts_(liggghts), narg_(narg), arg_(arg), at_(1) {}

  bool any() const { return at_ < narg_; }

  std::string word(const std::string& what) {
    if (!any()) fail("'" + what + "' is missing at the end");
    return arg_[at_++];
  }

  double number(const std::string& what) {
    if (!any()) fail("'" + what + "' is missing at the end");
    return liggghts_->force->numeric(FLERR, arg_[at_++]);
  }

  double positive(const std::string& what) {
    const double value = number(what);
    if (!(value > 0.0)) fail(what + " must be positive, not " + arg_[at_ - 1]);
    return value;
  }

  double not_negative(const std::string& what) {
    const double value = number(what);
    if (!(value >= 0.0)) fail(what + " must not be negative, not " + arg_[at_ - 1]);
    return value;
  }

  // Whether the next word is this one; whether it is a number.
  bool is_next(const char* name) const { return any() && std::string(arg_[at_]) == name; }
  bool is_number() const {
    if (!any()) return true;  // one is missing
    char* end;
    std::strtod(arg_[at_], &end);
    return end != arg_[at_] && *end == '\0';
  }

  void fail(const std::string& why) const {
    liggghts_->error->all(FLERR, ("Bond style solidem/beam: " + why).c_str());
  }

 private:
  LAMMPS* liggghts_;
  int narg_;
  char** arg_;
  int at_;
};

void read_law(Words& words, SolidemBeam& beam) {
  const std::string law = words.word("law");
  if (law == "euler-bernoulli") {
    beam.law = SolidemBeam::EULER_BERNOULLI;
  } else if (law == "timoshenko") {
    beam.law = SolidemBeam::TIMOSHENKO;
    beam.shear_coefficient = words.positive("the shear coefficient");
    if (beam.shear_modulus == 0.0) words.fail("law timoshenko needs a shear modulus above zero");
  } else if (law == "spring") {
    beam.law = SolidemBeam::SPRING;
  } else {
    words.fail("unknown law '" + law + "'; known are euler-bernoulli, timoshenko KAPPA, spring");
  }
}

// One parameter of a law, if the next word is its name.
template <class Law>
bool read_parameter(Words& words, const solidem::BondLawParameter<Law>& parameter,
                    double young_modulus, Law& law) {
  const bool as_stress = parameter.stress_name && words.is_next(parameter.stress_name);
  if (!as_stress && !words.is_next(parameter.name)) return false;
  const std::string name = words.word("a name");
  const double value = parameter.bound == solidem::LawBound::above_zero ? words.positive(name)
                                                                        : words.not_negative(name);
  law.*parameter.member = as_stress ? value / young_modulus : value;
  return true;
}

// The parameters of a law by name, in any order, as far as they go.
template <class Law>
void read_parameters(Words& words, double young_modulus, Law& law) {
  std::vector<bool> given(law.parameters().size(), false);
  for (bool any = true; any;) {
    any = false;
    for (size_t k = 0; k < given.size(); k++) {
      if (!read_parameter(words, law.parameters()[k], young_modulus, law)) continue;
      if (given[k])
        words.fail(std::string(law.parameters()[k].name) + " of " + law.name + " is given twice");
      given[k] = any = true;
    }
  }
  for (size_t k = 0; k < given.size(); k++)
    if (law.parameters()[k].is_required && !given[k])
      words.fail(std::string(law.name) + " needs " + law.parameters()[k].name +
                 (law.parameters()[k].stress_name
                      ? std::string(" or ") + law.parameters()[k].stress_name
                      : std::string()));
  if (const char* complaint = law.complaint()) words.fail(std::string(law.name) + ": " + complaint);
}

// A law of a table by its name, with its parameters.
template <class Table>
void read_bond_law(Words& words, const std::string& what, double young_modulus,
                   typename Table::Any& result) {
  const std::string name = words.word(what);
  std::string known;
  bool found = false;
  Table::for_each([&](auto law) {
    known += (known.empty() ? "" : ", ") + std::string(law.name);
    if (name != law.name) return;
    read_parameters(words, young_modulus, law);
    result = law;
    found = true;
  });
  if (!found) words.fail("unknown " + what + " '" + name + "'; known are " + known);
}

// One of a table of names.
template <class Choice, size_t count>
void read_choice(Words& words, const std::string& what,
                 const solidem::NamedChoice<Choice> (&table)[count], Choice& result) {
  const std::string name = words.word(what);
  std::string known;
  for (const auto& named : table) {
    if (name == named.name) {
      result = named.choice;
      return;
    }
    known += (known.empty() ? "" : ", ") + std::string(named.name);
  }
  words.fail("unknown " + what + " '" + name + "'; known are " + known);
}

void read_plasticity(Words& words, SolidemBeam& beam) {
  read_choice(words, "plasticity", solidem::flow_rules, beam.flow_rule);
  beam.flows = true;
  if (words.is_number()) {  // without a name: linear hardening
    solidem::LinearHardening linear;
    linear.yield_strain = words.positive("the yield stress") / beam.young_modulus;
    linear.hardening_ratio = words.not_negative("the hardening modulus") / beam.young_modulus;
    beam.hardening = linear;
  } else {
    read_bond_law<solidem::YieldLaws>(words, "hardening", beam.young_modulus, beam.hardening);
  }
}

// A property over temperature: a number, or 'table N' and N times a temperature and a value.
SolidemOverTemperature read_over_temperature(Words& words, const std::string& what,
                                             bool above_zero) {
  const auto value = [&](const std::string& name) {
    return above_zero ? words.positive(name) : words.number(name);
  };
  SolidemOverTemperature read;
  if (!words.is_next("table")) {
    read.points = 1;
    read.value[0] = value(what);
    return read;
  }
  words.word("table");
  const double points = words.positive("the number of points of " + what);
  if (points != std::floor(points) || points > SolidemOverTemperature::MOST_POINTS)
    words.fail("the table of " + what + " has a whole number of points, 1 to " +
               std::to_string(SolidemOverTemperature::MOST_POINTS));
  read.points = static_cast<int>(points);
  for (int k = 0; k < read.points; k++) {
    read.temperature[k] = words.not_negative("a temperature of " + what);
    read.value[k] = value("a value of " + what);
    if (k > 0 && !(read.temperature[k] > read.temperature[k - 1]))
      words.fail("the temperatures of " + what + " must increase");
  }
  read.integrate();
  return read;
}

void read_expansion(Words& words, SolidemBeamWarmth& warmth) {
  warmth.expansion_coefficient = read_over_temperature(words, "expansion", false);
  if (words.word("from") != "from")
    words.fail(
        "after the coefficient of expansion comes 'from' and the temperature at which bonds "
        "are as long as when first seen");
  warmth.reference_temperature = words.not_negative("the reference temperature of expansion");
}

double read_fraction(Words& words, const std::string& what) {
  const double fraction = words.not_negative(what);
  if (fraction > 1.0) words.fail(what + " must not be above 1");
  return fraction;
}

// What does not go together once all words are read.
void require_heat_words_to_fit(Words& words, const SolidemBeam& beam) {
  if (beam.plastic_heat > 0.0 && !beam.flows)
    words.fail("plastic_heat needs plasticity: else no bond flows");
  if (beam.feels_rate() != (beam.rate_time > 0.0))
    words.fail(beam.feels_rate()
                   ? "a yield law that looks at the rate of flow needs rate_time, over "
                     "which the rate is averaged"
                   : "rate_time needs a yield law that looks at the rate of flow");
  if (beam.expands() && std::isfinite(beam.rebonding_pressure))
    words.fail("rebonding_pressure does not go with expansion");
}

void read_rupture(Words& words, SolidemBeam& beam) {
  if (beam.breaks) words.fail("rupture is given twice");
  read_bond_law<solidem::RuptureLaws>(words, "rupture", beam.young_modulus, beam.rupture);
  beam.breaks = true;
}

// The two words of the law strain-limit that stand alone.
void read_strain_limit(Words& words, const std::string& key, SolidemBeam& beam) {
  solidem::StrainLimit* law = std::get_if<solidem::StrainLimit>(&beam.rupture);
  if (!law) words.fail(key + " does not go with another rupture law");
  if (key == "rupture_stress")
    law->elastic_strain = words.positive(key) / beam.young_modulus;
  else
    law->strain = words.positive(key);
  beam.breaks = true;
}

// A number with all its digits.
std::string full(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// A law with its parameters, but for those without limit.
template <class AnyLaw>
std::string law_words(const AnyLaw& any) {
  return std::visit(
      [](const auto& law) {
        std::string words = law.name;
        for (const auto& parameter : law.parameters())
          if (std::isfinite(law.*parameter.member))
            words += std::string(" ") + parameter.name + " " + full(law.*parameter.member);
        return words;
      },
      any);
}

// A property over temperature as it is read; nothing where it is not given.
std::string over_temperature_words(const std::string& key, const SolidemOverTemperature& any) {
  if (!any.is_given()) return "";
  if (any.points == 1) return key + full(any.value[0]);
  std::string words = key + "table " + std::to_string(any.points);
  for (int k = 0; k < any.points; k++)
    words += " " + full(any.temperature[k]) + " " + full(any.value[k]);
  return words;
}

std::string heat_words(const SolidemBeam& beam) {
  std::string words = over_temperature_words(" expansion ", beam.warmth.expansion_coefficient);
  if (beam.expands()) words += " from " + full(beam.warmth.reference_temperature);
  words += over_temperature_words(" softening ", beam.warmth.modulus_ratio);
  if (beam.plastic_heat > 0.0) words += " plastic_heat " + full(beam.plastic_heat);
  if (beam.rate_time > 0.0) words += " rate_time " + full(beam.rate_time);
  return words;
}

// Where a beam is judged, unless it is where all are.
std::string section_words(const char* key, solidem::JudgedSection section) {
  if (section == solidem::JudgedSection::middle) return "";
  return std::string(key) + name_in(solidem::judged_sections, section);
}

}  // namespace

SolidemBeam solidem_read_beam(LAMMPS* liggghts, int narg, char** arg) {
  SolidemBeam beam;
  Words words(liggghts, narg, arg);
  if (narg < 5)
    words.fail(
        "bond_coeff wants TYPES YOUNG_MODULUS SHEAR_MODULUS and either 'radius R' or 'pair RATIO'");
  beam.young_modulus = words.positive("Young's modulus");
  beam.shear_modulus = words.not_negative("the shear modulus");
  const std::string thickness = words.word("radius");
  if (thickness != "radius" && thickness != "pair")
    words.fail("'radius' or 'pair' must follow the moduli, not '" + thickness + "'");
  (thickness == "radius" ? beam.radius : beam.ratio) = words.positive("radius or ratio");

  while (words.any()) {
    const std::string key = words.word("keyword");
    if (key == "law")
      read_law(words, beam);
    else if (key == "plasticity")
      read_plasticity(words, beam);
    else if (key == "rupture_stress" || key == "rupture_strain")
      read_strain_limit(words, key, beam);
    else if (key == "rupture")
      read_rupture(words, beam);
    else if (key == "yield_section")
      read_choice(words, key, solidem::judged_sections, beam.yield_section);
    else if (key == "rupture_section")
      read_choice(words, key, solidem::judged_sections, beam.rupture_section);
    else if (key == "contact")
      beam.contact_ratio = words.positive("the contact's stiffness ratio");
    else if (key == "rebonding_pressure")
      beam.rebonding_pressure = words.positive(key);
    else if (key == "damping")
      beam.damping_ratio = words.positive("the critical ratio of damping");
    else if (key == "expansion")
      read_expansion(words, beam.warmth);
    else if (key == "softening")
      beam.warmth.modulus_ratio = read_over_temperature(words, key, true);
    else if (key == "plastic_heat")
      beam.plastic_heat = read_fraction(words, key);
    else if (key == "rate_time")
      beam.rate_time = words.positive(key);
    else
      words.fail(
          "unknown keyword '" + key +
          "'; known are law, plasticity, yield_section, rupture_stress, rupture_strain, rupture, "
          "rupture_section, contact, rebonding_pressure, damping, expansion, softening, "
          "plastic_heat, rate_time");
  }
  if (beam.contact_ratio > 0.0 && !beam.may_break())
    words.fail(
        "contact needs rupture_stress or rupture_strain or rupture: only broken bonds have "
        "contacts");
  if (std::isfinite(beam.rebonding_pressure) && beam.contact_ratio == 0.0)
    words.fail("rebonding_pressure needs contact: only contacts make bonds anew");
  if (std::isfinite(beam.rebonding_pressure) && beam.is_offset())
    words.fail("rebonding_pressure goes with any plasticity or none, but not scaled-offset");
  require_heat_words_to_fit(words, beam);
  const solidem::JudgedSection middle = solidem::JudgedSection::middle;
  if (beam.yield_section != middle && !beam.flows)
    words.fail("yield_section needs plasticity: else nothing yields");
  if (beam.rupture_section != middle && !beam.may_break())
    words.fail("rupture_section needs rupture_stress or rupture_strain or rupture");
  if (beam.yield_section != middle && beam.flow_rule == solidem::FlowRule::associated)
    words.fail("yield_section: associated flow is of the resultants in the middle");
  return beam;
}

std::string solidem_write_beam(const SolidemBeam& beam) {
  std::string line = full(beam.young_modulus) + " " + full(beam.shear_modulus);
  line += beam.radius > 0.0 ? " radius " + full(beam.radius) : " pair " + full(beam.ratio);
  if (beam.law == SolidemBeam::TIMOSHENKO)
    line += " law timoshenko " + full(beam.shear_coefficient);
  if (beam.law == SolidemBeam::SPRING) line += " law spring";
  if (beam.flows)
    line += std::string(" plasticity ") + name_in(solidem::flow_rules, beam.flow_rule) + " " +
            law_words(beam.hardening);
  line += section_words(" yield_section ", beam.yield_section);
  if (beam.breaks) line += " rupture " + law_words(beam.rupture);
  line += section_words(" rupture_section ", beam.rupture_section);
  if (beam.contact_ratio > 0.0) line += " contact " + full(beam.contact_ratio);
  if (std::isfinite(beam.rebonding_pressure))
    line += " rebonding_pressure " + full(beam.rebonding_pressure);
  if (beam.damping_ratio > 0.0) line += " damping " + full(beam.damping_ratio);
  return line + heat_words(beam);
}

}  // namespace LAMMPS_NS
